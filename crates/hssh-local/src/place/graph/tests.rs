//! Stars of places whose form is known: drawn corridors in all directions, and rotated ones.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use hssh_metrics::wrap_angle;
use hssh_topology::{Isomorphism, Star};

use super::{NeighborhoodError, PlaceGraph, PlaceGraphError, neighborhood};
use crate::grid::{Lattice, Occupancy, OccupancyGrid};
use crate::place::{PlaceKind, PlaceOptions};

/// Free space made of corridors 2 m wide that leave the origin in the given directions (degrees), in a
/// disc of `room` metres, on a grid of 14 m turned by `turn` radians; all else is wall.
fn corridors(directions: &[f64], room: f64, turn: f64) -> OccupancyGrid {
    let lattice = Lattice::new(140, 140, 0.1, [-7.0, -7.0]).unwrap();
    let cells = lattice.cells().map(|cell| {
        let [x, y] = lattice.center(cell);
        let is_in_corridor = |&degrees: &f64| {
            let (sin, cos) = (degrees.to_radians() + turn).sin_cos();
            cos * x + sin * y > -1.0 && (cos * y - sin * x).abs() < 1.0
        };
        let is_free = x.hypot(y) < room || directions.iter().any(is_in_corridor);
        if is_free { Occupancy::Free } else { Occupancy::Occupied }
    });
    OccupancyGrid::new(lattice, cells.collect()).unwrap()
}

/// Checks kind, star and bearings in many rotations.
fn check(directions: &[f64], room: f64, kind: PlaceKind, star: &str) {
    let expected: Star = star.parse().unwrap();
    for step in 0..24 {
        let turn = f64::from(step) * TAU / 24.0 + 0.03;
        let grid = corridors(directions, room, turn);
        let found = neighborhood(&grid, [0.1, -0.1], &PlaceOptions::default()).unwrap();
        let context = format!("{directions:?} turned by {turn}: {}", found.star.star);
        assert_eq!(found.kind, kind, "{context}");
        assert!(Isomorphism::all(&expected, &found.star.star).next().is_some(), "{context}");
        for direction in directions {
            let bearing = wrap_angle(direction.to_radians() + turn);
            let is_there =
                |olp: hssh_topology::Olp| wrap_angle(found.star.bearings[olp.index()] - bearing).abs() < 0.2;
            assert!(
                found.star.star.gateways().any(is_there),
                "{context} {bearing} {:?}",
                found.star.bearings
            );
        }
        for gateway in found.star.gateways() {
            assert!((gateway.width - 2.0).abs() < 0.4, "{context}: {gateway:?}");
        }
        assert!(found.star.bearings.windows(2).all(|pair| pair[0] > pair[1]), "{context}");
    }
}

#[test]
fn example_2_1_is_seen_in_corridors() {
    check(&[0.0, 90.0, 180.0, 270.0], 0.0, PlaceKind::Junction, "0+ 1+ 0- 1-");
    check(&[0.0, 90.0, 180.0], 0.0, PlaceKind::Junction, "0+ (1+) 0- 1-");
    check(&[0.0, 90.0], 0.0, PlaceKind::Corner, "(0+) 1+ 0- (1-)");
}

#[test]
fn a_dead_end_has_one_gateway_and_a_corridor_is_no_place() {
    check(&[0.0], 0.0, PlaceKind::DeadEnd, "0+ (0-)");
    check(&[0.0, 180.0], 0.0, PlaceKind::Passage, "0+ 0-");
}

#[test]
fn three_ways_apart_are_three_paths_that_end() {
    check(&[90.0, 210.0, 330.0], 0.0, PlaceKind::Junction, "0+ (1+) 2+ (0-) 1- (2-)");
}

#[test]
fn a_rotunda_has_as_many_gateways_as_corridors() {
    check(
        &[0.0, 72.0, 144.0, 216.0, 288.0],
        3.0,
        PlaceKind::Junction,
        "0+ (1+) 2+ (3+) 4+ (0-) 1- (2-) 3- (4-)",
    );
    check(&[0.0, 60.0, 120.0, 180.0, 240.0, 300.0], 3.5, PlaceKind::Junction, "0+ 1+ 2+ 0- 1- 2-");
}

#[test]
fn a_ring_of_corridors_has_four_corners_that_lead_to_one_another() {
    let lattice = Lattice::new(160, 160, 0.1, [0.0, 0.0]).unwrap();
    let cells = lattice.cells().map(|cell| {
        let [x, y] = lattice.center(cell).map(|coordinate| (coordinate - 8.0).abs());
        let is_free = x.max(y) < 7.0 && x.max(y) > 5.0;
        if is_free { Occupancy::Free } else { Occupancy::Occupied }
    });
    let grid = OccupancyGrid::new(lattice, cells.collect()).unwrap();
    let graph = PlaceGraph::new(&grid, &PlaceOptions::default()).unwrap();
    assert_eq!(graph.places.iter().map(|place| place.kind).collect::<Vec<_>>(), [PlaceKind::Corner; 4]);
    assert_eq!((graph.connections.len(), graph.open_ends.len()), (4, 0));
    for connection in &graph.connections {
        let bearings = connection.ends.map(|(place, olp)| graph.place(place).star.bearings[olp.index()]);
        assert!((wrap_angle(bearings[0] - bearings[1]).abs() - PI).abs() < 0.1);
        assert!(wrap_angle(4.0 * bearings[0]).abs() < 0.4, "along an axis, a multiple of {FRAC_PI_2}");
    }
}

#[test]
fn a_grid_without_places_says_why() {
    let lattice = Lattice::new(20, 20, 0.1, [0.0, 0.0]).unwrap();
    let filled = |occupancy| OccupancyGrid::filled(lattice, occupancy);
    let error = |grid: &OccupancyGrid| PlaceGraph::new(grid, &PlaceOptions::default()).unwrap_err();
    assert_eq!(error(&filled(Occupancy::Unknown)), PlaceGraphError::AllUnknown { cells: 400 });
    assert_eq!(error(&filled(Occupancy::Occupied)), PlaceGraphError::NothingFree { cells: 400 });
    assert_eq!(error(&filled(Occupancy::Free)), PlaceGraphError::NoObstacle);
    let mut narrow = filled(Occupancy::Occupied);
    narrow.set(lattice.cell(30), Occupancy::Free);
    assert_eq!(error(&narrow), PlaceGraphError::TooNarrow { narrowest: 0.6, resolution: 0.1 });
    let grid = corridors(&[0.0], 0.0, 0.0);
    let outside = neighborhood(&grid, [99.0, 0.0], &PlaceOptions::default()).unwrap_err();
    assert_eq!(outside, NeighborhoodError::OffGrid([99.0, 0.0]));
}
