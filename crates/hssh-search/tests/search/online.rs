//! One observation at a time ends where all at once do.

use hssh_causal::Exploration;
use hssh_search::{
    Branch, Experience, Goal, Mapper, MapperBuilder, Order, PosteriorModel, Proving, RankedMap, Report,
    StopReason, Visit, VisitError,
};
use hssh_topology::{Axioms, Derivation, MapSketch, Measure, Olp, Star};
use hssh_world::{DriftModel, grid, snake};
use proptest::prelude::*;

use crate::cases::{Way, case, planar, sketch, sketches};
use crate::threads::STRATEGIES;

fn observe_all(
    exploration: &Exploration,
    axioms: Axioms,
    strategy: Way,
    each: impl Fn(&mut Mapper),
) -> Mapper {
    let builder = Mapper::builder().axioms(axioms).order(strategy.0).goal(strategy.1);
    let mut mapper = builder.start(exploration.star(exploration.start())).unwrap();
    each(&mut mapper);
    for travel in exploration.travels() {
        mapper.observe(Visit::new(travel.exit, travel.entry, exploration.star(travel.star))).unwrap();
        each(&mut mapper);
    }
    mapper.advance();
    mapper
}

fn timeless(mapper: &Mapper) -> Report {
    Report { seconds: 0.0, ..mapper.report() }
}

/// What a mapper answers: what its maps measure and the choices that lead to them, in order.
fn answer(mapper: &Mapper) -> Vec<(Measure, String)> {
    let of = |map: &RankedMap| (map.measure, mapper.branch(map.node).to_string());
    mapper.maps(usize::MAX).iter().map(of).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(240))]

    #[test]
    fn step_by_step((exploration, axioms) in case(1500)) {
        for strategy in STRATEGIES.into_iter().filter(|&way| way != (Order::BestFirst, Goal::ClosedMap)) {
            let at_once = observe_all(&exploration, axioms, strategy, |_| {});
            let builder = Mapper::builder().axioms(axioms).order(strategy.0).goal(strategy.1);
            let whole = builder.explain(&exploration).unwrap();
            let step_by_step = observe_all(&exploration, axioms, strategy, |mapper| {
                assert!(mapper.advance().is_complete());
            });
            prop_assert_eq!(timeless(&at_once), timeless(&whole), "{:?}", strategy);
            prop_assert_eq!(at_once.maps(usize::MAX), whole.maps(usize::MAX));
            prop_assert_eq!(answer(&step_by_step), answer(&whole), "{:?}", strategy);
            prop_assert_eq!(step_by_step.report().stop, whole.report().stop);
            prop_assert_eq!(step_by_step.report().is_optimal, whole.report().is_optimal);
            if matches!(strategy.0, Order::BreadthFirst | Order::BestFirst) {
                // Nothing was done that a search of the whole would not have done.
                prop_assert_eq!(timeless(&step_by_step), timeless(&whole), "{:?}", strategy);
            }
            prop_assert_eq!(sketches(&step_by_step), sketches(&whole));
        }
    }

    /// A branch makes the same hypothesis anywhere.
    #[test]
    fn branches_are_what_hypotheses_are((exploration, axioms) in case(800)) {
        let mapper = Mapper::builder().axioms(axioms).explain(&exploration).unwrap();
        let (experience, other) = (Experience::from(&exploration), Axioms { max_places: Some(0), ..axioms });
        let mut branches: Vec<Branch> = Vec::new();
        for map in mapper.maps(usize::MAX) {
            let branch = mapper.branch(map.node);
            let anew = branch.replay(&experience, &axioms).unwrap();
            let known = mapper.hypothesis(map.node);
            prop_assert_eq!(anew.position, known.position);
            let sketch = |map| MapSketch::of(map, &experience.catalog);
            prop_assert_eq!(sketch(&anew.map), sketch(&known.map));
            prop_assert_eq!(branch.to_string().parse::<Branch>().unwrap(), branch.clone());
            let grows = branch.choices().contains(&Derivation::NewPlace);
            prop_assert_eq!(branch.replay(&experience, &other).is_none(), grows);
            branches.push(branch);
        }
        let number = branches.len();
        branches.sort();
        branches.dedup();
        prop_assert_eq!(branches.len(), number);
    }

    /// To go back for a closed map at every step expands more, but finds a map if there is one.
    #[test]
    fn closed_maps_step_by_step((exploration, axioms) in case(1500)) {
        let strategy = (Order::BestFirst, Goal::ClosedMap);
        let whole = Mapper::builder().axioms(axioms).order(strategy.0).goal(strategy.1).explain(&exploration).unwrap();
        let step_by_step = observe_all(&exploration, axioms, strategy, |mapper| {
            mapper.advance();
        });
        prop_assert_eq!(step_by_step.report().stop, whole.report().stop);
        let all = Mapper::builder().axioms(axioms).explain(&exploration).unwrap();
        let known = sketches(&all);
        for map in step_by_step.maps(usize::MAX) {
            prop_assert!(known.contains(&sketch(&step_by_step, map.node)));
            prop_assert_eq!(map.closed, whole.report().stop == StopReason::Found);
        }
    }
}

fn drifting_snake(size: u32, seed: u64) -> Exploration {
    let world = grid(size, size, 8.0).unwrap();
    let route = world.route_through(&snake(size, size)).unwrap();
    world.explore_with_odometry(&route, &DriftModel::default(), seed).unwrap()
}

fn begin(builder: MapperBuilder, exploration: &Exploration) -> Mapper {
    let named = &exploration.star_types()[exploration.start().index()];
    builder.start_with(&named.star, &named.bearings).unwrap()
}

/// After every travel the most probable map, its cost and its proof are those of a search of all travels so far; also where corridors
/// lead is estimated from these.
#[test]
fn the_posterior_on_the_way() {
    for (seed, order) in [(1, Order::Cyclic), (2, Order::Cyclic), (3, Order::Proof), (4, Order::BreadthFirst)]
    {
        let exploration = drifting_snake(3, seed);
        let search = || Mapper::builder().order(order).axioms(planar());
        let mut mapper = begin(search().posterior(PosteriorModel::ONLINE), &exploration);
        for travel in 0..exploration.travels().len() {
            mapper.observe(Visit::of(&exploration, travel)).unwrap();
            assert!(mapper.advance().is_complete());
            let so_far = exploration.prefix(travel + 1);
            let model = PosteriorModel::evidence(&so_far).unwrap();
            let whole = search().posterior(model).explain(&so_far).unwrap();
            let [on_the_way, at_once] = [&mapper, &whole].map(|mapper| mapper.answer(1));
            assert_eq!(on_the_way.0.is_optimal, at_once.0.is_optimal);
            let (best, expected) = (&on_the_way.1[0], &at_once.1[0]);
            assert_eq!(mapper.branch(best.node), whole.branch(expected.node));
            let (cost, expected) = (best.nats().unwrap(), expected.nats().unwrap());
            assert!((cost - expected).abs() < 1e-6 * (1.0 + expected), "travel {travel}: {cost} {expected}");
        }
    }
}

/// With patience there is an answer after every travel, at the price of a few expansions; what is not proved is not said to be.
#[test]
fn patience_bounds_the_work_of_a_travel() {
    let exploration = drifting_snake(6, 1);
    let proving = Proving { patience: Some(30), ..Proving::default() };
    let search = Mapper::builder().posterior(PosteriorModel::ONLINE).order(Order::Cyclic).proving(proving);
    let mut mapper = begin(search.axioms(planar()), &exploration);
    let mut before = 0;
    for travel in 0..exploration.travels().len() {
        mapper.observe(Visit::of(&exploration, travel)).unwrap();
        assert!(mapper.advance().is_complete());
        assert_eq!(mapper.explained(), travel + 1);
        let expanded = mapper.report().expanded;
        assert!(expanded - before < 400, "travel {travel}: {}", expanded - before);
        before = expanded;
    }
    let known: Vec<u32> = mapper.visits(mapper.maps(1)[0].node).iter().map(|at| at.place.number()).collect();
    assert_eq!(known.iter().max(), Some(&35), "the true map has 36 places");
}

/// What cannot be used is refused when it is told, and forgotten.
#[test]
fn a_travel_that_is_not_measured_is_refused() {
    let exploration = drifting_snake(3, 1);
    let search = Mapper::builder().posterior(PosteriorModel::ONLINE).order(Order::Cyclic);
    let mut mapper = begin(search, &exploration);
    let visit = Visit::of(&exploration, 0);
    let refusal = mapper.observe(Visit { odometry: None, ..visit.clone() }).unwrap_err();
    assert_eq!(refusal.to_string(), "travel 1 has no odometry; the posterior needs it for every travel");
    let bearings = vec![None];
    let refusal = mapper.observe(Visit { bearings, ..visit.clone() }).unwrap_err();
    assert!(refusal.to_string().contains("ends but 1 bearings"), "{refusal}");
    mapper.observe(visit).unwrap();
    mapper.advance();
    assert_eq!((mapper.explained(), mapper.experience().observations.len()), (1, 1));
}

/// Nothing observed but the first star: one map, once, however often one asks.
#[test]
fn before_the_first_travel() {
    let crossing: Star = "0+ 1+ 0- 1-".parse().unwrap();
    for strategy in STRATEGIES {
        let mut mapper = Mapper::builder().order(strategy.0).goal(strategy.1).start(&crossing).unwrap();
        for _ in 0..3 {
            assert!(mapper.advance().is_complete());
            let closed_only = strategy.1 == Goal::ClosedMap;
            assert_eq!(mapper.maps(9).len(), usize::from(!closed_only), "{strategy:?}");
        }
    }
}

/// To call again when everything is explained changes nothing.
#[test]
fn advancing_twice() {
    let exploration = hssh_world::strategies::random_exploration(3);
    for strategy in STRATEGIES {
        let mut mapper = Mapper::builder().order(strategy.0).goal(strategy.1).explain(&exploration).unwrap();
        let (stop, before, maps) = (mapper.report().stop, timeless(&mapper), mapper.maps(99));
        assert_eq!(mapper.advance(), stop);
        assert_eq!((timeless(&mapper), mapper.maps(99)), (before, maps));
    }
}

#[test]
fn impossible_observations_are_refused_and_forgotten() {
    let (crossing, tee): (Star, Star) = ("0+ 1+ 0- 1-".parse().unwrap(), "0+ (1+) 0- 1-".parse().unwrap());
    let mut mapper = Mapper::builder().start(&tee).unwrap();
    let refusal = mapper.observe(Visit::new(Olp::new(4), Olp::new(0), &crossing)).unwrap_err();
    assert_eq!(refusal, VisitError::NoSuchEnd { star: tee.clone(), olp: Olp::new(4) });
    assert_eq!(refusal.to_string(), "the star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] has no end number 4");
    let refusal = mapper.observe(Visit::new(Olp::new(1), Olp::new(0), &crossing)).unwrap_err();
    assert_eq!(refusal.to_string(), "the end 1+ of the star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] is closed");
    let refusal = mapper.observe(Visit::new(Olp::new(0), Olp::new(1), &tee)).unwrap_err();
    assert_eq!(refusal, VisitError::ClosedEnd { star: tee.clone(), olp: Olp::new(1) });
    assert!(mapper.observe(Visit::new(Olp::new(0), Olp::new(9), &crossing)).is_err());
    assert!(mapper.experience().observations.is_empty());
    mapper.observe(Visit::new(Olp::new(0), Olp::new(2), &crossing)).unwrap();
    // The exit is now one of the crossing.
    mapper.observe(Visit::new(Olp::new(1), Olp::new(0), &tee)).unwrap();
    assert_eq!(mapper.advance(), StopReason::Exhausted);
    assert_eq!(mapper.explained(), 2);
}
