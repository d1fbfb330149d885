//! The number of processes changes nothing but the time, and one that is lost ends the search with all that it knows.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{
    Expander, Goal, Helpers, Limits, Mapper, MapperBuilder, Order, PosteriorModel, Proving, StopReason,
};
use hssh_topology::Axioms;
use hssh_world::{DriftModel, grid, snake};
use proptest::prelude::*;

use crate::cases::{case, grid_walk, planar};
use crate::checkpoints::{SELDOM, Shelf, end, kept_by};
use crate::threads::STRATEGIES;

/// Helpers that are no processes; after so many requests all are lost.
#[derive(Debug)]
struct Together {
    expanders: Vec<Mutex<Expander>>,
    left: AtomicUsize,
}

impl Together {
    fn of(search: &MapperBuilder, exploration: &Exploration, count: usize, requests: usize) -> Arc<Self> {
        let expander = |_| Mutex::new(Expander::new(search.clone(), exploration).unwrap());
        let expanders: Vec<_> = (0..count).map(expander).collect();
        Arc::new(Together { expanders, left: AtomicUsize::new(requests) })
    }
}

impl Helpers for Together {
    fn count(&self) -> usize {
        self.expanders.len()
    }

    fn least_work(&self) -> Duration {
        Duration::ZERO
    }

    fn ask(&self, requests: Vec<Vec<u8>>, meanwhile: &mut dyn FnMut()) -> Option<Vec<Vec<u8>>> {
        assert!(requests.len() <= self.expanders.len());
        meanwhile();
        let one_less = |left: usize| left.checked_sub(1);
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_less).ok()?;
        let answer =
            |(expander, request): (&Mutex<Expander>, Vec<u8>)| expander.lock().unwrap().answer(&request);
        self.expanders.iter().zip(requests).map(answer).collect()
    }
}

/// Whether anything was asked of them.
fn processes_change_nothing(search: &MapperBuilder, exploration: &Exploration) -> bool {
    let alone = end(&search.clone().explain(exploration).unwrap(), exploration);
    let mut any = false;
    for count in [1, 2] {
        let together = Together::of(search, exploration, count, usize::MAX);
        let helped = search.clone().helpers(Arc::clone(&together) as Arc<dyn Helpers>).threads(count);
        assert_eq!(end(&helped.explain(exploration).unwrap(), exploration), alone);
        any |= together.left.load(Ordering::Relaxed) < usize::MAX;
    }
    any
}

fn searches(axioms: Axioms) -> impl Iterator<Item = MapperBuilder> {
    STRATEGIES.into_iter().map(move |(order, goal)| Mapper::builder().axioms(axioms).order(order).goal(goal))
}

const LIMITS: Limits = Limits { nodes: Some(3000), time: None, bytes: None };

/// Of a measured snake; the exploration, and searches for its most probable maps.
fn posterior() -> (Exploration, PosteriorModel, Vec<MapperBuilder>) {
    let world = grid(6, 6, 8.0).unwrap();
    let route = world.route_through(&snake(6, 6)).unwrap();
    let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let searches = [Order::Cyclic, Order::BreadthFirst].into_iter().map(|order| {
        let proving = Proving { best: 5, rest: 1e-9, patience: None };
        Mapper::builder().posterior(model).order(order).axioms(planar()).limits(LIMITS).proving(proving)
    });
    (exploration, model, searches.collect())
}

#[test]
fn grids() {
    let exploration = grid_walk(4, 4, &snake(4, 4));
    for search in searches(Axioms { max_places: Some(16), ..planar() }) {
        processes_change_nothing(&search, &exploration);
    }
    for search in wide() {
        assert!(processes_change_nothing(&search, &exploration));
    }
}

/// Searches with enough to do at a time to be shared.
fn wide() -> [MapperBuilder; 2] {
    let limits = Limits { nodes: Some(30_000), ..Limits::default() };
    [Order::BreadthFirst, Order::Proof].map(|order| Mapper::builder().order(order).limits(limits))
}

#[test]
fn the_posterior() {
    let (exploration, model, searches) = posterior();
    for search in searches {
        assert!(processes_change_nothing(&search, &exploration));
    }
    // By its bound one hypothesis has its turn after the other.
    let proof = Mapper::builder().posterior(model).order(Order::Proof).limits(LIMITS);
    processes_change_nothing(&proof, &exploration);
}

/// Whatever was asked of those that are lost is done by the first process, which then stops.
#[test]
fn a_search_whose_helpers_are_lost_goes_on_from_its_checkpoint() {
    let (exploration, _, searches) = posterior();
    let topology = wide().map(|search| (grid_walk(4, 4, &snake(4, 4)), search));
    let measured = searches.into_iter().map(|search| (exploration.clone(), search));
    for (exploration, search) in measured.chain(topology) {
        let whole = end(&search.clone().explain(&exploration).unwrap(), &exploration);
        for requests in [0, 1] {
            let shelf = Arc::new(Shelf::default());
            let search = kept_by(search.clone(), &shelf, SELDOM);
            let together = Together::of(&search, &exploration, 2, requests);
            let helped = search.clone().monitor(Arc::default()).helpers(together);
            assert_eq!(helped.explain(&exploration).unwrap().report().stop, StopReason::Interrupted);
            let others = Together::of(&search, &exploration, 1, usize::MAX);
            let resumed = search.monitor(Arc::default()).helpers(others).explain(&exploration).unwrap();
            assert_eq!(end(&resumed, &exploration), whole);
        }
    }
}

#[test]
fn helpers_of_one_search_have_one_number() {
    let (exploration, _, searches) = posterior();
    let number = |search: &MapperBuilder, exploration: &Exploration| {
        Expander::new(search.clone(), exploration).unwrap().identity()
    };
    let own = number(&searches[0], &exploration);
    let limited = Limits { time: Some(Duration::from_secs(1)), ..Limits::default() };
    assert_eq!(number(&searches[0].clone().threads(2).limits(limited), &exploration), own);
    assert_ne!(number(&searches[1], &exploration), own);
    assert_ne!(number(&searches[0], &exploration.prefix(9)), own);
    assert_ne!(number(&searches[0].clone().goal(Goal::ClosedMap), &exploration), own);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn random_explorations((exploration, axioms) in case(2000)) {
        for search in searches(axioms) {
            processes_change_nothing(&search, &exploration);
        }
    }

    #[test]
    fn nonsense_has_no_answer(mut nonsense in prop::collection::vec(any::<u8>(), 0..60), kind in 0_u8..4) {
        let (exploration, _, searches) = posterior();
        let exploration = exploration.prefix(6);
        nonsense.insert(0, kind);
        let _ = Expander::new(searches[0].clone(), &exploration).unwrap().answer(&nonsense);
    }
}
