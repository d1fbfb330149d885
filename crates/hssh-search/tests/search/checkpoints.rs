//! A search that goes on from a checkpoint ends as one that was never interrupted, whenever the checkpoint was written.

use std::io::{self, Cursor, Write};
use std::sync::{Arc, LazyLock, Mutex};
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_metrics::Pose;
use hssh_search::{
    CheckpointError, Checkpoints, Keeper, Limits, MapPrior, Mapper, MapperBuilder, MapperError, Monitor,
    Order, PosteriorModel, Proving, RankedMap, ReadAnswer, Reader, Report, Source, StopReason,
};
use hssh_topology::{Axioms, Derivation, Outcome, Simplicity};
use hssh_world::{DriftModel, ErrorRates, grid, snake};
use proptest::prelude::*;

use crate::cases::{grid_walk, planar};
use crate::threads::STRATEGIES;

/// Keeps all checkpoints in memory, and gives the last one.
#[derive(Debug, Default)]
pub(crate) struct Shelf(Mutex<Vec<Vec<u8>>>);

impl Keeper for Shelf {
    fn keep(&self, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) {
        let mut bytes = Vec::new();
        write(&mut bytes).unwrap();
        self.0.lock().unwrap().push(bytes);
    }

    fn kept(&self) -> io::Result<Option<Box<dyn Source>>> {
        let last = self.0.lock().unwrap().last().cloned();
        Ok(last.map(|bytes| Box::new(Cursor::new(bytes)) as Box<dyn Source>))
    }
}

impl Shelf {
    pub(crate) fn with(bytes: Vec<u8>) -> Arc<Self> {
        Arc::new(Shelf(Mutex::new(vec![bytes])))
    }

    pub(crate) fn take(&self) -> Vec<Vec<u8>> {
        std::mem::take(&mut self.0.lock().unwrap())
    }
}

pub(crate) fn kept_by(search: MapperBuilder, keeper: &Arc<Shelf>, every: Duration) -> MapperBuilder {
    let keeper: Arc<dyn Keeper> = Arc::clone(keeper) as Arc<dyn Keeper>;
    search.checkpoints(Checkpoints { keeper, every })
}

pub(crate) const SELDOM: Duration = Duration::from_secs(1000);

/// Everything that a search has to say but the time that it took.
#[derive(PartialEq, Debug)]
pub(crate) struct End {
    report: Report,
    maps: Vec<RankedMap>,
    certificate: Option<String>,
    tree: Vec<(Option<Derivation>, Outcome)>,
    poses: Vec<Vec<Pose>>,
}

pub(crate) fn end(mapper: &Mapper, exploration: &Exploration) -> End {
    let tree = mapper.tree();
    let maps = mapper.maps(usize::MAX);
    End {
        report: timeless(mapper.report()),
        certificate: mapper.certificate(exploration),
        tree: tree.nodes().map(|node| (tree.derivation(node), tree.outcome(node))).collect(),
        poses: maps.iter().filter_map(|map| Some(map.probable.as_ref()?.poses.clone())).collect(),
        maps,
    }
}

fn timeless(report: Report) -> Report {
    Report { seconds: 0.0, ..report }
}

/// Stopped after so many nodes each time, and gone on with from the checkpoint, by another mapper; in how many pieces.
fn in_pieces(search: &MapperBuilder, exploration: &Exploration, nodes: u64) -> (Mapper, u64) {
    let shelf = Arc::new(Shelf::default());
    for piece in 1.. {
        let limits = Limits { nodes: Some(piece * nodes), ..Limits::default() };
        // Who works on does not matter.
        let search = search.clone().limits(limits).threads(1 + (piece % 2) as usize);
        let mapper = kept_by(search, &shelf, SELDOM).explain(exploration).unwrap();
        if mapper.report().stop != StopReason::NodeLimit {
            return (mapper, piece);
        }
    }
    unreachable!()
}

/// How often it was stopped.
fn goes_on_as_if_nothing_had_been(search: &MapperBuilder, exploration: &Exploration) -> u64 {
    let whole = search.clone().explain(exploration).unwrap();
    let nodes = (whole.report().nodes / 5).max(1);
    let whole = end(&whole, exploration);
    let (last, pieces) = in_pieces(search, exploration, nodes);
    assert_eq!(end(&last, exploration), whole);

    // With a checkpoint whenever limits are looked at, from each of which another search goes on.
    let shelf = Arc::new(Shelf::default());
    let often = kept_by(search.clone(), &shelf, Duration::ZERO).explain(exploration).unwrap();
    assert_eq!(end(&often, exploration), whole);
    let all = shelf.take();
    let step = all.len().div_ceil(5);
    assert!(step > 0);
    for checkpoint in all.into_iter().step_by(step) {
        let shelf = Shelf::with(checkpoint);
        let resumed = kept_by(search.clone(), &shelf, SELDOM).explain(exploration).unwrap();
        assert_eq!(end(&resumed, exploration), whole);
    }
    pieces - 1
}

#[test]
fn searches_by_preference_go_on() {
    let walk = grid_walk(4, 4, &snake(4, 4));
    for (order, goal) in STRATEGIES {
        let axioms = Axioms { max_places: Some(16), ..planar() };
        let search = Mapper::builder().axioms(axioms).order(order).goal(goal);
        let stops = goes_on_as_if_nothing_had_been(&search, &walk);
        // Best-first, which is soon done, seldom looks at its limits.
        assert!(stops > 1 || order == Order::BestFirst, "{order:?} {goal:?}: {stops}");
    }
}

fn measured(side: u32) -> Exploration {
    let world = grid(side, side, 8.0).unwrap();
    let route = world.route_through(&snake(side, side)).unwrap();
    world.explore_with_odometry(&route, &DriftModel::default(), 3).unwrap()
}

#[test]
fn searches_by_posterior_go_on() {
    let walk = measured(3);
    let evidence = PosteriorModel::evidence(&walk).unwrap();
    let simplicity = PosteriorModel { prior: MapPrior::Simplicity(Simplicity::default()), ..evidence };
    for model in [evidence, simplicity] {
        for order in [Order::BreadthFirst, Order::BestFirst, Order::Cyclic, Order::Proof] {
            let proving = Proving { best: 2, rest: 1e-4, patience: None };
            let search = Mapper::builder().posterior(model).order(order).proving(proving).axioms(planar());
            let stops = goes_on_as_if_nothing_had_been(&search, &walk);
            assert!(stops > 1 || order == Order::BestFirst, "{order:?}: {stops}");
        }
    }
}

/// Eight fronts sweep it, and layouts share poses.
#[test]
fn a_long_search_goes_on_in_the_middle_of_a_cycle() {
    let walk = measured(6).prefix(36);
    let model = PosteriorModel::evidence(&walk).unwrap();
    let search = Mapper::builder().posterior(model).order(Order::Cyclic).axioms(planar());
    assert!(goes_on_as_if_nothing_had_been(&search, &walk) > 1);
}

#[test]
fn counts_go_on() {
    let walk = grid_walk(4, 5, &snake(4, 5));
    let search = Mapper::builder().axioms(Axioms { max_places: Some(20), ..planar() });
    let whole = timeless(search.clone().count(&walk).unwrap());
    assert!(whole.nodes > 100_000, "{}", whole.nodes);

    let shelf = Arc::new(Shelf::default());
    let often = kept_by(search.clone().threads(2), &shelf, Duration::ZERO).count(&walk).unwrap();
    assert_eq!(timeless(often), whole);
    let all = shelf.take();
    assert!(all.len() > 5, "{}", all.len());
    let step = all.len().div_ceil(10);
    for checkpoint in all.into_iter().step_by(step) {
        let resumed = kept_by(search.clone(), &Shelf::with(checkpoint), SELDOM).count(&walk).unwrap();
        assert_eq!(timeless(resumed), whole);
    }

    let shelf = Arc::new(Shelf::default());
    for piece in 1.. {
        let limits = Limits { nodes: Some(piece * whole.nodes / 4), ..Limits::default() };
        let report = kept_by(search.clone().limits(limits), &shelf, SELDOM).count(&walk).unwrap();
        if report.stop.is_complete() {
            assert!(piece >= 4);
            assert_eq!(timeless(report), whole);
            break;
        }
    }
}

/// A checkpoint of a search that somebody interrupted before it had begun is one from its beginning.
#[test]
fn an_interruption_leaves_a_checkpoint() {
    let walk = grid_walk(4, 4, &snake(4, 4));
    let search = Mapper::builder().axioms(planar()).order(Order::Proof);
    let (shelf, monitor) = (Arc::new(Shelf::default()), Arc::new(Monitor::default()));
    monitor.interrupt();
    let stopped = kept_by(search.clone().monitor(monitor), &shelf, SELDOM).explain(&walk).unwrap();
    assert_eq!(stopped.report().stop, StopReason::Interrupted);
    assert_eq!(shelf.0.lock().unwrap().len(), 1);
    let resumed = kept_by(search.clone(), &shelf, SELDOM).explain(&walk).unwrap();
    assert_eq!(end(&resumed, &walk), end(&search.explain(&walk).unwrap(), &walk));
}

fn stopped(search: &MapperBuilder, exploration: &Exploration) -> Vec<u8> {
    let shelf = Arc::new(Shelf::default());
    let limits = Limits { nodes: Some(20), ..Limits::default() };
    kept_by(search.clone().limits(limits), &shelf, SELDOM).explain(exploration).unwrap();
    shelf.take().pop().unwrap()
}

fn refusal(
    search: &MapperBuilder,
    exploration: &Exploration,
    checkpoint: Vec<u8>,
) -> Option<CheckpointError> {
    match kept_by(search.clone(), &Shelf::with(checkpoint), SELDOM).explain(exploration) {
        Err(MapperError::Checkpoint(refusal)) => Some(refusal),
        _ => None,
    }
}

#[test]
fn a_checkpoint_of_another_search_is_refused() {
    let walk = grid_walk(4, 4, &snake(4, 4));
    let search = Mapper::builder().axioms(planar()).order(Order::Proof);
    let checkpoint = stopped(&search, &walk);
    let refused = |search: MapperBuilder, walk: &Exploration| refusal(&search, walk, checkpoint.clone());
    assert!(refused(search.clone(), &walk).is_none());
    assert!(refused(search.clone().threads(2), &walk).is_none(), "threads may be others");
    let other = refused(search.clone(), &walk.prefix(10)).unwrap();
    assert!(matches!(other, CheckpointError::Exploration), "{other}");
    let other = refused(search.clone().order(Order::Cyclic), &walk).unwrap();
    assert!(matches!(other, CheckpointError::Search { .. }), "{other}");
    let other = refused(search.axioms(Axioms::default()), &walk).unwrap();
    assert!(matches!(other, CheckpointError::Options), "{other}");
    let counted = kept_by(Mapper::builder(), &Shelf::with(checkpoint), SELDOM).count(&walk);
    assert!(matches!(counted, Err(MapperError::Checkpoint(CheckpointError::Search { .. }))));
}

/// A search by posterior, and a checkpoint of it.
fn sample() -> &'static (Exploration, MapperBuilder, Vec<u8>) {
    static SAMPLE: LazyLock<(Exploration, MapperBuilder, Vec<u8>)> = LazyLock::new(|| {
        let walk = measured(3);
        let model = PosteriorModel::evidence(&walk).unwrap();
        let search = Mapper::builder().posterior(model).order(Order::Cyclic).axioms(planar());
        let checkpoint = stopped(&search, &walk);
        (walk, search, checkpoint)
    });
    &SAMPLE
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]

    /// Bits that fell over, and files that break off or go on with something else.
    #[test]
    fn a_damaged_checkpoint_is_refused(
        at in any::<prop::sample::Index>(), by in 1_u8.., cut in any::<bool>(), tail in prop::collection::vec(any::<u8>(), 0..9),
    ) {
        let (walk, search, whole) = sample();
        let mut checkpoint = whole.clone();
        let at = at.index(checkpoint.len());
        if cut {
            checkpoint.truncate(at);
            checkpoint.extend(tail);
        } else {
            checkpoint[at] ^= by;
        }
        prop_assume!(&checkpoint != whole);
        prop_assert!(refusal(search, walk, checkpoint).is_some());
    }
}

/// Everything that a search for accounts has to say but the time that it took.
fn told(reader: &Reader, exploration: &Exploration) -> (StopReason, String) {
    let answer = reader.read(exploration).unwrap();
    (answer.stop, format!("{:?}", ReadAnswer { seconds: 0.0, ..answer }))
}

#[test]
fn accounts_of_errors() {
    let world = grid(3, 3, 8.0).unwrap();
    let route = world.route_through(&snake(3, 3)).unwrap();
    let misperceived = world.misperceive(&route, &DriftModel::default(), ErrorRates::all(0.1), 2).unwrap();
    let exploration = misperceived.exploration;
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let reader = Reader { axioms: planar(), best: 2, patience: Some(300), ..Reader::new(model) };
    let (stop, whole) = told(&reader, &exploration);
    assert_eq!(stop, StopReason::Found);
    let kept = |shelf: &Arc<Shelf>, every| {
        let keeper: Arc<dyn Keeper> = Arc::clone(shelf) as Arc<dyn Keeper>;
        Reader { checkpoints: Some(Checkpoints { keeper, every }), ..reader.clone() }
    };

    // In pieces, each gone on with by another search.
    let shelf = Arc::new(Shelf::default());
    let mut stops = 0;
    let in_pieces = loop {
        let limits = Limits { nodes: Some((stops + 1) * 120), ..Limits::default() };
        let (stop, told) = told(&Reader { limits, ..kept(&shelf, SELDOM) }, &exploration);
        if stop != StopReason::NodeLimit {
            break told;
        }
        stops += 1;
    };
    assert!(stops > 2, "{stops} stops");
    assert_eq!(in_pieces, whole);
    // What the last one keeps has the answer.
    assert_eq!(told(&kept(&shelf, SELDOM), &exploration).1, whole);

    // With a checkpoint whenever limits are looked at.
    let shelf = Arc::new(Shelf::default());
    assert_eq!(told(&kept(&shelf, Duration::ZERO), &exploration).1, whole);
    let all = shelf.take();
    let step = all.len().div_ceil(7);
    for checkpoint in all.into_iter().step_by(step) {
        assert_eq!(told(&kept(&Shelf::with(checkpoint), SELDOM), &exploration).1, whole);
    }
}

#[test]
fn a_checkpoint_of_other_prices_of_errors_is_refused() {
    let world = grid(3, 3, 8.0).unwrap();
    let route = world.route_through(&snake(3, 3)).unwrap();
    let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let shelf = Arc::new(Shelf::default());
    let keeper: Arc<dyn Keeper> = Arc::clone(&shelf) as Arc<dyn Keeper>;
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let checkpoints = Some(Checkpoints { keeper, every: SELDOM });
    let reader = Reader { axioms: planar(), patience: Some(10), checkpoints, ..Reader::new(model) };
    reader.read(&exploration).unwrap();
    let others = Reader { bearing_deviation: None, ..reader };
    let refused = others.read(&exploration).unwrap_err();
    assert!(matches!(refused, MapperError::Checkpoint(CheckpointError::Options)), "{refused}");
}
