//! Laws of the simulated robot: it touches nothing, keeps to the midline, centers in the places it meant to
//! reach, and does the same again.

#![allow(clippy::unwrap_used)] // a law that cannot be tried is broken

use std::collections::BTreeSet;

use hssh_local::{LaserLog, Occupancy, OccupancyGrid, PlaceGraph, PlaceNumber, PlaceOptions};
use hssh_world::robot::{Drive, DriveError, Ending, RobotOptions, Strategy, drive};
use hssh_world::{Floor, Point, floor_plan, floors};

const RESOLUTION: f64 = 0.1;

fn plan(floor: &Floor) -> OccupancyGrid {
    floor_plan(&floor.world, floor.width, RESOLUTION).unwrap()
}

fn named(name: &str) -> Floor {
    floors().into_iter().find(|floor| floor.name == name).unwrap()
}

fn driven(grid: &OccupancyGrid, travels: usize, seed: u64) -> Drive {
    let options = RobotOptions { travels, ..RobotOptions::default() };
    drive(grid, None, Strategy::Cover, &options, seed).unwrap()
}

/// The place of the world that is nearest to a point.
fn nearest(floor: &Floor, [x, y]: [f64; 2]) -> (usize, f64) {
    let away =
        |(index, place): (usize, &hssh_world::Place)| (index, place.position.distance_to(Point::new(x, y)));
    floor.world.places().iter().enumerate().map(away).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
}

#[test]
fn the_places_of_a_floor_plan_are_those_of_its_world() {
    for floor in floors() {
        let graph = PlaceGraph::new(&plan(&floor), &PlaceOptions::default()).unwrap();
        let places: Vec<(usize, f64)> =
            graph.places.iter().map(|place| nearest(&floor, place.center)).collect();
        assert!(places.iter().all(|place| place.1 < floor.width / 2.0), "{}: {places:?}", floor.name);
        let distinct: BTreeSet<usize> = places.iter().map(|place| place.0).collect();
        assert_eq!(
            (distinct.len(), places.len()),
            (floor.world.places().len(), distinct.len()),
            "{}",
            floor.name
        );
        for (place, (index, _)) in graph.places.iter().zip(&places) {
            let gateways = floor.world.places()[*index].star.gateways().count();
            assert_eq!(place.star.gateways().count(), gateways, "{}: place {index}", floor.name);
        }
        let sorted = |mut pairs: Vec<[usize; 2]>| {
            pairs.iter_mut().for_each(|pair| pair.sort_unstable());
            pairs.sort_unstable();
            pairs
        };
        let found =
            graph.connections.iter().map(|found| found.ends.map(|(place, _)| places[place.index()].0));
        let built = floor.world.links().iter().map(|link| link.ends.map(|end| end.place.index()));
        assert_eq!(sorted(found.collect()), sorted(built.collect()), "{}", floor.name);
    }
}

#[test]
fn it_reaches_the_places_it_meant_to_and_centers_in_them() {
    for floor in floors() {
        let found = driven(&plan(&floor), 10, 1);
        // Ten travels may be too few for every corridor.
        let is_well = matches!(found.ending, Ending::Done | Ending::OutOfTravels(_));
        assert!(is_well, "{}: {}", floor.name, found.ending);
        let mut sum = 0.0;
        for stop in &found.stops {
            assert!(stop.place.is_some() && (stop.meant.is_none() || stop.meant == stop.place), "{stop:?}");
            // The center is where the midlines of the corridors meet.
            let (_, off) = nearest(&floor, [stop.pose.x, stop.pose.y]);
            assert!(off < floor.width / 2.0, "{}: {off:.2} m off, not in the crossing: {stop:?}", floor.name);
            sum += off;
        }
        let mean = sum / found.stops.len() as f64;
        assert!(mean < 0.2, "{}: {mean:.2} m off center on the mean", floor.name);
    }
}

/// No cell whose middle is in the robot's disc is anything but free, wherever the robot was.
/// Beside short spurs a scan alone at times shows no place, and the robot would turn to and fro where it climbs to none.
#[test]
fn a_climb_that_does_not_end_is_begun_anew() {
    let floor = named("spurs");
    let drive = driven(&plan(&floor), 60, 7);
    assert_eq!(drive.ending, Ending::Done);
    assert_eq!(drive.stops.len(), 10);
    let centered = drive.stops.iter().map(|stop| nearest(&floor, [stop.pose.x, stop.pose.y]));
    let places: BTreeSet<usize> = centered.filter(|(_, away)| *away < 0.5).map(|(place, _)| place).collect();
    assert_eq!(places.len(), floor.world.places().len());
}

#[test]
fn it_never_enters_what_is_not_free() {
    let floor = named("random-planar");
    let grid = plan(&floor);
    let radius = RobotOptions::default().handling.radius;
    for moment in driven(&grid, 12, 2).moments.into_iter().step_by(3) {
        let around = (-3..=3).flat_map(|row| (-3..=3).map(move |column| (column, row)));
        for (column, row) in around {
            let here = grid.lattice().cell_at([moment.pose.x, moment.pose.y]).unwrap();
            let cell = grid.lattice().step(here, column, row).unwrap();
            let [x, y] = grid.lattice().center(cell);
            let is_in = (x - moment.pose.x).hypot(y - moment.pose.y) <= radius;
            assert!(!is_in || grid.get(cell) == Occupancy::Free, "{moment:?}");
        }
    }
}

#[test]
fn it_keeps_to_the_midline_of_straight_corridors() {
    let floor = named("figure-eight");
    let lines: Vec<[Point; 2]> = floor
        .world
        .links()
        .iter()
        .map(|link| link.ends.map(|end| floor.world.place(end.place).position))
        .collect();
    let found = driven(&plan(&floor), 9, 3);
    let mut checked = 0;
    for moment in &found.moments {
        let at = Point::new(moment.pose.x, moment.pose.y);
        if nearest(&floor, [at.x, at.y]).1 < 5.0 {
            continue;
        }
        let off = lines.iter().map(|&[a, b]| {
            let length = a.distance_to(b);
            let along = ((at.x - a.x) * (b.x - a.x) + (at.y - a.y) * (b.y - a.y)) / length;
            let across = ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / length;
            if (0.0..=length).contains(&along) { across.abs() } else { f64::INFINITY }
        });
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off <= 2.0 * RESOLUTION, "{off:.2} m off the midline at {:?}", moment.pose);
        checked += 1;
    }
    assert!(checked > 500, "only {checked} moments were in corridors");
}

#[test]
fn the_same_seed_gives_the_same_log() {
    let grid = plan(&named("ring"));
    let log = |seed| driven(&grid, 3, seed).to_carmen();
    assert_eq!(log(5), log(5));
    assert_ne!(log(5), log(6));
}

#[test]
fn noise_does_not_change_which_way_is_taken() {
    let grid = plan(&named("grid-3x3"));
    let way = |noise| {
        let options = RobotOptions { travels: 8, ..RobotOptions::default() }.with_noise(noise);
        let found = drive(&grid, None, Strategy::Wander, &options, 4).unwrap();
        found.stops.iter().map(|stop| stop.place).collect::<Vec<_>>()
    };
    assert_eq!(way(0.0), way(1.5));
}

#[test]
fn a_log_is_read_as_it_was_written() {
    let found = driven(&plan(&named("ring")), 3, 7);
    let log = LaserLog::read(found.to_carmen().as_bytes()).unwrap();
    assert!(log.warnings.is_empty() && log.skipped.is_empty());
    assert_eq!((log.beams(), log.max_range), (181, found.max_range));
    assert_eq!(log.trajectory.len(), found.moments.len());
    let logged: Vec<_> = found.moments.iter().filter(|moment| moment.scan.is_some()).collect();
    assert_eq!(log.scans.len(), logged.len());
    for (read, written) in log.scans.iter().zip(logged) {
        for (pose, truth) in [(read.corrected, written.pose), (read.odometry, written.odometry)] {
            let off = pose.between(truth);
            assert!(off.translation().norm() < 1e-4 && off.theta.abs() < 1e-5);
        }
        for (range, truth) in read.scan.ranges.iter().zip(written.scan.as_ref().unwrap()) {
            assert!(range == truth || (range - truth).abs() < 1e-3, "{range} {truth}");
        }
    }
}

#[test]
fn a_list_of_places_is_visited_in_order() {
    let grid = plan(&named("grid-3x3"));
    let graph = PlaceGraph::new(&grid, &PlaceOptions::default()).unwrap();
    let next = |from: PlaceNumber, but: Option<PlaceNumber>| {
        let ends = graph.connections.iter().flat_map(|found| {
            let [a, b] = found.ends.map(|end| end.0);
            [(a, b), (b, a)]
        });
        ends.filter(|&(a, b)| a == from && Some(b) != but).map(|(_, b)| b).next().unwrap()
    };
    let first = PlaceNumber(0);
    let second = next(first, None);
    let list = vec![first, second, next(second, Some(first))];
    let visit = |list: &[PlaceNumber]| {
        drive(&grid, None, Strategy::Visit(list.to_vec()), &RobotOptions::default(), 1)
    };
    let found = visit(&list).unwrap();
    assert_eq!(found.ending, Ending::Done);
    assert_eq!(found.stops.iter().map(|stop| stop.place.unwrap()).collect::<Vec<_>>(), list);
    assert_eq!(visit(&[first, first]).unwrap().ending, Ending::NoWayOn);
    assert!(matches!(visit(&[PlaceNumber(99)]), Err(DriveError::NoSuchPlace { last: 8, .. })));
}

#[test]
fn where_no_robot_can_start_is_said() {
    let grid = plan(&named("ring"));
    let refusal = |at: [f64; 2]| {
        drive(&grid, Some(at), Strategy::Cover, &RobotOptions::default(), 1).unwrap_err().to_string()
    };
    assert!(
        refusal([13.0, -7.0])
            .starts_with("at the start (13, -7) there is no room for a robot of 0.25 m radius")
    );
    assert!(refusal([13.0, 1.1]).contains("no room"));
    assert!(refusal([99.0, 0.0]).starts_with("the start (99, 0) is not on the map, which reaches from ("));
    let unknown = OccupancyGrid::filled(*grid.lattice(), Occupancy::Unknown);
    let error = drive(&unknown, None, Strategy::Cover, &RobotOptions::default(), 1).unwrap_err();
    assert!(error.to_string().contains("cells of the grid are unknown"), "{error}");
}
