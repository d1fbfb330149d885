//! The search as the pipeline sees it: the only file that knows how it is asked and how it answers.

use std::sync::Arc;
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_draw::SearchTree;
use hssh_metrics::{PoseGraph, UniformPrior};
use hssh_search::{
    Appearance, Corridor, Distinction, Goal, LINEAR_TRUST, LevelCounts, Limits, MapPrior, Mapper,
    MapperBuilder, Metrical, Order, PlacePrior, PosteriorModel, Prediction, Proving, RankedMap, Report,
    Score, Tree, distinguish, place_by_odometry,
};
use hssh_topology::{GenusRank, Hypothesis, MapOlp, Measure, Position, Preference, StarCatalog};

use super::error::{PipelineError, SearchFailure};
use super::options::{GenusOrder, MappingOptions, MetricalScore, PriorKind, SearchLimits, SearchMethod};
use crate::answer::{
    Assumption, CertificateSummary, CostItem, CostSheet, EndReference, FoundCounts, MapDifference,
    MapMeasure, PartingVisit, SearchLevel, SearchObjective, SearchOrder, SearchSummary, TestTravels, Trusted,
    Worth,
};

pub use hssh_search::{Checkpoints, Keeper, Monitor, Source, Store};

/// How much more alike pairs of visits look than places at random.
pub(crate) type Likeness = Appearance;

/// Several processes that search instead of this one alone. The answer is that of one; nothing where another process has it.
pub trait Searchers {
    /// Counts hypotheses.
    ///
    /// # Errors
    /// If the count cannot begin, or a process is lost.
    fn count(
        &self,
        search: MapperBuilder,
        exploration: &Exploration,
    ) -> Result<Option<Report>, PipelineError>;

    /// Searches for maps.
    ///
    /// # Errors
    /// If the search cannot begin, or a process is lost.
    fn explain(
        &self,
        search: MapperBuilder,
        exploration: &Exploration,
    ) -> Result<Option<Mapper>, PipelineError>;
}

/// Means of a search that this process does not have by itself.
#[derive(Default)]
pub struct Means<'a> {
    /// Where its state is kept from time to time.
    pub checkpoints: Option<Checkpoints>,
    /// The same of the search for readings that comes before that.
    pub reading_checkpoints: Option<Checkpoints>,
    /// Where hypotheses are kept for which the limit on memory leaves no room.
    pub store: Option<Arc<dyn Store>>,
    /// Who searches.
    pub searchers: Option<&'a dyn Searchers>,
}

/// What to search.
pub(crate) struct Task<'a> {
    pub(crate) exploration: &'a Exploration,
    pub(crate) options: &'a MappingOptions,
    pub(crate) method: SearchMethod,
    /// By later visit, earlier visit and rotation of φ: how much more alike two visits look than two places at random.
    pub(crate) likeness: Option<Likeness>,
    pub(crate) monitor: &'a Arc<Monitor>,
    /// Whether more travels are to come.
    pub(crate) is_online: bool,
    pub(crate) means: &'a Means<'a>,
}

/// A search that has come to its end.
pub(crate) struct Searched {
    /// Nothing if hypotheses were only counted.
    mapper: Option<Box<Mapper>>,
    pub(super) summary: SearchSummary,
    pub(super) certificate: CertificateSummary,
    /// How many travels its maps explain.
    pub(super) explained: usize,
    ranking: Vec<FoundMap>,
}

/// A map that was found, with what ranks it.
#[derive(Clone, Debug)]
pub(super) struct FoundMap {
    map: RankedMap,
    /// What identifies it anywhere: the choices that lead to it.
    pub(super) branch: String,
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
        if self.method == SearchMethod::Count {
            return self.count();
        }
        let search = self.mapper_builder()?;
        let mapper = match self.means.searchers {
            Some(all) => all.explain(search, self.exploration)?.ok_or(PipelineError::AnsweredElsewhere)?,
            None => search.explain(self.exploration).map_err(SearchFailure::from)?,
        };
        Ok(Searched::of(Box::new(mapper), self.method, self.options))
    }

    /// How the mapper is to search.
    pub(crate) fn mapper_builder(&self) -> Result<MapperBuilder, PipelineError> {
        self.mapper_builder_for(self.goal())
    }

    /// How the mapper is to search for other maps than those that were asked for.
    pub(super) fn mapper_builder_for(&self, goal: Goal) -> Result<MapperBuilder, PipelineError> {
        let (objective, order) = self.method.objective_and_order();
        let builder = match objective {
            SearchObjective::Preference => self.builder(),
            SearchObjective::Posterior => self.builder().posterior(self.model()?),
        };
        let builder = builder.constraints(self.options.visits.constraints()?);
        let builder = builder.order(order).goal(goal).proving(Proving {
            best: self.options.posterior.best,
            rest: self.options.posterior.rest,
            patience: None,
        });
        Ok(builder.appearance(self.likeness.clone().unwrap_or_default()))
    }

    fn count(self) -> Result<Searched, PipelineError> {
        let report = match self.means.searchers {
            Some(all) => {
                all.count(self.builder(), self.exploration)?.ok_or(PipelineError::AnsweredElsewhere)?
            }
            None => self.builder().count(self.exploration).map_err(SearchFailure::from)?,
        };
        Ok(Searched {
            summary: summary(&report, SearchObjective::Preference, SearchOrder::Count, false),
            certificate: certificate(&report, false),
            explained: if report.finals.final_maps > 0 { report.explained as usize } else { 0 },
            ranking: Vec::new(),
            mapper: None,
        })
    }

    fn builder(&self) -> MapperBuilder {
        let genus = match self.options.search.genus {
            None => GenusRank::Ignored,
            Some(GenusOrder::First) => GenusRank::First,
            Some(GenusOrder::Last) => GenusRank::Last,
        };
        let Means { checkpoints, store, .. } = self.means;
        let builder = checkpoints.clone().into_iter().fold(Mapper::builder(), MapperBuilder::checkpoints);
        let builder = store.clone().into_iter().fold(builder, MapperBuilder::spilling);
        builder
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
        self.options.limits.of_search()
    }

    fn model(&self) -> Result<PosteriorModel, PipelineError> {
        let model = model(self.exploration, self.options)?;
        // What is still to come says where corridors lead, too.
        Ok(match model.metrical {
            Metrical::Evidence(PlacePrior::Corridor(_)) if self.is_online => {
                PosteriorModel { metrical: Metrical::Evidence(PlacePrior::Typical), ..model }
            }
            _ => model,
        })
    }
}

impl SearchLimits {
    /// As the search takes them.
    pub(crate) fn of_search(&self) -> Limits {
        // Whatever is longer than a duration can be is no limit.
        let time = self.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        Limits { nodes: self.nodes, time, bytes: Some(self.mebibytes.saturating_mul(1 << 20)) }
    }
}

/// What makes a map of an exploration probable.
pub(super) fn model(
    exploration: &Exploration,
    options: &MappingOptions,
) -> Result<PosteriorModel, PipelineError> {
    let posterior = &options.posterior;
    let places = match posterior.area {
        Some(area) => Some(PlacePrior::Uniform(UniformPrior::over_area(area)?)),
        None => Corridor::typical_of(exploration).map(PlacePrior::Corridor),
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

impl Searched {
    /// What a mapper found that searched by a method.
    pub(crate) fn of(mapper: Box<Mapper>, method: SearchMethod, options: &MappingOptions) -> Self {
        let (objective, order) = method.objective_and_order();
        let (report, maps) = mapper.answer(options.listed.unwrap_or(usize::MAX));
        let found = |(index, map): (usize, RankedMap)| {
            let tied = (index as u64) < report.finals.optimal;
            FoundMap {
                branch: mapper.branch(map.node).to_string(),
                optimal: tied && report.is_optimal,
                tied,
                probability: map.probable.as_ref().map(|probable| [probable.at_least, probable.at_most]),
                costs: map.probable.as_ref().map(|probable| cost_sheet(&probable.cost)),
                map,
            }
        };
        let measured =
            objective == SearchObjective::Posterior && options.posterior.score != MetricalScore::Ignored;
        Searched {
            summary: summary(&report, objective, search_order(order), options.search.closed),
            certificate: certificate(&report, measured),
            explained: if report.finals.final_maps > 0 { report.explained as usize } else { 0 },
            ranking: maps.into_iter().enumerate().map(found).collect(),
            mapper: Some(mapper),
        }
    }

    /// The mapper, to go on; nothing if hypotheses were only counted.
    pub(crate) fn into_mapper(self) -> Option<Box<Mapper>> {
        self.mapper
    }

    /// The best maps, as many as were asked for.
    pub(super) fn ranking(&self) -> &[FoundMap] {
        &self.ranking
    }

    /// What a map says.
    pub(super) fn telling(&self, found: &FoundMap) -> Option<Telling> {
        let mapper = self.mapper.as_ref()?;
        let node = found.map.node;
        Some(Telling { hypothesis: mapper.hypothesis(node), positions: mapper.visits(node) })
    }

    /// The pose graph of a map at its layout: a pose for each place, an edge for each measured travel. `None` if not every
    /// place can be reached by measured travels.
    pub(super) fn pose_graph(
        &self,
        rank: usize,
        positions: &[Position],
        exploration: &Exploration,
    ) -> Result<Option<PoseGraph>, SearchFailure> {
        let map = &self.ranking[rank - 1].map;
        match self.mapper.as_ref().and_then(|mapper| mapper.pose_graph(map)) {
            Some(graph) => Ok(Some(graph)),
            None => Ok(place_by_odometry(exploration, positions)?.map(|placed| placed.graph)),
        }
    }

    /// What tells a map from the first one.
    pub(super) fn difference(&self, first: &Telling, second: &Telling) -> Option<MapDifference> {
        let experience = self.mapper.as_ref()?.experience();
        let hypotheses = [&first.hypothesis, &second.hypothesis];
        let positions = [first.positions.as_slice(), second.positions.as_slice()];
        Some(difference(&experience.catalog, hypotheses, positions))
    }

    /// The tree that was searched, with its best maps framed; maps are taken along up to `most_maps` nodes. `None` if it was
    /// only counted.
    pub(super) fn tree(&self, most_maps: usize) -> Option<SearchTree> {
        let mapper = self.mapper.as_ref()?;
        let best = self.ranking.iter().filter(|found| found.tied).map(|found| found.map.node);
        Some(SearchTree::of(mapper.tree(), mapper.experience(), &best.collect::<Vec<_>>(), most_maps))
    }

    /// All hypotheses made. `None` if they were only counted.
    pub(super) fn hypotheses(&self) -> Option<&Tree> {
        self.mapper.as_ref().map(|mapper| mapper.tree())
    }

    /// What the proof rests on, to be checked by another program. `None` if nothing is proved.
    pub(super) fn certificate_text(&self, exploration: &Exploration) -> Option<String> {
        self.mapper.as_ref()?.certificate(exploration)
    }
}

impl SearchMethod {
    /// What is sought, and in which order.
    fn objective_and_order(self) -> (SearchObjective, Order) {
        match self {
            SearchMethod::BreadthFirst | SearchMethod::Count => {
                (SearchObjective::Preference, Order::BreadthFirst)
            }
            SearchMethod::BestFirst => (SearchObjective::Preference, Order::BestFirst),
            SearchMethod::Cyclic => (SearchObjective::Preference, Order::Cyclic),
            SearchMethod::Proof => (SearchObjective::Preference, Order::Proof),
            SearchMethod::Posterior => (SearchObjective::Posterior, Order::Cyclic),
            SearchMethod::PosteriorBreadthFirst => (SearchObjective::Posterior, Order::BreadthFirst),
            SearchMethod::PosteriorBestFirst => (SearchObjective::Posterior, Order::BestFirst),
            SearchMethod::PosteriorProof => (SearchObjective::Posterior, Order::Proof),
        }
    }
}

fn search_order(order: Order) -> SearchOrder {
    match order {
        Order::BreadthFirst => SearchOrder::BreadthFirst,
        Order::BestFirst => SearchOrder::BestFirst,
        Order::Cyclic => SearchOrder::Cyclic,
        Order::Proof => SearchOrder::Proof,
    }
}

/// What preference looks at in a map.
pub(super) fn measured(measure: Measure) -> MapMeasure {
    let Measure { undetermined_boundaries, paths, places, genus } = measure;
    MapMeasure { undetermined_boundaries, paths, places, genus }
}

fn summary(
    report: &Report,
    objective: SearchObjective,
    order: SearchOrder,
    closed_only: bool,
) -> SearchSummary {
    let finals = &report.finals;
    SearchSummary {
        objective,
        order,
        closed_only,
        stop: report.stop,
        nodes: report.nodes,
        maps_made: report.maps,
        refuted: report.refuted,
        expanded: report.expanded,
        layouts: report.solved,
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

/// `measured` if the proof relies on measurements.
fn certificate(report: &Report, measured: bool) -> CertificateSummary {
    let mut trusted = vec![perception()];
    if let Some(proof) = report.proof.filter(|_| measured) {
        trusted.push(Trusted::held(
            Assumption::Covariances,
            "measured travels err as their covariances say, independently of one another".to_owned(),
        ));
        trusted.push(Trusted {
            assumption: Assumption::LinearEstimates,
            sentence: format!(
                "χ² rises by at least {LINEAR_TRUST} of what the linear estimate says; where the proof needs it and it was computed, it rose by at least \
                 {:.2} of it",
                proof.linear_factor
            ),
            held: proof.open_bound.is_none() || proof.linear_factor >= LINEAR_TRUST,
            least: Some(proof.linear_factor),
        });
        trusted.push(Trusted {
            assumption: Assumption::Layouts,
            sentence: "the layout of every hypothesis that matters can be computed, and is the best one"
                .to_owned(),
            held: !proof.unsolvable,
            least: None,
        });
    }
    let by_preference = report.finals.best.map(Score::Measure);
    CertificateSummary {
        proved: report.is_optimal,
        best: report.proof.map_or(by_preference, |proof| proof.best).and_then(worth),
        open: report.proof.and_then(|proof| proof.open_bound).and_then(worth),
        rest_probability: report.proof.and_then(|proof| proof.rest).filter(|rest| rest.is_finite()),
        trusted,
    }
}

/// Nothing if it is no finite number.
fn worth(score: Score) -> Option<Worth> {
    match score {
        Score::Measure(measure) => Some(Worth::Measure(measured(measure))),
        Score::Nats(nats) => nats.is_finite().then_some(Worth::Nats(nats)),
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
        first_place: first.place.number(),
        first_rotation: first.phi.rotation(),
        place: second.place.number(),
        rotation: second.phi.rotation(),
    };
    let end = |prediction: Prediction| match prediction {
        Prediction::Unknown => None,
        Prediction::Arrival { place, star, entry } => {
            let star = catalog.star(star);
            Some((
                EndReference { place: place.number(), end: star.name(entry).to_string() },
                star.to_string(),
            ))
        }
    };
    let map = &hypotheses[0].map;
    let exit = |gateway: &MapOlp| {
        let place = map.place(*gateway);
        EndReference {
            place: place.number(),
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
