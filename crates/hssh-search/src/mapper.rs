//! The on-line mapper: one visit at a time, its maps at any time.

use std::time::Instant;

use hssh_causal::Exploration;
use hssh_metrics::{PoseGraph, SolveError};
use hssh_topology::{Hypothesis, Position, Preference, Star};

use crate::branch::Branch;
use crate::builder::{MapperBuilder, MapperError, Objective};
use crate::certificate;
use crate::checkpoint::{Identity, Keeping, State, Unsealed};
use crate::context::Context;
use crate::crew::Crew;
use crate::cursor::Cursor;
use crate::distinction::{Distinction, distinguish};
use crate::elsewhere::Elsewhere;
use crate::engine::Engine;
use crate::experience::Experience;
use crate::kept::kept;
use crate::leaf::Appraise;
use crate::limits::{Limits, StopReason, Watch};
use crate::measured::MeasuredTravel;
use crate::order::Order;
use crate::pack::Pack;
use crate::posterior::{ByPosterior, Horizon, LINEAR_TRUST, Metrical, PosteriorModel, horizons};
use crate::preference::ByPreference;
use crate::report::{FinalCounts, Proof, RankedMap, Report};
use crate::tree::{NodeId, Tree};
use crate::visit::{MeasurementError, Visit, VisitError};

/// A search for either objective.
#[derive(Debug)]
enum Search {
    Preference(Box<Engine<ByPreference>>),
    Posterior(Box<Engine<ByPosterior>>),
}

/// Who appraises in a search for either objective.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Searching<'a> {
    Preference(&'a ByPreference),
    Posterior(&'a ByPosterior),
}

/// Does the same with the engine of either search.
macro_rules! with_engine {
    ($search:expr, $engine:ident => $work:expr) => {
        match $search {
            Search::Preference($engine) => $work,
            Search::Posterior($engine) => $work,
        }
    };
}

impl MapperBuilder {
    /// A mapper that has seen its first star, and knows no bearings of its ends.
    ///
    /// # Errors
    /// If the operating system gives no threads, or the axioms or the model make no sense.
    pub fn start(self, star: &Star) -> Result<Mapper, MapperError> {
        let watch = Watch::for_tree(self.limits, &self.monitor);
        Mapper::new(self, Experience::new(star, &[]), &watch)
    }

    /// A mapper that has seen its first star, with the bearings of its ends where they were measured, rad.
    ///
    /// # Errors
    /// If the operating system gives no threads, or the axioms or the model make no sense.
    ///
    /// # Panics
    /// If there are bearings, but not one for each end.
    pub fn start_with(self, star: &Star, bearings: &[Option<f64>]) -> Result<Mapper, MapperError> {
        assert!(bearings.is_empty() || bearings.len() == star.ends().len(), "one bearing for each end");
        let watch = Watch::for_tree(self.limits, &self.monitor);
        Mapper::new(self, Experience::new(star, bearings), &watch)
    }

    /// A mapper that has been through a whole exploration, and has searched its tree.
    ///
    /// # Errors
    /// If the operating system gives no threads, if the axioms or the model make no sense or it asks for measurements that are not there, or
    /// if there is no map and some layout cannot be computed.
    pub fn explain(self, exploration: &Exploration) -> Result<Mapper, MapperError> {
        let watch = Watch::for_tree(self.limits, &self.monitor);
        self.constraints.check(exploration.travels().len())?;
        let checkpoints = self.checkpoints.clone();
        let identity = || Identity::of(self.strategy(), &self, exploration);
        let mut keeping = Keeping::new(checkpoints, identity);
        let mut mapper = Mapper::new(self, Experience::from(exploration), &watch)?;
        mapper.begin(&keeping)?;
        mapper.go_on(&watch, &mut keeping);
        if let Some(problem) = with_engine!(&mapper.search, engine => engine.frontier.lost()) {
            return Err(MapperError::Lost(problem.to_string()));
        }
        match mapper.unsolvable() {
            Some((travels, problem)) if mapper.is_empty() => {
                Err(MapperError::Unsolvable { travels, problem: *problem })
            }
            _ => Ok(mapper),
        }
    }
}

/// The topological mapper: it keeps the tree of maps that explain what it was told.
///
/// ```
/// use hssh_search::{Mapper, Visit};
/// use hssh_topology::{Olp, Star};
///
/// // A corridor with a dead end on either side, walked to the end and back.
/// let west: Star = "0+ (0-)".parse()?;
/// let east: Star = "(0+) 0-".parse()?;
/// let mut mapper = Mapper::builder().start(&west)?;
/// mapper.observe(Visit::new(Olp::new(0), Olp::new(1), &east))?;
/// mapper.observe(Visit::new(Olp::new(1), Olp::new(0), &west))?;
/// mapper.advance();
/// let maps = mapper.maps(10);
/// assert_eq!(maps.len(), 1);
/// assert_eq!((maps[0].measure.places, maps[0].closed), (2, true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// With measured travels, it finds the most probable maps:
///
/// ```
/// use hssh_search::{Mapper, Order, PosteriorModel};
/// use hssh_world::{DriftModel, grid, snake};
///
/// let world = grid(3, 3, 8.0)?;
/// let route = world.route_through(&snake(3, 3))?;
/// let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1)?;
/// let model = PosteriorModel::evidence(&exploration).ok_or("no distance was measured")?;
/// let mapper = Mapper::builder().posterior(model).order(Order::Cyclic).explain(&exploration)?;
/// let best = &mapper.maps(1)[0];
/// assert_eq!(best.probable.as_ref().map(|probable| probable.poses.len()), Some(9));
/// assert!(mapper.report().is_optimal);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Mapper {
    options: MapperBuilder,
    experience: Experience,
    crew: Crew,
    search: Search,
    stop: StopReason,
    seconds: f64,
    /// How many observations there were when the search last went on.
    searched: usize,
}

impl Mapper {
    /// How to search, to begin with.
    #[must_use]
    pub fn builder() -> MapperBuilder {
        MapperBuilder::default()
    }

    /// A mapper that has not searched yet.
    pub(crate) fn new(
        options: MapperBuilder,
        experience: Experience,
        watch: &Watch,
    ) -> Result<Self, MapperError> {
        options.axioms.check()?;
        if let Objective::Posterior(model) = options.objective {
            model.check()?;
        }
        let crew = Crew::new(options.threads)?.helped(options.helpers.clone());
        let asks_for_boundaries =
            options.objective.asks_for_boundaries() || options.axioms.ask_for_boundaries();
        let experience = experience.with_boundaries(asks_for_boundaries);
        let experience = experience.with_constraints(options.constraints.clone());
        let context = Context { experience: &experience, axioms: &options.axioms, crew: &crew, watch };
        let MapperBuilder { order, goal, proving, .. } = options;
        let store = options.store.clone();
        let elsewhere = store.map(|store| Elsewhere::new(store, options.axioms));
        let search = match options.objective {
            Objective::Preference(preference) => {
                let appraiser = ByPreference { preference, order };
                Search::Preference(Box::new(Engine::new(
                    appraiser, order, goal, proving, elsewhere, context,
                )?))
            }
            Objective::Posterior(model) => {
                let appraiser = ByPosterior::new(model, options.appearance.clone(), order);
                Search::Posterior(Box::new(Engine::new(appraiser, order, goal, proving, elsewhere, context)?))
            }
        };
        let searched = experience.observations.len();
        let stop = StopReason::NotSearched;
        Ok(Mapper { options, experience, crew, search, stop, seconds: 0.0, searched })
    }

    /// One visit more. The maps follow with [`advance`](Self::advance).
    ///
    /// # Errors
    /// If it cannot have happened, or if the search asks for a measurement that is not there. The mapper is as it was
    /// then.
    pub fn observe(&mut self, visit: Visit) -> Result<(), VisitError> {
        self.experience.push(&visit)?;
        if let Err(problem) = self.check_last_travel() {
            self.experience.pop();
            return Err(problem.into());
        }
        if let Search::Posterior(engine) = &mut self.search {
            let appearance = &mut engine.appraiser.appearance;
            while appearance.visits() < self.experience.observations.len() {
                appearance.push(Vec::new());
            }
            if appearance.visits() == self.experience.observations.len() {
                appearance.push(visit.likeness);
            }
        }
        self.stop = StopReason::NotSearched;
        Ok(())
    }

    /// Whether the last travel is measured as the search asks.
    fn check_last_travel(&self) -> Result<(), MeasurementError> {
        let Objective::Posterior(PosteriorModel { metrical, .. }) = self.options.objective else {
            return Ok(());
        };
        if metrical == Metrical::Ignored {
            return Ok(());
        }
        let travel = self.experience.observations.len();
        let odometry = self.experience.odometry(travel - 1).ok_or(MeasurementError::Missing { travel })?;
        let measured = MeasuredTravel::of(odometry);
        measured.map(drop).map_err(|problem| MeasurementError::Covariance { travel, problem })
    }

    /// Searches on until everything observed is explained as well as was asked for, or a limit stops it. It may be called
    /// again after a limit, with other [limits](Self::set_limits) or a [reset](crate::Monitor::reset)
    /// monitor, to go on where it stopped; breadth-first goes on from its last complete level.
    pub fn advance(&mut self) -> StopReason {
        let watch = Watch::for_tree(self.options.limits, &self.options.monitor);
        self.go_on(&watch, &mut Keeping::default())
    }

    /// Puts the search where its checkpoint says that it is, if there is one.
    fn begin(&mut self, keeping: &Keeping) -> Result<(), MapperError> {
        let unlimited = Watch::without_limits();
        let Mapper { experience, crew, options, search, seconds, .. } = self;
        let context = Context { experience, axioms: &options.axioms, crew, watch: &unlimited };
        with_engine!(search, engine => {
            let read = |unsealed: &mut Unsealed<'_>| {
                let before: f64 = unsealed.take()?;
                let state = State::read(unsealed, engine.frontier.elsewhere.as_ref(), context)?;
                Ok((state.nodes(), (before, state)))
            };
            if let Some((before, state)) = keeping.begin(read)? {
                *seconds = before;
                engine.observe(context)?;
                state.restore(engine);
                options.monitor.goes_on(engine.tree.len() as u64, engine.fringe.depth.max(engine.deepest().unwrap_or(0)));
            }
        });
        Ok(())
    }

    /// Searches on under limits that have begun.
    fn go_on(&mut self, watch: &Watch, keeping: &mut Keeping) -> StopReason {
        let started = Instant::now();
        let travels = self.experience.observations.len();
        let Mapper { experience, crew, options, search, seconds, .. } = self;
        let context = Context { experience, axioms: &options.axioms, crew, watch };
        let span = tracing::info_span!("search", strategy = options.strategy(), travels);
        let _entered = span.enter();
        self.stop = with_engine!(search, engine => {
            let stop = engine.observe(context).expect("every travel was checked when it was observed");
            stop.unwrap_or_else(|| kept(engine, context, keeping, |pen| {
                pen.put(&(*seconds + started.elapsed().as_secs_f64()))
            }))
        });
        self.searched = with_engine!(&self.search, engine => engine.travels());
        self.seconds += started.elapsed().as_secs_f64();
        self.stop
    }

    /// Sets other limits, for the next [`advance`](Self::advance).
    pub fn set_limits(&mut self, limits: Limits) {
        self.options.limits = limits;
    }

    /// How many travels the maps explain: fewer than were observed if a limit stopped the search. Breadth-first has the
    /// maps of a complete level then, the last one that there was time to look through; all others have the best of the
    /// hypotheses that got farthest.
    #[must_use]
    pub fn explained(&self) -> usize {
        if self.options.order == Order::BreadthFirst {
            return with_engine!(&self.search, engine => engine.level().depth);
        }
        if !self.is_empty() || self.stop.is_complete() {
            return self.searched;
        }
        let deepest = with_engine!(&self.search, engine => engine.deepest());
        deepest.filter(|_| self.is_cut_short()).unwrap_or(0)
    }

    /// Whether a limit or an interruption stopped the search.
    fn is_cut_short(&self) -> bool {
        !self.stop.is_complete() && self.stop != StopReason::NotSearched
    }

    /// Whether no map was found.
    pub(crate) fn is_empty(&self) -> bool {
        with_engine!(&self.search, engine => engine.found.is_empty())
    }

    /// How many travels the first hypothesis explains that has no computable layout, and why it has none.
    pub(crate) fn unsolvable(&self) -> Option<(usize, &SolveError)> {
        let unsolvable = with_engine!(&self.search, engine => &engine.unsolvable);
        unsolvable.as_ref().map(|(travels, problem)| (*travels, problem))
    }

    /// The best maps that explain everything, equal ones in the order of their branches, at most
    /// that many. After a limit they explain the first [`explained`](Self::explained) travels.
    #[must_use]
    pub fn maps(&self, most: usize) -> Vec<RankedMap> {
        self.answer(most).1
    }

    /// The account of the search so far.
    #[must_use]
    pub fn report(&self) -> Report {
        self.answer(0).0
    }

    /// The account of the search and the best maps, for the price of one of them.
    #[must_use]
    pub fn answer(&self, most: usize) -> (Report, Vec<RankedMap>) {
        let watch = Watch::for_tree(self.options.limits, &self.options.monitor);
        let context = self.context(&watch);
        match &self.search {
            Search::Preference(engine) => {
                let preference = engine.appraiser.preference;
                if self.options.order == Order::BreadthFirst {
                    let (finals, maps) = engine.level().survey(&engine.tree, context, preference, most);
                    return (self.report_on(engine, finals, None), maps);
                }
                let (finals, maps) = self.survey(engine, preference, context, most);
                (self.report_on(engine, finals, None), maps)
            }
            Search::Posterior(engine) => {
                let (mut finals, mut maps) = self.survey(engine, Preference::default(), context, usize::MAX);
                let proof = self.proof_of_posterior(engine, context);
                let least = maps.first().and_then(RankedMap::nats).unwrap_or(0.0);
                let weight = |map: &RankedMap| map.nats().map_or(0.0, |nats| (least - nats).exp());
                let all: f64 = maps.iter().map(weight).sum();
                for map in &mut maps {
                    let at_most = weight(map) / all;
                    if let Some(probable) = &mut map.probable {
                        probable.at_most = at_most;
                        probable.at_least = at_most * (1.0 - proof.rest.unwrap_or(0.0));
                    }
                }
                finals.best = maps.first().map(|map| map.measure);
                if let Some(best) = engine.found.first() {
                    let tie = engine.appraiser.reach(best.leaf.key, 0.0);
                    finals.optimal = engine.found.iter().filter(|found| found.leaf.key <= tie).count() as u64;
                }
                maps.truncate(most);
                (self.report_on(engine, finals, Some(proof)), maps)
            }
        }
    }

    /// The hypothesis of a node of the tree.
    #[must_use]
    pub fn hypothesis(&self, node: NodeId) -> Hypothesis {
        let mut cursor = Cursor::new(&self.experience);
        cursor.go_to(node, self.tree(), &self.experience);
        cursor.into_hypothesis()
    }

    /// What identifies the hypothesis of a node anywhere: the choices that lead to it.
    #[must_use]
    pub fn branch(&self, node: NodeId) -> Branch {
        self.tree().choices(node)
    }

    /// Where the robot was in the map of a node, after each travel that it explains, the start first.
    #[must_use]
    pub fn visits(&self, node: NodeId) -> Vec<Position> {
        Cursor::new(&self.experience).visits(node, self.tree(), &self.experience)
    }

    /// What tells two maps apart.
    #[must_use]
    pub fn distinguish(&self, first: &RankedMap, second: &RankedMap) -> Distinction {
        let [first, second] = [first.node, second.node];
        let hypotheses = [&self.hypothesis(first), &self.hypothesis(second)];
        distinguish(&self.experience.catalog, hypotheses, [&self.visits(first), &self.visits(second)])
    }

    /// The pose graph of a map at its layout: a pose for each place, an edge for each travel, and the first pose
    /// anchored. `None` if nothing was laid out.
    #[must_use]
    pub fn pose_graph(&self, map: &RankedMap) -> Option<PoseGraph> {
        let Search::Posterior(engine) = &self.search else { return None };
        engine.appraiser.graph(&self.visits(map.node), &map.probable.as_ref()?.poses)
    }

    /// How far the bound sees along the branch of a map, the first place alone first: where a proof is stuck. `None` if nothing is
    /// measured, or a layout cannot be computed.
    #[must_use]
    pub fn horizons(&self, map: &RankedMap) -> Option<Vec<Horizon>> {
        let Search::Posterior(engine) = &self.search else { return None };
        let watch = Watch::without_limits();
        horizons(&engine.appraiser, &engine.tree, map.node, self.context(&watch)).ok()
    }

    /// What the proof rests on, as text that can be checked by itself: the branches left open with their bounds, the maps found, the
    /// parameters. `None` if the search has no bound, or if nothing is proved.
    #[must_use]
    pub fn certificate(&self, exploration: &Exploration) -> Option<String> {
        if !self.report().is_optimal {
            return None;
        }
        let watch = Watch::for_tree(self.options.limits, &self.options.monitor);
        let context = self.context(&watch);
        match &self.search {
            Search::Preference(engine) => {
                Some(certificate::by_preference(engine, &self.options, &self.experience, exploration))
            }
            Search::Posterior(engine) => {
                certificate::by_posterior(engine, &self.options, exploration, context)
            }
        }
    }

    /// The tree of all hypotheses made.
    #[must_use]
    pub fn tree(&self) -> &Tree {
        with_engine!(&self.search, engine => &engine.tree)
    }

    /// What the mapper was told.
    #[must_use]
    pub fn experience(&self) -> &Experience {
        &self.experience
    }

    /// What its search is given, and who appraises.
    pub(crate) fn searching<'a>(&'a self, watch: &'a Watch) -> (Context<'a>, Searching<'a>) {
        let searching = match &self.search {
            Search::Preference(engine) => Searching::Preference(&engine.appraiser),
            Search::Posterior(engine) => Searching::Posterior(&engine.appraiser),
        };
        (self.context(watch), searching)
    }

    /// What every search is given.
    fn context<'a>(&'a self, watch: &'a Watch) -> Context<'a> {
        let Mapper { experience, crew, options, .. } = self;
        Context { experience, axioms: &options.axioms, crew, watch }
    }

    /// The maps that were found, ranked, with counts over all of them; if a limit came before the first, the
    /// best hypothesis of those that got farthest.
    fn survey<A: Pack>(
        &self,
        engine: &Engine<A>,
        preference: Preference,
        context: Context<'_>,
        most: usize,
    ) -> (FinalCounts, Vec<RankedMap>) {
        let Context { experience, .. } = context;
        let mut counts = FinalCounts::default();
        let mut cursor = Cursor::new(experience);
        let mut maps = Vec::new();
        let is_partial = engine.found.is_empty() && self.is_cut_short();
        let partial = is_partial.then(|| engine.best_of_deepest(context)).flatten();
        for leaf in engine.found.iter().map(|found| &found.leaf).chain(&partial) {
            let node = leaf.node;
            let is_listed = maps.len() < most;
            let visited = (is_listed && A::WEIGHS).then(|| cursor.visited(node, &engine.tree, experience));
            let probable = visited.and_then(|visited| engine.appraiser.probable(leaf, visited));
            let map = &cursor.go_to(node, &engine.tree, experience).map;
            counts.record(map, preference);
            if is_listed {
                maps.push(RankedMap { probable, ..RankedMap::of(node, map) });
            }
        }
        (counts, maps)
    }

    /// What is proved. If a linear estimate promised too much somewhere beyond the best map, all that is open is laid out, unless that is
    /// more work than the proof was: the probability of the rest is then known all the same.
    fn proof_of_posterior(&self, engine: &Engine<ByPosterior>, context: Context<'_>) -> Proof {
        let proof = proof(engine);
        let is_known = proof.rest.is_none_or(|rest| rest < 1.0);
        if is_known || !proof.proved || self.is_cut_short() || engine.is_much_open() {
            return proof;
        }
        Proof { rest: certificate::rest_laid_out(engine, context).or(proof.rest), ..proof }
    }

    fn report_on<A: Pack>(
        &self,
        engine: &Engine<A>,
        finals: FinalCounts,
        proof_told: Option<Proof>,
    ) -> Report {
        let levels = engine.tally.levels.clone();
        let order = self.options.order;
        let has_bound = A::WEIGHS || matches!(order, Order::Cyclic | Order::Proof);
        let proof = proof_told.or_else(|| has_bound.then(|| proof(engine)));
        let is_exhausted = order == Order::BreadthFirst && self.stop == StopReason::Exhausted;
        Report {
            strategy: self.options.strategy(),
            stop: self.stop,
            travels: self.experience.observations.len() as u64,
            explained: self.explained() as u64,
            nodes: levels.iter().map(|level| level.nodes).sum(),
            maps: levels.iter().map(|level| level.maps).sum(),
            refuted: levels.iter().map(|level| level.refuted).sum(),
            expanded: engine.tally.expanded,
            solved: engine.solved,
            finals,
            rejected: engine.rejected.len() as u64,
            is_optimal: proof.map_or(is_exhausted, |proof| proof.proved),
            removals: engine.tally.removals,
            proof,
            levels,
            seconds: self.seconds,
            bytes: engine.tree.bytes() + engine.bytes,
        }
    }
}

/// What is known about the answer of a search whose keys are bounds.
pub(crate) fn proof<A: Pack>(engine: &Engine<A>) -> Proof {
    let Engine { appraiser, found, factors, reach, .. } = engine;
    let unsolvable = engine.unsolvable.is_some();
    let best = found.first().map(|found| found.leaf.key);
    let open_bound = engine.open_bound();
    let beats_rest = |best| open_bound.is_none_or(|bound| bound > appraiser.reach(best, 0.0));
    // A promise that was too high does no harm where even the truth is too high: to the proof beyond the best map, whatever was
    // looked at for the rest's probability, and to that beyond its reach.
    let least_within = |reach: &Option<A::Key>| {
        let within = factors.iter().filter(|(bound, _)| reach.is_none() || bound <= reach);
        within.map(|&(_, factor)| factor).fold(1.0, f64::min)
    };
    let last = found.get(engine.proving.best.max(1) - 1);
    let linear_factor = least_within(&last.map(|last| appraiser.reach(last.leaf.key, 0.0)));
    let is_rest_sound = open_bound.is_none() || least_within(reach) >= LINEAR_TRUST;
    let is_sound = open_bound.is_none() || linear_factor >= LINEAR_TRUST;
    Proof {
        best: best.map(|best| appraiser.score(best)),
        open_bound: open_bound.map(|bound| appraiser.score(bound)),
        proved: engine.is_begun() && is_sound && !unsolvable && best.map_or(open_bound.is_none(), beats_rest),
        // Nobody knows what the hypotheses weigh that have no layout.
        rest: engine
            .rest()
            .map(|rest| if unsolvable || !is_rest_sound || !engine.is_begun() { 1.0 } else { rest }),
        linear_factor,
        unsolvable,
    }
}
