//! The search as the pipeline sees it: the only file that knows how it is asked and how it answers.

use std::sync::Arc;
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_draw::SearchTree;
use hssh_metrics::{PoseGraph, UniformPrior};
use hssh_search::{
    Appearance, Corridor, Distinction, Experience, Goal, LINEAR_TRUST, LevelCounts, Limits, MapPrior, Mapper,
    Metrical, NodeId, PlacePrior, PlacementError, Posterior, PosteriorError, PosteriorModel, PosteriorOrder,
    PosteriorSearch, Prediction, Proving, RankedMap, Report, StopReason, Strategy, ThreadsError, Tree,
    distinguish, place_by_odometry,
};
use hssh_topology::{GenusRank, Hypothesis, MapOlp, Measure, PlaceId, Position, Preference, StarCatalog};

use super::error::PipelineError;
use super::options::{GenusOrder, MappingOptions, MetricalScore, PriorKind, SearchMethod};
use crate::answer::{
    Assumption, CertificateSummary, CostItem, CostSheet, EndReference, FoundCounts, MapDifference,
    MapMeasure, Objective, PartingVisit, SearchLevel, SearchOrder, SearchSummary, StopCause, TestTravels,
    Trusted, Worth,
};

pub use hssh_search::Monitor;

/// How much more alike pairs of visits look than places at random.
pub(super) type Likeness = Appearance;

/// Why a search came to nothing.
#[derive(Debug, thiserror::Error)]
pub enum SearchFailure {
    /// The operating system gave no threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// Measurements that cannot be weighed, or are not there.
    #[error("cannot weigh the maps: {0}")]
    Posterior(#[from] PosteriorError),
    /// A map that cannot be placed by its odometry.
    #[error("cannot place the map by its odometry: {0}")]
    Placement(#[from] PlacementError),
}

/// What to search.
pub(super) struct Task<'a> {
    pub(super) exploration: &'a Exploration,
    pub(super) options: &'a MappingOptions,
    pub(super) method: SearchMethod,
    /// By later visit, earlier visit and rotation of φ: how much more alike two visits look than two places at random.
    pub(super) likeness: Option<Likeness>,
    pub(super) monitor: &'a Arc<Monitor>,
}

/// A search that has come to its end.
pub(super) struct Searched {
    engine: Engine,
    pub(super) summary: SearchSummary,
    pub(super) certificate: CertificateSummary,
    /// How many travels its maps explain.
    pub(super) explained: usize,
    ranking: Vec<FoundMap>,
}

enum Engine {
    Preference(Box<Mapper>),
    Posterior(Box<Posterior>),
    /// Only counted.
    Nothing,
}

/// A map that was found, with what ranks it.
#[derive(Clone, Debug)]
pub(super) struct FoundMap {
    node: NodeId,
    pub(super) optimal: bool,
    pub(super) tied: bool,
    pub(super) probability: Option<[f64; 2]>,
    pub(super) costs: Option<CostSheet>,
}

/// What a map says.
pub(super) struct Telling {
    pub(super) hypothesis: Hypothesis,
    /// Where the robot was on each visit, the start first.
    pub(super) positions: Vec<Position>,
}

impl Task<'_> {
    /// Searches.
    pub(super) fn search(self) -> Result<Searched, PipelineError> {
        let goal = self.goal();
        match self.method {
            SearchMethod::BreadthFirst => self.prefer(Strategy::BreadthFirst),
            SearchMethod::BestFirst => self.prefer(Strategy::BestFirst(goal)),
            SearchMethod::Proof => self.prefer(Strategy::Proof(goal)),
            SearchMethod::Count => self.count(),
            SearchMethod::PosteriorBestFirst => self.weigh(PosteriorOrder::BestFirst),
            SearchMethod::Posterior => {
                let posterior = self.options.posterior;
                let proving = Proving { best: posterior.best, rest: posterior.rest };
                self.weigh(PosteriorOrder::Proof(proving))
            }
        }
    }

    fn prefer(self, strategy: Strategy) -> Result<Searched, PipelineError> {
        let builder = self.builder().strategy(strategy);
        let mapper = builder.explain(self.exploration).map_err(SearchFailure::from)?;
        let (report, maps) = mapper.answer(self.options.listed.unwrap_or(usize::MAX));
        let order = match strategy {
            Strategy::BreadthFirst => SearchOrder::BreadthFirst,
            Strategy::BestFirst(_) => SearchOrder::BestFirst,
            Strategy::Proof(_) => SearchOrder::Proof,
        };
        let found = |(index, map): (usize, &RankedMap)| {
            let tied = (index as u64) < report.finals.optimal;
            FoundMap {
                node: map.node,
                optimal: tied && report.is_optimal,
                tied,
                probability: None,
                costs: None,
            }
        };
        Ok(Searched {
            summary: preference_summary(&report, order, self.options.search.closed),
            certificate: preference_certificate(&report),
            explained: if report.finals.final_maps > 0 { report.explained as usize } else { 0 },
            ranking: maps.iter().enumerate().map(found).collect(),
            engine: Engine::Preference(Box::new(mapper)),
        })
    }

    fn count(self) -> Result<Searched, PipelineError> {
        let report = self.builder().count(self.exploration).map_err(SearchFailure::from)?;
        Ok(Searched {
            summary: preference_summary(&report, SearchOrder::Count, false),
            certificate: preference_certificate(&report),
            explained: if report.finals.final_maps > 0 { report.explained as usize } else { 0 },
            ranking: Vec::new(),
            engine: Engine::Nothing,
        })
    }

    fn weigh(self, order: PosteriorOrder) -> Result<Searched, PipelineError> {
        let search = PosteriorSearch {
            axioms: self.options.axioms,
            order,
            goal: self.goal(),
            limits: self.limits(),
            monitor: Arc::clone(self.monitor),
            ..PosteriorSearch::new(self.model()?)
        };
        let search = PosteriorSearch { appearance: self.likeness.unwrap_or_default(), ..search };
        let posterior = search.explain(self.exploration).map_err(SearchFailure::from)?;
        let order = match order {
            PosteriorOrder::BestFirst => SearchOrder::BestFirst,
            PosteriorOrder::Proof(_) => SearchOrder::Proof,
        };
        let measured = self.options.posterior.score != MetricalScore::Ignored;
        let listed = self.options.listed.unwrap_or(usize::MAX);
        let is_proved = posterior.report().proved;
        let ranking = posterior.maps().iter().take(listed).enumerate().map(|(index, map)| {
            let tied = (index as u64) < posterior.report().ties;
            FoundMap {
                node: map.node,
                optimal: tied && is_proved,
                tied,
                probability: Some([map.least_probability, map.probability]),
                costs: Some(cost_sheet(&map.cost)),
            }
        });
        Ok(Searched {
            summary: posterior_summary(&posterior, order, self.options.search.closed),
            certificate: posterior_certificate(&posterior, measured),
            explained: if posterior.maps().is_empty() { 0 } else { self.exploration.travels().len() },
            ranking: ranking.collect(),
            engine: Engine::Posterior(Box::new(posterior)),
        })
    }

    fn builder(&self) -> hssh_search::MapperBuilder {
        let genus = match self.options.search.genus {
            None => GenusRank::Ignored,
            Some(GenusOrder::First) => GenusRank::First,
            Some(GenusOrder::Last) => GenusRank::Last,
        };
        Mapper::builder()
            .axioms(self.options.axioms)
            .preference(Preference { genus })
            .limits(self.limits())
            .threads(self.options.search.threads)
            .monitor(Arc::clone(self.monitor))
    }

    fn goal(&self) -> Goal {
        if self.options.search.closed { Goal::ClosedMap } else { Goal::AnyMap }
    }

    fn limits(&self) -> Limits {
        let limits = &self.options.limits;
        // Whatever is longer than a duration can be is no limit.
        let time = limits.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        Limits { nodes: limits.nodes, time, bytes: Some(limits.mebibytes.saturating_mul(1 << 20)) }
    }

    /// What makes a map probable.
    fn model(&self) -> Result<PosteriorModel, PipelineError> {
        let posterior = &self.options.posterior;
        let places = match posterior.area {
            Some(area) => Some(PlacePrior::Uniform(UniformPrior::over_area(area)?)),
            None => Corridor::typical_of(self.exploration).map(PlacePrior::Corridor),
        };
        let metrical = match posterior.score {
            MetricalScore::Likelihood => Metrical::Likelihood,
            MetricalScore::Ignored => Metrical::Ignored,
            // Without any measured distance nothing is laid out, and the search will say so.
            MetricalScore::Evidence => places.map_or(Metrical::Likelihood, Metrical::Evidence),
        };
        let usual =
            if posterior.score == MetricalScore::Evidence { PriorKind::Flat } else { PriorKind::Simplicity };
        let prior = match posterior.prior.unwrap_or(usual) {
            PriorKind::Flat => MapPrior::Flat,
            PriorKind::Choices => MapPrior::Choices,
            PriorKind::Simplicity => MapPrior::Simplicity(posterior.weights),
        };
        Ok(PosteriorModel { metrical, prior })
    }
}

impl Searched {
    /// The best maps, as many as were asked for.
    pub(super) fn ranking(&self) -> &[FoundMap] {
        &self.ranking
    }

    /// What a map says.
    pub(super) fn telling(&self, map: &FoundMap) -> Option<Telling> {
        let (hypothesis, positions) = match &self.engine {
            Engine::Preference(mapper) => (mapper.hypothesis(map.node), mapper.visits(map.node)),
            Engine::Posterior(posterior) => (posterior.hypothesis(map.node), posterior.visits(map.node)),
            Engine::Nothing => return None,
        };
        Some(Telling { hypothesis, positions })
    }

    /// The pose graph of a map at its layout: a pose for each place, an edge for each measured travel. `None` if not every
    /// place can be reached by measured travels.
    pub(super) fn pose_graph(
        &self,
        rank: usize,
        positions: &[Position],
        exploration: &Exploration,
    ) -> Result<Option<PoseGraph>, SearchFailure> {
        let laid_out = match &self.engine {
            Engine::Posterior(posterior) => posterior.pose_graph(&posterior.maps()[rank - 1]),
            _ => None,
        };
        match laid_out {
            Some(graph) => Ok(Some(graph)),
            None => Ok(place_by_odometry(exploration, positions)?.map(|placed| placed.graph)),
        }
    }

    /// What tells a map from the first one.
    pub(super) fn difference(&self, first: &Telling, second: &Telling) -> Option<MapDifference> {
        let (_, experience) = self.searched()?;
        let hypotheses = [&first.hypothesis, &second.hypothesis];
        let positions = [first.positions.as_slice(), second.positions.as_slice()];
        Some(difference(&experience.catalog, hypotheses, positions))
    }

    /// The tree that was searched, with its best maps framed; maps are taken along up to `most_maps` nodes. `None` if it was
    /// only counted.
    pub(super) fn tree(&self, most_maps: usize) -> Option<SearchTree> {
        let (tree, experience) = self.searched()?;
        let best: Vec<NodeId> = self.ranking.iter().filter(|map| map.tied).map(|map| map.node).collect();
        Some(SearchTree::of(tree, experience, &best, most_maps))
    }

    fn searched(&self) -> Option<(&Tree, &Experience)> {
        match &self.engine {
            Engine::Preference(mapper) => Some((mapper.tree(), mapper.experience())),
            Engine::Posterior(posterior) => Some((posterior.tree(), posterior.experience())),
            Engine::Nothing => None,
        }
    }
}

/// What preference looks at in a map.
pub(super) fn measured(measure: Measure) -> MapMeasure {
    MapMeasure {
        undetermined_boundaries: measure.f1,
        paths: measure.f2,
        places: measure.f3,
        genus: measure.genus,
    }
}

fn preference_summary(report: &Report, order: SearchOrder, closed_only: bool) -> SearchSummary {
    let finals = &report.finals;
    SearchSummary {
        objective: Objective::Preference,
        order,
        closed_only,
        stop: stop_cause(report.stop),
        nodes: report.nodes,
        maps_made: report.maps,
        refuted: report.refuted,
        expanded: report.expanded,
        layouts: 0,
        found: FoundCounts {
            maps: finals.final_maps,
            tied: finals.optimal,
            closed: finals.closed,
            nearly_closed: Some(finals.nearly_closed),
            perpendicular: Some(finals.perpendicular),
        },
        rejected: report.rejected,
        removals: Some(report.removals),
        levels: levels(&report.levels),
        seconds: report.seconds,
        bytes: report.tree_bytes,
    }
}

fn posterior_summary(posterior: &Posterior, order: SearchOrder, closed_only: bool) -> SearchSummary {
    let report = posterior.report();
    SearchSummary {
        objective: Objective::Posterior,
        order,
        closed_only,
        stop: stop_cause(report.stop),
        nodes: report.nodes,
        maps_made: report.levels.iter().map(|level| level.maps).sum(),
        refuted: report.levels.iter().map(|level| level.refuted).sum(),
        expanded: report.expanded,
        layouts: report.solved,
        found: FoundCounts {
            maps: report.found,
            tied: report.ties,
            closed: posterior.maps().iter().filter(|map| map.closed).count() as u64,
            nearly_closed: None,
            perpendicular: None,
        },
        rejected: report.rejected,
        removals: None,
        levels: levels(&report.levels),
        seconds: report.seconds,
        bytes: report.bytes,
    }
}

fn levels(counts: &[LevelCounts]) -> Vec<SearchLevel> {
    let level = |(travels, counts): (usize, &LevelCounts)| SearchLevel {
        travels: travels as u64,
        nodes: counts.nodes,
        maps: counts.maps,
        refuted: counts.refuted,
    };
    counts.iter().enumerate().map(level).collect()
}

fn preference_certificate(report: &Report) -> CertificateSummary {
    let open = report.certificate.and_then(|certificate| certificate.open_bound);
    CertificateSummary {
        proved: report.is_optimal || report.certificate.is_some_and(|certificate| certificate.proved),
        best: report.finals.best.map(|measure| Worth::Measure(measured(measure))),
        open: open.map(|measure| Worth::Measure(measured(measure))),
        rest_probability: None,
        trusted: vec![perception()],
    }
}

fn posterior_certificate(posterior: &Posterior, measured: bool) -> CertificateSummary {
    let report = posterior.report();
    let mut trusted = vec![perception()];
    if measured {
        trusted.push(Trusted::held(
            Assumption::Covariances,
            "measured travels err as their covariances say, independently of one another".to_owned(),
        ));
        trusted.push(Trusted {
            assumption: Assumption::LinearEstimates,
            sentence: format!(
                "χ² rises by at least {LINEAR_TRUST} of what the linear estimate says; where it was computed, it rose by at least \
                 {:.2} of it",
                report.linear_factor
            ),
            held: report.open_bound.is_none() || report.linear_factor >= LINEAR_TRUST,
            least: Some(report.linear_factor),
        });
        trusted.push(Trusted {
            assumption: Assumption::Layouts,
            sentence: "the layout of every hypothesis that matters can be computed, and is the best one"
                .to_owned(),
            held: !report.unsolvable,
            least: None,
        });
    }
    CertificateSummary {
        proved: report.proved,
        best: report.best.filter(|nats| nats.is_finite()).map(Worth::Nats),
        open: report.open_bound.filter(|nats| nats.is_finite()).map(Worth::Nats),
        rest_probability: Some(report.rest).filter(|rest| rest.is_finite()),
        trusted,
    }
}

fn perception() -> Trusted {
    Trusted::held(
        Assumption::Perception,
        "every star is as it was seen, and every travel as it was told".to_owned(),
    )
}

fn cost_sheet(cost: &hssh_search::Cost) -> CostSheet {
    let items = [
        ("bend", cost.bend),
        ("vagueness", cost.vagueness),
        ("places", cost.places),
        ("choices", cost.choices),
        ("complexity", cost.complexity),
        ("appearance", cost.appearance),
    ];
    let item = |(item, nats): (&str, f64)| CostItem { item: item.to_owned(), nats };
    CostSheet { total: cost.total(), items: items.map(item).into() }
}

fn stop_cause(stop: StopReason) -> StopCause {
    match stop {
        StopReason::NotSearched => StopCause::NotSearched,
        StopReason::Exhausted => StopCause::Exhausted,
        StopReason::Found => StopCause::Found,
        StopReason::Proved => StopCause::Proved,
        StopReason::NodeLimit => StopCause::NodeLimit,
        StopReason::TimeLimit => StopCause::TimeLimit,
        StopReason::MemoryLimit => StopCause::MemoryLimit,
        StopReason::Interrupted => StopCause::Interrupted,
    }
}

/// What tells the second map from the first.
fn difference(
    catalog: &StarCatalog,
    hypotheses: [&Hypothesis; 2],
    positions: [&[Position]; 2],
) -> MapDifference {
    let Distinction { parting, test } = distinguish(catalog, hypotheses, positions);
    let Some(parting) = parting else {
        return MapDifference { sentence: "in nothing.".to_owned(), parting: None, test: None };
    };
    let [first, second] = parting.positions;
    let parting = PartingVisit {
        visit: parting.visit as u64,
        first_place: first.place.0,
        first_rotation: first.phi.rotation(),
        place: second.place.0,
        rotation: second.phi.rotation(),
    };
    let end = |prediction: Prediction| match prediction {
        Prediction::Unknown => None,
        Prediction::Arrival { place: PlaceId(place), star, entry } => {
            let star = catalog.star(star);
            Some((EndReference { place, end: star.name(entry).to_string() }, star.to_string()))
        }
    };
    let map = &hypotheses[0].map;
    let exit = |gateway: &MapOlp| {
        let place = map.place(*gateway);
        EndReference {
            place: place.0,
            end: catalog.star(map.star(place)).name(map.local(*gateway)).to_string(),
        }
    };
    let test = test.map(|test| (test.exits.iter().map(exit).collect::<Vec<_>>(), test.predictions.map(end)));
    let sentence =
        MapDifference::sentence(&parting, test.as_ref().map(|(exits, says)| (exits.as_slice(), says)));
    let test = test.map(|(exits, [first, second])| TestTravels {
        exits,
        first_arrival: first.map(|(end, _)| end),
        arrival: second.map(|(end, _)| end),
    });
    MapDifference { sentence, parting: Some(parting), test }
}
