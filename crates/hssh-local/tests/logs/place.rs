//! Places in painted grids: their ways out are known because the corridors were painted.

use hssh_local::{Lattice, Occupancy, OccupancyGrid, PlaceOptions, Sighting, sight};
use nalgebra::{Rotation2, Vector2, vector};

/// Corridors of 2 m from the origin in some directions (degrees), each of a length in metres, and walls
/// of two cells around them; everything else was never seen.
fn crossing(ways: &[(f64, f64)]) -> OccupancyGrid {
    let lattice = Lattice::new(280, 280, 0.1, [-14.0, -14.0]).unwrap();
    let distance_to = |point: Vector2<f64>| {
        let off = |&(bearing, length): &(f64, f64)| {
            let local = Rotation2::new(-f64::to_radians(bearing)) * point;
            let beyond = if local.x < -1.0 { -1.0 - local.x } else { (local.x - length).max(0.0) };
            let outside = local.y.abs() - 1.0;
            if beyond > 0.0 { beyond.hypot(outside.max(0.0)) } else { outside }
        };
        ways.iter().map(off).fold(f64::INFINITY, f64::min)
    };
    let cells = lattice.cells().map(|cell| match distance_to(Vector2::from(lattice.center(cell))) {
        inside if inside <= 0.0 => Occupancy::Free,
        wall if wall <= 0.2 => Occupancy::Occupied,
        _ => Occupancy::Unknown,
    });
    OccupancyGrid::new(lattice, cells.collect()).unwrap()
}

fn seen(ways: &[(f64, f64)], from: [f64; 2]) -> Sighting {
    sight(&crossing(ways), from.into(), &PlaceOptions::corridors()).unwrap()
}

/// The bearings of the ways out in degrees from 20° less than `first` on, in order.
fn bearings(sighting: &Sighting, first: f64) -> Vec<f64> {
    let from_first = |bearing: f64| (bearing.to_degrees() - first + 20.0).rem_euclid(360.0) + first - 20.0;
    let mut bearings: Vec<f64> =
        sighting.gateways.iter().map(|gateway| from_first(gateway.bearing)).collect();
    bearings.sort_by(f64::total_cmp);
    bearings
}

#[test]
fn ways_out_are_the_corridors_and_the_center_is_where_they_meet() {
    for turned in [0.0, 17.0, 45.0, 80.0] {
        for corridors in
            [vec![0.0, 90.0], vec![0.0, 90.0, 180.0], vec![0.0, 90.0, 180.0, 270.0], vec![0.0, 120.0, 240.0]]
        {
            let ways: Vec<(f64, f64)> = corridors.iter().map(|bearing| (bearing + turned, 12.5)).collect();
            for from in [[0.0, 0.0], [0.6, -0.4], [-0.5, 0.5]] {
                let sighting = seen(&ways, from);
                let expected: Vec<f64> = ways.iter().map(|way| way.0).collect();
                let found = bearings(&sighting, turned);
                assert!(sighting.is_place && found.len() == expected.len(), "{expected:?}: {found:?}");
                for (found, expected) in found.iter().zip(&expected) {
                    assert!((found - expected).abs() < 4.0, "{expected} is seen as {found}");
                }
                assert!(sighting.center.norm() < 0.4, "{expected:?}: {}", sighting.center);
            }
        }
    }
}

#[test]
fn a_corridor_is_no_place_and_neither_are_its_rooms() {
    assert!(!seen(&[(20.0, 13.0), (200.0, 13.0)], [0.0, 0.0]).is_place);
    // A room of 5 m beside the corridor ends before a way out would have led on.
    let with_room = seen(&[(0.0, 13.0), (180.0, 13.0), (90.0, 5.0)], [0.0, 0.0]);
    assert!(!with_room.is_place, "{:?}", bearings(&with_room, 0.0));
}

#[test]
fn gateways_are_as_wide_as_the_corridors() {
    for gateway in seen(&[(0.0, 12.5), (90.0, 12.5), (180.0, 12.5)], [0.0, 0.0]).gateways {
        assert!((gateway.width - 2.0).abs() < 0.3, "{gateway:?}");
    }
}

#[test]
fn in_a_wall_there_is_nothing_to_see() {
    let grid = crossing(&[(0.0, 12.5)]);
    assert_eq!(sight(&grid, vector![-9.0, 9.0], &PlaceOptions::corridors()), None);
}

#[test]
fn a_place_has_one_center_from_wherever_it_is_seen() {
    for ways in [vec![(10.0, 13.0), (100.0, 13.0)], vec![(10.0, 13.0), (100.0, 13.0), (190.0, 13.0)]] {
        for bearing in [10.0, 100.0] {
            for distance in [1.0, 1.8, 2.6] {
                let (sin, cos) = f64::to_radians(bearing).sin_cos();
                let sighting = seen(&ways, [distance * cos, distance * sin]);
                assert!(
                    sighting.is_place && sighting.center.norm() < 0.4,
                    "{distance} m: {}",
                    sighting.center
                );
            }
        }
    }
}

#[test]
fn a_dead_end_is_a_place_where_its_walls_were_seen() {
    let sighting = seen(&[(30.0, 13.0)], [1.0, 0.6]);
    assert!(sighting.is_place && sighting.center.norm() < 0.4, "{}", sighting.center);
    assert_eq!(bearings(&sighting, 30.0).len(), 1);
    // From afar it is none yet.
    assert!(!seen(&[(30.0, 13.0)], [5.2, 3.0]).is_place);
    // Where the wall at the end was not seen, nobody knows whether the corridor goes on.
    let mut grid = crossing(&[(0.0, 13.0)]);
    for cell in grid.lattice().cells().collect::<Vec<_>>() {
        if grid.lattice().center(cell)[0] < -0.5 {
            grid.set(cell, Occupancy::Unknown);
        }
    }
    assert!(!sight(&grid, vector![1.0, 0.0], &PlaceOptions::corridors()).unwrap().is_place);
}
