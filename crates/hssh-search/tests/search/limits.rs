//! A search that stops early says why, keeps what it has, and can go on.

use std::sync::Arc;
use std::time::{Duration, Instant};

use hssh_causal::Exploration;
use hssh_search::{
    FinalCounts, Goal, Limits, Mapper, MapperBuilder, Monitor, Order, PosteriorModel, Report, StopReason,
};
use hssh_topology::{Axioms, MapSketch, Star, replay, violations};
use hssh_world::{DriftModel, grid, snake};

use crate::cases::{Way, grid_walk, planar, sketches};
use crate::threads::STRATEGIES;

const NONE: Limits = Limits { nodes: None, time: None, bytes: None };

/// Too much for every search here, except best-first for any map and the proof, with planarity.
fn walk() -> Exploration {
    grid_walk(5, 5, &snake(5, 5))
}

fn search(strategy: Way, limits: Limits) -> Mapper {
    Mapper::builder()
        .axioms(planar())
        .order(strategy.0)
        .goal(strategy.1)
        .limits(limits)
        .explain(&walk())
        .unwrap()
}

fn counted(limits: Limits, monitor: &Arc<Monitor>) -> Report {
    Mapper::builder().limits(limits).monitor(monitor.clone()).count(&walk()).unwrap()
}

/// What breadth-first shows after a limit is what it shows of the beginning that it explains.
fn shows_its_last_level(mapper: &Mapper) {
    let beginning = shows_its_maps(mapper);
    let (stopped, complete) = (mapper.report(), beginning.report());
    assert_eq!((stopped.levels, stopped.removals), (complete.levels, complete.removals));
}

/// The maps are those of a complete search of the travels that they explain.
fn shows_its_maps(mapper: &Mapper) -> Mapper {
    let explained = mapper.explained();
    let beginning = Mapper::builder().axioms(planar()).explain(&walk().prefix(explained)).unwrap();
    let (stopped, complete) = (mapper.report(), beginning.report());
    assert_eq!(stopped.explained, explained as u64);
    assert_eq!(stopped.finals, complete.finals);
    assert_eq!(mapper.maps(usize::MAX), beginning.maps(usize::MAX));
    assert_eq!(sketches(mapper)[..], sketches(&beginning)[..]);
    beginning
}

/// What every other search shows after a limit is one hypothesis that explains what it says, by the replay of another
/// crate, and breaks no axiom; and it is more than nothing.
fn shows_what_got_farthest(mapper: &Mapper) {
    let (explained, maps) = (mapper.explained(), mapper.maps(9));
    assert!(explained > 0 && !maps.is_empty());
    let experience = mapper.experience();
    let stars: Vec<Star> = experience.catalog.stars().cloned().collect();
    for map in &maps {
        assert_eq!(mapper.visits(map.node).len(), explained + 1);
        let sketch = MapSketch::of(&mapper.hypothesis(map.node).map, &experience.catalog);
        replay(&sketch, &stars, experience.start, &experience.observations[..explained]).unwrap();
        assert!(violations(&sketch, &planar()).unwrap().is_empty());
    }
    assert_eq!(mapper.report().explained, explained as u64);
    assert!(!mapper.report().is_optimal);
}

#[test]
fn a_limit_on_nodes() {
    let limit = 1000;
    for strategy in STRATEGIES {
        let mut mapper = search(strategy, Limits { nodes: Some(limit), ..NONE });
        let before = mapper.report();
        assert_eq!(before.stop, StopReason::NodeLimit);
        assert!(!before.stop.is_complete());
        if strategy == (Order::BreadthFirst, Goal::AnyMap) {
            assert!(before.nodes <= limit && before.explained > 0);
            shows_its_last_level(&mapper);
        } else {
            assert!(before.nodes > limit);
            shows_what_got_farthest(&mapper);
        }
        // The limit is still the same.
        assert_eq!(mapper.advance(), StopReason::NodeLimit);
        assert_eq!(Report { seconds: before.seconds, ..mapper.report() }.finals, before.finals);
    }
    let report = counted(Limits { nodes: Some(limit), ..NONE }, &Arc::default());
    assert_eq!(report.stop, StopReason::NodeLimit);
}

/// With measured travels, too, and the poses are those of the travels explained.
#[test]
fn a_limit_on_nodes_with_measured_travels() {
    let world = grid(5, 5, 8.0).unwrap();
    let route = world.route_through(&snake(5, 5)).unwrap();
    let walk = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let model = PosteriorModel::evidence(&walk).unwrap();
    for order in [Order::BestFirst, Order::Proof, Order::Cyclic, Order::BreadthFirst] {
        let builder = Mapper::builder().axioms(planar()).order(order).posterior(model);
        let mapper = builder.limits(Limits { nodes: Some(30), ..NONE }).explain(&walk).unwrap();
        assert_eq!(mapper.report().stop, StopReason::NodeLimit);
        shows_what_got_farthest(&mapper);
        let best = &mapper.maps(1)[0];
        let poses = best.probable.as_ref().unwrap().poses.len();
        assert_eq!(poses as u32, best.measure.places, "{order:?}");
    }
}

/// The clock is looked at in the set-up, too, which goes on where it stopped.
#[test]
fn no_time_for_the_set_up() {
    let world = grid(6, 6, 8.0).unwrap();
    let route = world.route_through(&snake(6, 6)).unwrap();
    let walk = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let model = PosteriorModel::evidence(&walk).unwrap();
    let builder = || Mapper::builder().axioms(planar()).order(Order::Cyclic).posterior(model);
    let whole = builder().explain(&walk).unwrap();
    let none = Limits { time: Some(Duration::ZERO), ..NONE };
    let mut mapper = builder().limits(none).explain(&walk).unwrap();
    let report = mapper.report();
    assert_eq!((report.stop, report.is_optimal), (StopReason::TimeLimit, false));
    assert_eq!(report.proof.and_then(|proof| proof.rest), Some(1.0));
    mapper.set_limits(NONE);
    assert_eq!(mapper.advance(), whole.report().stop);
    assert_eq!(mapper.maps(9), whole.maps(9));
}

/// Where a level takes longer to be looked through than there is time, one before it is shown, and nothing is lost.
#[test]
fn no_time_to_look_at_a_level() {
    let short = Limits { time: Some(Duration::from_micros(1)), ..NONE };
    let mut mapper = search((Order::BreadthFirst, Goal::AnyMap), Limits { nodes: Some(200_000), ..NONE });
    let deepest = mapper.explained();
    mapper.set_limits(short);
    assert_eq!(mapper.advance(), StopReason::TimeLimit);
    assert!(mapper.explained() < deepest);
    shows_its_maps(&mapper);
    mapper.set_limits(Limits { nodes: Some(200_000), ..NONE });
    assert_eq!((mapper.advance(), mapper.explained()), (StopReason::NodeLimit, deepest));
}

#[test]
fn a_limit_on_memory() {
    for strategy in STRATEGIES {
        let mapper = search(strategy, Limits { bytes: Some(20_000), ..NONE });
        assert_eq!(mapper.report().stop, StopReason::MemoryLimit);
        if strategy == (Order::BreadthFirst, Goal::AnyMap) {
            assert!(mapper.explained() > 0 && mapper.report().bytes <= 20_000);
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
    let breadth_first = search((Order::BreadthFirst, Goal::AnyMap), none);
    assert_eq!((breadth_first.explained(), breadth_first.maps(9).len()), (0, 1));
    shows_its_last_level(&breadth_first);
    let report = counted(none, &Arc::default());
    assert_eq!((report.stop, report.nodes), (StopReason::TimeLimit, 1));
}

/// A time limit holds for one call; many short calls end where a long one does.
#[test]
fn going_on_after_a_time_limit() {
    let short = Limits { time: Some(Duration::from_millis(5)), ..NONE };
    let (large, small) = (walk(), grid_walk(4, 4, &snake(4, 4)));
    let cases = [
        // A level is made in one call or not at all: these are small.
        ((Order::BreadthFirst, Goal::AnyMap), &small),
        ((Order::BestFirst, Goal::AnyMap), &large),
        ((Order::Proof, Goal::AnyMap), &large),
        ((Order::Proof, Goal::ClosedMap), &large),
    ];
    let axioms = Axioms { max_places: Some(16), ..planar() };
    for (strategy, exploration) in cases {
        let axioms = if strategy == (Order::BreadthFirst, Goal::AnyMap) { axioms } else { planar() };
        let search = |limits| {
            let builder = Mapper::builder().axioms(axioms).order(strategy.0).goal(strategy.1).limits(limits);
            builder.explain(exploration).unwrap()
        };
        let (whole, mut mapper) = (search(NONE), search(short));
        let mut calls = 1;
        while mapper.advance() == StopReason::TimeLimit {
            calls += 1;
            assert!(calls < 2000, "{strategy:?} does not come to an end");
        }
        let seconds = mapper.report().seconds;
        assert_eq!(mapper.report(), Report { seconds, ..whole.report() });
        assert_eq!(mapper.maps(usize::MAX), whole.maps(usize::MAX));
    }
}

fn watched(strategy: Way, monitor: &Arc<Monitor>) -> MapperBuilder {
    Mapper::builder().axioms(planar()).order(strategy.0).goal(strategy.1).monitor(Arc::clone(monitor))
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

/// Interrupts a search once it has come some way, or takes too long to.
fn interrupt_once_under_way(monitor: &Arc<Monitor>) -> std::thread::JoinHandle<()> {
    let (monitor, started) = (Arc::clone(monitor), Instant::now());
    std::thread::spawn(move || {
        while monitor.nodes() < 2000 && started.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(1));
        }
        monitor.interrupt();
    })
}

#[test]
fn interrupted_on_the_way() {
    for strategy in [
        (Order::BreadthFirst, Goal::AnyMap),
        (Order::BestFirst, Goal::ClosedMap),
        (Order::Proof, Goal::AnyMap),
    ] {
        let monitor = Arc::new(Monitor::default());
        let visitor = interrupt_once_under_way(&monitor);
        let builder = watched(strategy, &monitor).axioms(Axioms::default());
        let mapper = builder.explain(&walk()).unwrap();
        visitor.join().unwrap();
        let report = mapper.report();
        assert_eq!(report.stop, StopReason::Interrupted);
        assert!(monitor.nodes() >= 2000 && monitor.travels() > 0);
        if strategy == (Order::BreadthFirst, Goal::AnyMap) {
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
        (StopReason::Exhausted, "searched everything"),
        (StopReason::Found, "found a map"),
        (StopReason::Proved, "proved the best map"),
        (StopReason::NodeLimit, "stopped by the node limit"),
        (StopReason::TimeLimit, "stopped by the time limit"),
        (StopReason::MemoryLimit, "stopped by the memory limit"),
        (StopReason::Interrupted, "interrupted"),
    ];
    for (reason, text) in words {
        assert_eq!(reason.to_string(), text);
    }
}

/// Where somebody tells what the process takes, the limit is on that.
#[test]
fn a_limit_on_what_the_process_takes() {
    let stop = |most: u64| {
        let monitor = Arc::new(Monitor::default());
        monitor.watch_memory(|| Some(100 << 20));
        let limits = Limits { bytes: Some(most << 20), nodes: Some(1000), ..NONE };
        let search = Mapper::builder().axioms(planar()).limits(limits).monitor(monitor);
        search.explain(&walk()).unwrap().report().stop
    };
    assert_eq!(stop(100), StopReason::MemoryLimit);
    assert_eq!(stop(110), StopReason::NodeLimit);
}
