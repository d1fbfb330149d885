//! The search for the most probable accounts of an exploration with errors.

use std::fmt::Debug;
use std::sync::Arc;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_metrics::Pose;
use hssh_topology::{Axioms, Chart, PlaceId, ReadingModel, TopologicalMap};

use crate::builder::MapperError;
use crate::checkpoint::{Checkpoints, Identity, Keeping, State, write_state};
use crate::constraints::VisitConstraints;
use crate::context::Context;
use crate::crew::Crew;
use crate::elsewhere::{Elsewhere, Store};
use crate::engine::Engine;
use crate::experience::Experience;
use crate::kept::kept;
use crate::limits::{Limits, Monitor, StopReason, Watch};
use crate::mapper::proof;
use crate::order::{Goal, Order, Proving};
use crate::posterior::{Cost, MapPrior, PosteriorModel};
use crate::reading::by_reading::ByReading;
use crate::reading::state::{Passage, State as Told};
use crate::report::Proof;

/// How far bearings of one end lie apart that was seen twice: rad.
const BEARING_DEVIATION: f64 = 0.35;

/// How to search for accounts of an exploration in which perception may have erred.
#[derive(Clone, Debug)]
pub struct Reader {
    /// What makes a map probable. Its prior is taken to be flat: errors have their own prices.
    pub model: PosteriorModel,
    /// What errors of perception cost.
    pub reading: ReadingModel,
    /// The standard deviation of bearings of one end: rad. Without one they do not count.
    pub bearing_deviation: Option<f64>,
    /// The axioms that maps have to satisfy.
    pub axioms: Axioms,
    /// Which visits are known from elsewhere to be to one place, and which are not.
    pub constraints: VisitConstraints,
    /// How many of the best accounts are to be found and proved.
    pub best: usize,
    /// Without a proof, stop when the best account has been the best for so many expansions.
    pub patience: Option<u64>,
    /// When to stop before the end.
    pub limits: Limits,
    /// How many threads, 0 for one per core.
    pub threads: usize,
    /// A window on the search for other threads.
    pub monitor: Arc<Monitor>,
    /// Where its state is kept from time to time. It goes on from the checkpoint that is there, if there is one, with the answer of a search
    /// that was never interrupted; the last one, when the search has come to its end, has the answer.
    pub checkpoints: Option<Checkpoints>,
    /// Where open accounts are kept for which the limit on memory leaves no room.
    pub store: Option<Arc<dyn Store>>,
}

/// What a search for accounts came to.
#[derive(Clone, Debug)]
pub struct ReadAnswer {
    /// The accounts found, the best first. Those that come to the same map by other errors are left out.
    pub maps: Vec<ReadMap>,
    /// Why the search stopped.
    pub stop: StopReason,
    /// How many accounts were made.
    pub nodes: u64,
    /// How many were gone on from.
    pub expanded: u64,
    /// The same when the best account was found.
    pub found_after: u64,
    /// What is known about the answer.
    pub proof: Proof,
    /// Time spent searching.
    pub seconds: f64,
}

/// One account of an exploration.
#[derive(Clone, Debug)]
pub struct ReadMap {
    /// What it costs, errors included.
    pub cost: Cost,
    /// Its share of the probability of all accounts that were found: what it has at most.
    pub at_most: f64,
    /// What there is.
    pub chart: Chart,
    /// The map that it makes.
    pub map: TopologicalMap,
    /// By place: its frame in that of the first place; that of a place that was only passed is made up, between its neighbors. `None` if
    /// nothing was measured.
    pub poses: Vec<Option<Pose>>,
    /// By end of the chart: its bearing in the frame of its place, where it was measured, rad.
    pub bearings: Vec<Option<f64>>,
    /// How each travel is explained.
    pub passages: Vec<Passage>,
}

impl ReadMap {
    /// Where the robot was on each visit, the start first; `None` where the report is of no place.
    #[must_use]
    pub fn visits(&self) -> Vec<Option<PlaceId>> {
        let rest = self.passages.iter().map(|passage| passage.place);
        std::iter::once(Some(PlaceId::new(0))).chain(rest).collect()
    }

    /// Whether everything was explained without an error.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.passages.iter().all(|passage| passage.way.is_exact())
    }
}

impl Reader {
    /// With the usual prices, axioms and no limits.
    #[must_use]
    pub fn new(model: PosteriorModel) -> Self {
        Reader {
            model: PosteriorModel { prior: MapPrior::Flat, ..model },
            reading: ReadingModel::default(),
            bearing_deviation: Some(BEARING_DEVIATION),
            axioms: Axioms::default(),
            constraints: VisitConstraints::default(),
            best: 1,
            patience: None,
            limits: Limits::default(),
            threads: 1,
            monitor: Arc::default(),
            checkpoints: None,
            store: None,
        }
    }

    /// Without any errors of perception.
    #[must_use]
    pub fn exact(self) -> Self {
        Reader { reading: ReadingModel::EXACT, bearing_deviation: None, ..self }
    }

    /// Searches for the most probable accounts of an exploration.
    ///
    /// # Errors
    /// If a model makes no sense, measurements are missing, or the operating system gives no threads.
    pub fn read(&self, exploration: &Exploration) -> Result<ReadAnswer, MapperError> {
        self.model.check()?;
        self.reading.check()?;
        self.axioms.check()?;
        let started = Instant::now();
        let model = PosteriorModel { prior: MapPrior::Flat, ..self.model };
        self.constraints.check(exploration.travels().len())?;
        let experience = Experience::from(exploration).with_constraints(self.constraints.clone());
        let crew = Crew::new(self.threads)?;
        let watch = Watch::for_tree(self.limits, &self.monitor);
        let context = Context { experience: &experience, axioms: &self.axioms, crew: &crew, watch: &watch };
        let appraiser = ByReading::new(model, self.reading, self.bearing_deviation, &experience);
        let proving = Proving { best: self.best, rest: 1.0, patience: self.patience };
        let elsewhere = self.store.clone().map(|store| Elsewhere::new(store, self.axioms));
        let mut engine = Engine::new(appraiser, Order::Cyclic, Goal::AnyMap, proving, elsewhere, context)?;
        let mut keeping = Keeping::new(self.checkpoints.clone(), || self.identity(exploration));
        let before = self.go_on(&mut engine, &keeping, context)?;
        let seconds = || before + started.elapsed().as_secs_f64();
        let stop = match engine.observe(context)? {
            Some(stop) => stop,
            None => {
                let stop = kept(&mut engine, context, &mut keeping, |pen| pen.put(&seconds()));
                if stop.is_complete() {
                    // What follows may be ended, too, and is not to wait for this again.
                    keeping.keep(|pen| {
                        pen.put(&seconds())?;
                        write_state(&engine, pen)
                    });
                }
                stop
            }
        };
        if let Some(problem) = engine.frontier.lost() {
            return Err(MapperError::Lost(problem.to_string()));
        }
        if let Some((travels, problem)) = engine.unsolvable.filter(|_| engine.found.is_empty()) {
            return Err(MapperError::Unsolvable { travels, problem });
        }
        Ok(ReadAnswer {
            maps: maps(&engine),
            stop,
            nodes: engine.tree.len() as u64,
            expanded: engine.tally.expanded,
            found_after: engine.sweep.best_since,
            proof: proof(&engine),
            seconds: seconds(),
        })
    }

    /// Tells it from other searches. Its limits and threads may be others when it goes on.
    fn identity(&self, exploration: &Exploration) -> Identity {
        let Reader { model, reading, bearing_deviation, axioms, constraints, best, patience, .. } = self;
        let matters: [&dyn Debug; 7] =
            [model, reading, bearing_deviation, axioms, constraints, best, patience];
        Identity::told("accounts with errors of perception".to_owned(), &matters, exploration)
    }

    /// Puts the search where its checkpoint says that it is, if there is one; how many seconds it took until then.
    fn go_on(
        &self,
        engine: &mut Engine<ByReading>,
        keeping: &Keeping,
        context: Context<'_>,
    ) -> Result<f64, MapperError> {
        let kept = keeping.begin(|unsealed| {
            let before: f64 = unsealed.take()?;
            let state = State::read(unsealed, engine.frontier.elsewhere.as_ref(), context)?;
            Ok((state.nodes(), (before, state)))
        })?;
        let Some((before, state)) = kept else { return Ok(0.0) };
        let unlimited = Watch::without_limits();
        engine.observe(Context { watch: &unlimited, ..context })?;
        state.restore(engine);
        self.monitor.goes_on(engine.tree.len() as u64, engine.deepest().unwrap_or(0));
        Ok(before)
    }
}

/// The accounts found, each map once.
fn maps(engine: &Engine<ByReading>) -> Vec<ReadMap> {
    let mut maps: Vec<ReadMap> = Vec::new();
    let mut weights: Vec<f64> = Vec::new();
    let least = engine.found.first().map_or(0.0, |found| found.leaf.load.cost.total());
    for found in &engine.found {
        let Some((state, map)) = engine.appraiser.done(&found.leaf) else { continue };
        let cost = found.leaf.load.cost;
        let weight = (least - cost.total()).exp();
        let read = read_map(state, map, cost);
        match maps.iter().position(|other| is_same(other, &read)) {
            Some(known) => weights[known] += weight,
            None => {
                maps.push(read);
                weights.push(weight);
            }
        }
    }
    let all: f64 = weights.iter().sum();
    maps.iter_mut().zip(weights).for_each(|(map, weight)| map.at_most = weight / all);
    maps
}

fn read_map(state: &Told, map: &TopologicalMap, cost: Cost) -> ReadMap {
    let chart = &state.account.chart;
    let is_laid_out = state.layout.poses.iter().any(|pose| pose != Pose::IDENTITY);
    let mut poses: Vec<Option<Pose>> =
        chart.places().map(|place| state.located(place).filter(|_| is_laid_out)).collect();
    if is_laid_out {
        place_between(chart, &mut poses);
    }
    let mut bearings = vec![None; chart.end_count()];
    for &end in chart.places().flat_map(|place| chart.ends_of(place)) {
        bearings[end.index()] =
            state.bearing(end).filter(|bearing| bearing.measured).map(|bearing| bearing.angle);
    }
    ReadMap {
        cost,
        at_most: 1.0,
        chart: chart.clone(),
        map: map.clone(),
        poses,
        bearings,
        passages: state.passages(),
    }
}

/// Places that were only passed lie halfway between those that they are linked to.
fn place_between(chart: &Chart, poses: &mut [Option<Pose>]) {
    loop {
        let mut any = false;
        for place in chart.places() {
            let linked = chart.open_ends_of(place).filter_map(|end| chart.end(end).link);
            let around: Vec<Pose> = linked.filter_map(|end| poses[chart.end(end).place.index()]).collect();
            if poses[place.index()].is_none() && !around.is_empty() {
                let mean = |of: fn(&Pose) -> f64| around.iter().map(of).sum::<f64>() / around.len() as f64;
                poses[place.index()] = Some(Pose::new(mean(|pose| pose.x), mean(|pose| pose.y), 0.0));
                any = true;
            }
        }
        if !any {
            return;
        }
    }
}

/// Whether two accounts make the same map of the same visits.
fn is_same(one: &ReadMap, other: &ReadMap) -> bool {
    let renumbered = |read: &ReadMap| {
        let mut numbers = std::collections::BTreeMap::new();
        let visits: Vec<Option<usize>> = read
            .visits()
            .into_iter()
            .map(|place| {
                let next = numbers.len();
                place.map(|place| *numbers.entry(place).or_insert(next))
            })
            .collect();
        let mut links: Vec<[Option<usize>; 2]> = read
            .chart
            .links()
            .iter()
            .map(|link| {
                let mut ends = link.map(|end| numbers.get(&read.chart.end(end).place).copied());
                ends.sort_unstable();
                ends
            })
            .collect();
        links.sort_unstable();
        (visits, links)
    };
    one.map.place_count() == other.map.place_count() && renumbered(one) == renumbered(other)
}
