//! A search that stops early says why, keeps what it has, and can go on.

use std::sync::Arc;
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{
    Experience, FinalCounts, Goal, Limits, Mapper, MapperBuilder, Monitor, Report, StopReason, Strategy,
    count,
};
use hssh_topology::{Axioms, Preference};
use hssh_world::snake;

use crate::cases::{grid_walk, planar, sketches};
use crate::threads::STRATEGIES;

const NONE: Limits = Limits { nodes: None, time: None, bytes: None };

fn walk() -> Exploration {
    grid_walk(4, 4, &snake(4, 4))
}

fn search(strategy: Strategy, limits: Limits) -> Mapper {
    Mapper::builder().axioms(planar()).strategy(strategy).limits(limits).explain(&walk()).unwrap()
}

fn counted(limits: Limits, monitor: &Arc<Monitor>) -> Report {
    let (experience, preference) = (Experience::from(&walk()), Preference::default());
    count(&experience, &Axioms::default(), preference, limits, 1, monitor).unwrap()
}

/// What breadth-first shows after a limit is what it shows of the beginning that it explains.
fn shows_its_last_level(mapper: &Mapper) {
    let explained = mapper.explained();
    let beginning = Mapper::builder().axioms(planar()).explain(&walk().prefix(explained)).unwrap();
    let (stopped, complete) = (mapper.report(), beginning.report());
    assert_eq!(stopped.explained, explained as u64);
    assert_eq!(stopped.finals, complete.finals);
    assert_eq!((stopped.levels, stopped.removals), (complete.levels, complete.removals));
    assert_eq!(mapper.maps(usize::MAX), beginning.maps(usize::MAX));
    assert_eq!(sketches(mapper)[..], sketches(&beginning)[..]);
}

#[test]
fn a_limit_on_nodes() {
    for strategy in STRATEGIES {
        let mut mapper = search(strategy, Limits { nodes: Some(20), ..NONE });
        assert_eq!(mapper.report().stop, StopReason::NodeLimit);
        assert!(!mapper.report().stop.is_complete());
        assert!(mapper.report().nodes > 20);
        if strategy == Strategy::BreadthFirst {
            shows_its_last_level(&mapper);
        }
        // The limit is still the same.
        let before = mapper.report();
        assert_eq!(mapper.advance(), StopReason::NodeLimit);
        assert_eq!(Report { seconds: before.seconds, ..mapper.report() }, before);
    }
    let report = counted(Limits { nodes: Some(20), ..NONE }, &Arc::default());
    assert_eq!(report.stop, StopReason::NodeLimit);
}

#[test]
fn a_limit_on_memory() {
    for strategy in STRATEGIES {
        let mapper = search(strategy, Limits { bytes: Some(10_000), ..NONE });
        assert_eq!(mapper.report().stop, StopReason::MemoryLimit);
        if strategy == Strategy::BreadthFirst {
            assert!(mapper.explained() > 0);
            shows_its_last_level(&mapper);
        }
    }
}

#[test]
fn no_time_at_all() {
    let none = Limits { time: Some(Duration::ZERO), ..NONE };
    for strategy in STRATEGIES {
        let mut mapper = search(strategy, none);
        assert_eq!(mapper.advance(), StopReason::TimeLimit);
        assert_eq!(mapper.report().stop, StopReason::TimeLimit);
        assert_eq!(mapper.report().nodes, 1);
    }
    let breadth_first = search(Strategy::BreadthFirst, none);
    assert_eq!((breadth_first.explained(), breadth_first.maps(9).len()), (0, 1));
    shows_its_last_level(&breadth_first);
    let report = counted(none, &Arc::default());
    assert_eq!((report.stop, report.nodes), (StopReason::TimeLimit, 1));
}

/// A time limit holds for one call; many short calls end where a long one does.
#[test]
fn going_on_after_a_time_limit() {
    for strategy in STRATEGIES {
        let whole = search(strategy, NONE);
        let mut mapper = search(strategy, Limits { time: Some(Duration::from_millis(2)), ..NONE });
        let mut calls = 1;
        while mapper.advance() == StopReason::TimeLimit {
            calls += 1;
            assert!(calls < 100_000, "{strategy:?} does not come to an end");
        }
        let seconds = mapper.report().seconds;
        assert_eq!(mapper.report(), Report { seconds, ..whole.report() });
        assert_eq!(mapper.maps(usize::MAX), whole.maps(usize::MAX));
    }
}

fn watched(strategy: Strategy, monitor: &Arc<Monitor>) -> MapperBuilder {
    Mapper::builder().axioms(planar()).strategy(strategy).monitor(Arc::clone(monitor))
}

#[test]
fn interrupted_before_it_begins() {
    for strategy in STRATEGIES {
        let monitor = Arc::new(Monitor::default());
        monitor.interrupt();
        let mapper = watched(strategy, &monitor).explain(&walk()).unwrap();
        assert_eq!((mapper.report().stop, mapper.tree().len()), (StopReason::Interrupted, 1));
    }
    let monitor = Arc::new(Monitor::default());
    monitor.interrupt();
    let report = counted(NONE, &monitor);
    assert_eq!(report.stop, StopReason::Interrupted);
    assert_eq!((report.nodes, report.finals), (1, FinalCounts::default()));
}

/// Waits until a search has come some way, then interrupts it.
fn interrupt_once_under_way(monitor: &Arc<Monitor>) -> std::thread::JoinHandle<()> {
    let monitor = Arc::clone(monitor);
    std::thread::spawn(move || {
        while monitor.nodes() < 2000 {
            std::thread::yield_now();
        }
        monitor.interrupt();
    })
}

#[test]
fn interrupted_on_the_way() {
    // The complete search of the 4×4 grid has 3.6 million nodes.
    for strategy in [Strategy::BreadthFirst, Strategy::Proof(Goal::ClosedMap)] {
        let monitor = Arc::new(Monitor::default());
        let visitor = interrupt_once_under_way(&monitor);
        let builder = watched(strategy, &monitor).axioms(Axioms::default());
        let mapper = builder.explain(&walk()).unwrap();
        visitor.join().unwrap();
        let report = mapper.report();
        assert_eq!(report.stop, StopReason::Interrupted);
        assert!(monitor.travels() > 0);
        if strategy == Strategy::BreadthFirst {
            assert!(mapper.explained() >= monitor.travels() as usize);
            assert_eq!(mapper.maps(usize::MAX).len() as u64, report.levels[mapper.explained()].nodes);
        }
    }
    let monitor = Arc::new(Monitor::default());
    let visitor = interrupt_once_under_way(&monitor);
    assert_eq!(counted(NONE, &monitor).stop, StopReason::Interrupted);
    visitor.join().unwrap();
}

#[test]
fn a_monitor_counts_the_nodes_of_a_complete_search() {
    for strategy in STRATEGIES {
        let monitor = Arc::new(Monitor::default());
        let mapper = watched(strategy, &monitor).explain(&walk().prefix(16)).unwrap();
        assert_eq!(monitor.nodes() + 1, mapper.report().nodes);
    }
}

#[test]
fn reasons_in_words() {
    let words = [
        (StopReason::Exhausted, "searched everything", "\"exhausted\""),
        (StopReason::NodeLimit, "stopped by the node limit", "\"node_limit\""),
        (StopReason::Interrupted, "interrupted", "\"interrupted\""),
    ];
    for (reason, text, _) in words {
        assert_eq!(reason.to_string(), text);
    }
}
