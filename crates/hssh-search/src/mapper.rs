//! The on-line mapper: one observation at a time, its maps at any time.

use std::sync::Arc;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_topology::{
    Axioms, Hypothesis, Measure, Observation, Olp, Position, Preference, Star, StarCatalog, TopologicalMap,
};
use serde::{Deserialize, Serialize};

use crate::best_first::BestFirst;
use crate::breadth_first::BreadthFirst;
use crate::context::Context;
use crate::count::count;
use crate::crew::Crew;
use crate::experience::Experience;
use crate::limits::{Limits, Monitor, StopReason, Watch};
use crate::proof::Proof;
use crate::report::{FinalCounts, Report, Tally};
use crate::tree::{Cursor, NodeId, Tree};

/// What best-first is content with.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// Any map that explains everything.
    #[default]
    AnyMap,
    /// A closed map: if the best map that explains everything is not closed, the search goes back and
    /// on with the next best hypothesis. This is the thesis's backtracking (section 3.4).
    ClosedMap,
}

impl Goal {
    pub(crate) fn accepts(self, closed: bool) -> bool {
        closed || self == Goal::AnyMap
    }
}

/// How the tree is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// All hypotheses, level by level.
    #[default]
    BreadthFirst,
    /// The best hypothesis by preference first. It may miss the optimum.
    BestFirst(Goal),
    /// The hypothesis with the least admissible bound first, until the answer is proved. The bound
    /// looks ahead to the last travel, so that the search starts anew when there is another one.
    Proof(Goal),
}

impl Strategy {
    fn name(self) -> &'static str {
        match self {
            Strategy::BreadthFirst => "breadth-first",
            Strategy::BestFirst(Goal::AnyMap) => "best-first",
            Strategy::BestFirst(Goal::ClosedMap) => "best-first, back until closed",
            Strategy::Proof(Goal::AnyMap) => "best-first with proof",
            Strategy::Proof(Goal::ClosedMap) => "best-first with proof, closed maps",
        }
    }
}

/// The operating system gave no threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start the threads of the search: {0}")]
pub struct ThreadsError(#[from] rayon::ThreadPoolBuildError);

/// An observation that cannot have been made.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ObservationError {
    /// The star has no such end.
    #[error("the star {star} has no end number {olp}")]
    NoSuchEnd {
        /// The star.
        star: Star,
        /// The end asked for.
        olp: Olp,
    },
    /// The end is closed.
    #[error("the end {} of the star {star} is closed", star.name(*.olp))]
    ClosedEnd {
        /// The star.
        star: Star,
        /// The closed end.
        olp: Olp,
    },
}

/// One explanation of everything observed, with what ranks it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RankedMap {
    /// The hypothesis in the mapper's tree.
    pub node: NodeId,
    /// What preference looks at.
    pub measure: Measure,
    /// No gateway is pending.
    pub closed: bool,
    /// No gateway is pending on a path with a single place.
    pub nearly_closed: bool,
}

impl RankedMap {
    pub(crate) fn of(node: NodeId, map: &TopologicalMap) -> Self {
        let measure = Measure::of(map);
        RankedMap { node, measure, closed: map.is_closed(), nearly_closed: map.is_nearly_closed() }
    }
}

/// How a [`Mapper`] is to search. The default is breadth-first with the thesis's axioms and
/// preference, on one thread, without limits.
#[derive(Clone, Debug)]
pub struct MapperBuilder {
    axioms: Axioms,
    preference: Preference,
    strategy: Strategy,
    limits: Limits,
    threads: usize,
    monitor: Arc<Monitor>,
}

impl Default for MapperBuilder {
    fn default() -> Self {
        MapperBuilder {
            axioms: Axioms::default(),
            preference: Preference::default(),
            strategy: Strategy::default(),
            limits: Limits::default(),
            threads: 1,
            monitor: Arc::default(),
        }
    }
}

impl MapperBuilder {
    /// The axioms that maps have to satisfy.
    #[must_use]
    pub fn axioms(self, axioms: Axioms) -> Self {
        MapperBuilder { axioms, ..self }
    }

    /// The order of preference.
    #[must_use]
    pub fn preference(self, preference: Preference) -> Self {
        MapperBuilder { preference, ..self }
    }

    /// How to search.
    #[must_use]
    pub fn strategy(self, strategy: Strategy) -> Self {
        MapperBuilder { strategy, ..self }
    }

    /// When to stop before the end.
    #[must_use]
    pub fn limits(self, limits: Limits) -> Self {
        MapperBuilder { limits, ..self }
    }

    /// How many threads, 0 for one per core. The result does not depend on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        MapperBuilder { threads, ..self }
    }

    /// A window on the search for other threads.
    #[must_use]
    pub fn monitor(self, monitor: Arc<Monitor>) -> Self {
        MapperBuilder { monitor, ..self }
    }

    /// A mapper that has seen its first star.
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub fn start(self, star: &Star) -> Result<Mapper, ThreadsError> {
        let mut catalog = StarCatalog::new();
        let start = catalog.intern(star);
        self.resume(Experience { catalog, start, observations: Vec::new() })
    }

    /// A mapper that has been through a whole exploration, and has searched its tree.
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub fn explain(self, exploration: &Exploration) -> Result<Mapper, ThreadsError> {
        let mut mapper = self.resume(Experience::from(exploration))?;
        mapper.advance();
        Ok(mapper)
    }

    /// Counts all hypotheses about an exploration and keeps none, in memory that does not grow with their
    /// number. The strategy does not matter.
    ///
    /// A limit or an interruption ends the count early; the report then covers the branches of the
    /// tree that were counted to their end, and is the same for any number of threads if it was the
    /// limit on nodes.
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub fn count(self, exploration: &Exploration) -> Result<Report, ThreadsError> {
        let experience = &Experience::from(exploration);
        let crew = Crew::new(self.threads)?;
        let watch = Watch::start(self.limits, &self.monitor);
        let (axioms, preference) = (&self.axioms, self.preference);
        Ok(count(Context { experience, axioms, preference, crew: &crew, watch: &watch }))
    }

    fn resume(self, experience: Experience) -> Result<Mapper, ThreadsError> {
        let crew = Crew::new(self.threads)?;
        let search = Search::new(self.strategy, self.preference);
        Ok(Mapper {
            options: self,
            experience,
            crew,
            tree: Tree::new(),
            search,
            tally: Tally::new(),
            stop: StopReason::Exhausted,
            seconds: 0.0,
            searched: 0,
        })
    }
}

#[derive(Debug)]
enum Search {
    BreadthFirst(BreadthFirst),
    BestFirst(BestFirst),
    Proof(Proof),
}

impl Search {
    fn new(strategy: Strategy, preference: Preference) -> Self {
        match strategy {
            Strategy::BreadthFirst => Search::BreadthFirst(BreadthFirst::default()),
            Strategy::BestFirst(goal) => Search::BestFirst(BestFirst::new(goal, preference)),
            Strategy::Proof(goal) => Search::Proof(Proof::new(goal, preference)),
        }
    }
}

/// The topological mapper: it keeps the tree of maps that explain what it was told.
///
/// ```
/// use hssh_search::Mapper;
/// use hssh_topology::{Olp, Star};
///
/// // A corridor with a dead end on either side, walked to the end and back.
/// let west: Star = "0+ (0-)".parse()?;
/// let east: Star = "(0+) 0-".parse()?;
/// let mut mapper = Mapper::builder().start(&west)?;
/// mapper.observe(Olp::new(0), Olp::new(1), &east)?;
/// mapper.observe(Olp::new(1), Olp::new(0), &west)?;
/// mapper.advance();
/// let maps = mapper.maps(10);
/// assert_eq!(maps.len(), 1);
/// assert_eq!((maps[0].measure.places, maps[0].closed), (2, true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Mapper {
    options: MapperBuilder,
    experience: Experience,
    crew: Crew,
    tree: Tree,
    search: Search,
    tally: Tally,
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

    /// One travel more: the robot left by an end of the star it saw last and came into a place with
    /// this star by an end of it. The maps follow with [`advance`](Self::advance).
    ///
    /// # Errors
    /// If an end does not exist or is closed.
    pub fn observe(&mut self, exit: Olp, entry: Olp, star: &Star) -> Result<(), ObservationError> {
        let last = self.experience.observations.last();
        let here = last.map_or(self.experience.start, |observation| observation.star);
        usable(self.experience.catalog.star(here), exit)?;
        usable(star, entry)?;
        let star = self.experience.catalog.intern(star);
        self.experience.observations.push(Observation { exit, entry, star });
        self.stop = StopReason::NotSearched;
        Ok(())
    }

    /// Searches on until everything observed is explained, or a limit stops it. It may be called
    /// again after a limit, with other [limits](Self::set_limits) or a [reset](Monitor::reset)
    /// monitor, to go on where it stopped; breadth-first goes on from its last complete level.
    pub fn advance(&mut self) -> StopReason {
        let started = Instant::now();
        let travels = self.experience.observations.len();
        let watch = Watch::for_tree(self.options.limits, &self.options.monitor);
        let MapperBuilder { axioms, preference, strategy, .. } = &self.options;
        let context = Context {
            experience: &self.experience,
            axioms,
            preference: *preference,
            crew: &self.crew,
            watch: &watch,
        };
        let is_news = std::mem::replace(&mut self.searched, travels) < travels;
        let span = tracing::info_span!("search", strategy = strategy.name(), travels);
        let _entered = span.enter();
        self.stop = match &mut self.search {
            Search::BreadthFirst(search) => loop {
                if search.depth == travels {
                    break StopReason::Exhausted;
                }
                let grown = search.grow(&mut self.tree, context, &mut self.tally);
                tracing::debug!(explained = search.depth, fringe = search.fringe.len(), "level");
                if let Err(reason) = grown {
                    break reason;
                }
            },
            Search::BestFirst(search) => {
                if is_news {
                    search.reopen();
                }
                search.advance(&mut self.tree, context, &mut self.tally)
            }
            Search::Proof(search) => {
                if is_news {
                    // Bounds look ahead to the last travel: another one makes them all anew.
                    let Strategy::Proof(goal) = *strategy else { unreachable!("the search is a proof") };
                    *search = Proof::new(goal, *preference);
                    (self.tree, self.tally, self.seconds) = (Tree::new(), Tally::new(), 0.0);
                    self.crew.recall();
                }
                search.advance(&mut self.tree, context, &mut self.tally)
            }
        };
        self.seconds += started.elapsed().as_secs_f64();
        self.stop
    }

    /// Sets other limits, for the next [`advance`](Self::advance).
    pub fn set_limits(&mut self, limits: Limits) {
        self.options.limits = limits;
    }

    /// How many travels the maps explain: fewer than were observed if a limit stopped the search, and
    /// none if best-first has no map yet.
    #[must_use]
    pub fn explained(&self) -> usize {
        let has_maps = match &self.search {
            Search::BreadthFirst(search) => return search.depth,
            Search::BestFirst(search) => !search.maps().is_empty(),
            Search::Proof(search) => !search.maps().is_empty(),
        };
        if has_maps || self.stop.is_complete() { self.searched } else { 0 }
    }

    /// The best maps that explain everything, in order of preference and then of creation, at most
    /// that many. After a limit they explain the first [`explained`](Self::explained) travels.
    #[must_use]
    pub fn maps(&self, most: usize) -> Vec<RankedMap> {
        self.survey(most).1
    }

    /// The account of the search so far.
    #[must_use]
    pub fn report(&self) -> Report {
        self.answer(0).0
    }

    /// The account of the search and the best maps, for the price of one of them.
    #[must_use]
    pub fn answer(&self, most: usize) -> (Report, Vec<RankedMap>) {
        let (finals, maps) = self.survey(most);
        (self.report_on(finals), maps)
    }

    fn survey(&self, most: usize) -> (FinalCounts, Vec<RankedMap>) {
        let preference = self.options.preference;
        let nodes = match &self.search {
            Search::BreadthFirst(search) => {
                return search.survey(&self.tree, &self.experience, &self.crew, preference, most);
            }
            Search::BestFirst(search) => search.maps(),
            Search::Proof(search) => search.maps(),
        };
        let mut counts = FinalCounts::default();
        let mut cursor = Cursor::new(&self.experience);
        let mut maps: Vec<RankedMap> = Vec::new();
        for node in nodes {
            let map = &cursor.go_to(node, &self.tree, &self.experience).map;
            counts.record(map, preference);
            maps.push(RankedMap::of(node, map));
        }
        maps.sort_by_key(|map| (preference.rank(map.measure), map.node));
        maps.truncate(most);
        (counts, maps)
    }

    /// The hypothesis of a node of the tree.
    #[must_use]
    pub fn hypothesis(&self, node: NodeId) -> Hypothesis {
        let mut cursor = Cursor::new(&self.experience);
        cursor.go_to(node, &self.tree, &self.experience);
        cursor.into_hypothesis()
    }

    /// Where the robot was in the map of a node, after each travel that it explains, the start first.
    #[must_use]
    pub fn visits(&self, node: NodeId) -> Vec<Position> {
        Cursor::new(&self.experience).visits(node, &self.tree, &self.experience)
    }

    /// The tree of all hypotheses made.
    #[must_use]
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// What the mapper was told.
    #[must_use]
    pub fn experience(&self) -> &Experience {
        &self.experience
    }

    fn report_on(&self, finals: FinalCounts) -> Report {
        let levels = self.tally.levels.clone();
        let nodes = levels.iter().map(|level| level.nodes).sum();
        let expanded = self.tally.expanded;
        Report {
            strategy: self.options.strategy.name(),
            stop: self.stop,
            travels: self.experience.observations.len() as u64,
            explained: self.explained() as u64,
            nodes,
            maps: levels.iter().map(|level| level.maps).sum(),
            refuted: levels.iter().map(|level| level.refuted).sum(),
            expanded,
            finals,
            rejected: match &self.search {
                Search::BreadthFirst(_) => 0,
                Search::BestFirst(search) => search.rejected(),
                Search::Proof(search) => search.rejected(),
            },
            is_optimal: match self.stop {
                StopReason::Exhausted => matches!(self.search, Search::BreadthFirst(_)),
                stop => stop == StopReason::Proved,
            },
            removals: self.tally.removals,
            certificate: match &self.search {
                Search::Proof(search) => Some(search.certificate(expanded)),
                _ => None,
            },
            levels,
            seconds: self.seconds,
            tree_bytes: self.tree.bytes(),
        }
    }
}

fn usable(star: &Star, olp: Olp) -> Result<(), ObservationError> {
    if olp.number() >= star.degree() {
        return Err(ObservationError::NoSuchEnd { star: star.clone(), olp });
    }
    if star.is_travelable(olp) {
        return Ok(());
    }
    Err(ObservationError::ClosedEnd { star: star.clone(), olp })
}
