//! A search whose open hypotheses do not fit into memory ends as one whose do.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{
    Goal, Limits, Mapper, MapperBuilder, MapperError, Order, PosteriorModel, Proving, StopReason, Store,
};
use hssh_topology::Axioms;
use hssh_world::{DriftModel, grid, snake};

use crate::cases::{grid_walk, planar};
use crate::checkpoints::{SELDOM, Shelf, end, kept_by};

/// Keeps pages in memory that counts as none: at most so many, of which so many can be read.
#[derive(Debug)]
struct Cellar {
    pages: Mutex<BTreeMap<u64, Vec<u8>>>,
    /// How many were kept and read so far.
    count: Mutex<[u64; 2]>,
    most: [u64; 2],
}

impl Cellar {
    fn with(most: [u64; 2]) -> Arc<Self> {
        Arc::new(Cellar { pages: Mutex::default(), count: Mutex::default(), most })
    }

    /// The number of the next one that is kept or read.
    fn next(&self, what: usize) -> io::Result<u64> {
        let count = &mut self.count.lock().unwrap()[what];
        *count += 1;
        if *count > self.most[what] { Err(io::ErrorKind::StorageFull.into()) } else { Ok(*count) }
    }

    fn kept(&self) -> u64 {
        self.count.lock().unwrap()[0]
    }
}

impl Store for Cellar {
    fn keep(&self, page: &[u8]) -> io::Result<u64> {
        let number = self.next(0)?;
        self.pages.lock().unwrap().insert(number, page.to_vec());
        Ok(number)
    }

    fn page(&self, number: u64) -> io::Result<Vec<u8>> {
        self.next(1)?;
        Ok(self.pages.lock().unwrap()[&number].clone())
    }

    fn drop_page(&self, number: u64) {
        assert!(self.pages.lock().unwrap().remove(&number).is_some());
    }
}

const ENOUGH: [u64; 2] = [u64::MAX; 2];

const LIMITS: Limits = Limits { nodes: Some(6_000), time: None, bytes: None };

fn spilling(search: &MapperBuilder, cellar: &Arc<Cellar>, bytes: u64) -> MapperBuilder {
    let store = Arc::clone(cellar) as Arc<dyn Store>;
    search.clone().spilling(store).limits(Limits { bytes: Some(bytes), ..LIMITS })
}

/// Of a measured snake; the exploration, a search for its most probable maps, and too few bytes for that.
fn posterior() -> (Exploration, MapperBuilder, u64) {
    let world = grid(6, 6, 8.0).unwrap();
    let route = world.route_through(&snake(6, 6)).unwrap();
    let exploration = world.explore_with_odometry(&route, &DriftModel::default().scaled(2.0), 1).unwrap();
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let proving = Proving { best: 5, rest: 1e-9, patience: None };
    let search = Mapper::builder()
        .posterior(model)
        .order(Order::Cyclic)
        .axioms(planar())
        .proving(proving)
        .limits(LIMITS);
    let bytes = too_few(&search, &exploration);
    (exploration, search, bytes)
}

/// So few bytes that half of what is open when it ends has room.
fn too_few(search: &MapperBuilder, exploration: &Exploration) -> u64 {
    let whole = search.clone().explain(exploration).unwrap();
    let tree = whole.tree().bytes();
    tree + (whole.report().bytes - tree) / 2
}

#[test]
fn the_posterior() {
    let (exploration, search, bytes) = posterior();
    let whole = end(&search.clone().explain(&exploration).unwrap(), &exploration);
    for threads in [1, 2] {
        let cellar = Cellar::with(ENOUGH);
        let spilled = spilling(&search, &cellar, bytes).threads(threads).explain(&exploration).unwrap();
        assert_eq!(end(&spilled, &exploration), whole);
        assert!(cellar.kept() > 10, "{} pages", cellar.kept());
    }
    let stopped = search.limits(Limits { bytes: Some(bytes), ..LIMITS });
    assert_eq!(stopped.explain(&exploration).unwrap().report().stop, StopReason::MemoryLimit);
}

#[test]
fn the_order_of_preference() {
    let exploration = grid_walk(5, 5, &snake(5, 5));
    let axioms = Axioms { max_places: Some(26), ..planar() };
    for (order, goal) in
        [(Order::Cyclic, Goal::AnyMap), (Order::Proof, Goal::ClosedMap), (Order::BestFirst, Goal::AnyMap)]
    {
        let search = Mapper::builder().axioms(axioms).order(order).goal(goal).limits(LIMITS);
        let whole = end(&search.clone().explain(&exploration).unwrap(), &exploration);
        let cellar = Cellar::with(ENOUGH);
        let bytes = too_few(&search, &exploration);
        let spilled = spilling(&search, &cellar, bytes).explain(&exploration).unwrap();
        assert_eq!(end(&spilled, &exploration), whole);
        assert!(cellar.kept() > 10, "{} pages", cellar.kept());
    }
}

#[test]
fn a_search_goes_on_from_a_checkpoint_of_what_was_spilled() {
    let (exploration, search, bytes) = posterior();
    let whole = end(&search.clone().explain(&exploration).unwrap(), &exploration);
    let shelf = Arc::new(Shelf::default());
    let often = kept_by(spilling(&search, &Cellar::with(ENOUGH), bytes), &shelf, Duration::from_millis(5));
    assert_eq!(end(&often.explain(&exploration).unwrap(), &exploration), whole);
    let all = shelf.take();
    let step = all.len().div_ceil(4);
    for checkpoint in all.into_iter().step_by(step) {
        let kept = |search: MapperBuilder| kept_by(search, &Shelf::with(checkpoint.clone()), SELDOM);
        let with = kept(spilling(&search, &Cellar::with(ENOUGH), bytes)).explain(&exploration).unwrap();
        assert_eq!(end(&with, &exploration), whole);
        let without = kept(search.clone()).explain(&exploration).unwrap();
        assert_eq!(end(&without, &exploration), whole);
    }
}

#[test]
fn what_finds_no_room_anywhere_stops_the_search_and_is_not_lost() {
    let (exploration, search, bytes) = posterior();
    let whole = end(&search.clone().explain(&exploration).unwrap(), &exploration);
    let shelf = Arc::new(Shelf::default());
    for most in [0, 3] {
        let full = spilling(&search, &Cellar::with([most, u64::MAX]), bytes);
        let stopped = kept_by(full, &shelf, SELDOM).explain(&exploration).unwrap();
        assert_eq!(stopped.report().stop, StopReason::MemoryLimit);
    }
    let more = kept_by(search, &shelf, SELDOM).explain(&exploration).unwrap();
    assert_eq!(end(&more, &exploration), whole);
}

#[test]
fn what_was_spilled_and_cannot_be_read_ends_the_search_without_an_answer() {
    let (exploration, search, bytes) = posterior();
    let shelf = Arc::new(Shelf::default());
    let lost = spilling(&search, &Cellar::with([u64::MAX, 0]), bytes);
    let error = kept_by(lost, &shelf, SELDOM).explain(&exploration).unwrap_err();
    assert!(matches!(error, MapperError::Lost(_)), "{error}");
    assert!(shelf.take().is_empty(), "what is not whole is not kept");
}
