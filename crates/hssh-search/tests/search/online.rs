//! One observation at a time ends where all at once do.

use hssh_causal::Exploration;
use hssh_search::{Goal, Mapper, ObservationError, Report, StopReason, Strategy};
use hssh_topology::{Axioms, Olp, Star};
use proptest::prelude::*;

use crate::cases::{case, sketch, sketches};
use crate::threads::STRATEGIES;

fn observe_all(
    exploration: &Exploration,
    axioms: Axioms,
    strategy: Strategy,
    each: impl Fn(&mut Mapper),
) -> Mapper {
    let builder = Mapper::builder().axioms(axioms).strategy(strategy);
    let mut mapper = builder.start(exploration.star(exploration.start())).unwrap();
    each(&mut mapper);
    for travel in exploration.travels() {
        mapper.observe(travel.exit, travel.entry, exploration.star(travel.star)).unwrap();
        each(&mut mapper);
    }
    mapper.advance();
    mapper
}

fn timeless(mapper: &Mapper) -> Report {
    Report { seconds: 0.0, ..mapper.report() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(240))]

    #[test]
    fn step_by_step((exploration, axioms) in case(1500)) {
        let steady = [Strategy::BreadthFirst, Strategy::BestFirst(Goal::AnyMap), Strategy::Proof(Goal::AnyMap), Strategy::Proof(Goal::ClosedMap)];
        for strategy in steady {
            let at_once = observe_all(&exploration, axioms, strategy, |_| {});
            let whole = Mapper::builder().axioms(axioms).strategy(strategy).explain(&exploration).unwrap();
            let step_by_step = observe_all(&exploration, axioms, strategy, |mapper| {
                assert!(mapper.advance().is_complete());
            });
            for other in [at_once, step_by_step] {
                prop_assert_eq!(timeless(&other), timeless(&whole), "{:?}", strategy);
                prop_assert_eq!(other.maps(usize::MAX), whole.maps(usize::MAX));
                prop_assert_eq!(sketches(&other), sketches(&whole));
            }
        }
    }

    /// To go back for a closed map at every step expands more, but finds a map if there is one.
    #[test]
    fn closed_maps_step_by_step((exploration, axioms) in case(1500)) {
        let strategy = Strategy::BestFirst(Goal::ClosedMap);
        let whole = Mapper::builder().axioms(axioms).strategy(strategy).explain(&exploration).unwrap();
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

/// Nothing observed but the first star: one map, once, however often one asks.
#[test]
fn before_the_first_travel() {
    let crossing: Star = "0+ 1+ 0- 1-".parse().unwrap();
    for strategy in STRATEGIES {
        let mut mapper = Mapper::builder().strategy(strategy).start(&crossing).unwrap();
        for _ in 0..3 {
            assert!(mapper.advance().is_complete());
            let closed_only =
                matches!(strategy, Strategy::Proof(Goal::ClosedMap) | Strategy::BestFirst(Goal::ClosedMap));
            assert_eq!(mapper.maps(9).len(), usize::from(!closed_only), "{strategy:?}");
        }
    }
}

/// To call again when everything is explained changes nothing.
#[test]
fn advancing_twice() {
    let exploration = hssh_world::strategies::random_exploration(3);
    for strategy in STRATEGIES {
        let mut mapper = Mapper::builder().strategy(strategy).explain(&exploration).unwrap();
        let (stop, before, maps) = (mapper.report().stop, timeless(&mapper), mapper.maps(99));
        assert_eq!(mapper.advance(), stop);
        assert_eq!((timeless(&mapper), mapper.maps(99)), (before, maps));
    }
}

#[test]
fn impossible_observations_are_refused_and_forgotten() {
    let (crossing, tee): (Star, Star) = ("0+ 1+ 0- 1-".parse().unwrap(), "0+ (1+) 0- 1-".parse().unwrap());
    let mut mapper = Mapper::builder().start(&tee).unwrap();
    let refusal = mapper.observe(Olp::new(4), Olp::new(0), &crossing).unwrap_err();
    assert_eq!(refusal, ObservationError::NoSuchEnd { star: tee.clone(), olp: Olp::new(4) });
    assert_eq!(refusal.to_string(), "the star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] has no end number 4");
    let refusal = mapper.observe(Olp::new(1), Olp::new(0), &crossing).unwrap_err();
    assert_eq!(refusal.to_string(), "the end 1+ of the star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] is closed");
    let refusal = mapper.observe(Olp::new(0), Olp::new(1), &tee).unwrap_err();
    assert_eq!(refusal, ObservationError::ClosedEnd { star: tee.clone(), olp: Olp::new(1) });
    assert!(mapper.observe(Olp::new(0), Olp::new(9), &crossing).is_err());
    assert!(mapper.experience().observations.is_empty());
    mapper.observe(Olp::new(0), Olp::new(2), &crossing).unwrap();
    // The exit is now one of the crossing.
    mapper.observe(Olp::new(1), Olp::new(0), &tee).unwrap();
    assert_eq!(mapper.advance(), StopReason::Exhausted);
    assert_eq!(mapper.explained(), 2);
}
