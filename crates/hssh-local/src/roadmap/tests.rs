//! Roadmaps of floors whose ways are known, and of random ones against brute force.

use proptest::prelude::*;

use super::{RoadNodeKind, Roadmap, RoadmapOptions};
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::region::{RegionKind, RegionMap, RegionOptions};

/// A grid of 10 cm of which the rectangles (left, bottom, right, top in cells) are free.
fn floor(width: u32, height: u32, free: &[[u32; 4]]) -> OccupancyGrid {
    let lattice = Lattice::new(width, height, 0.1, [-3.0, 2.0]).unwrap();
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
    for &[left, bottom, right, top] in free {
        for row in bottom..top.min(height) {
            for column in left..right.min(width) {
                grid.set(Cell { column, row }, Occupancy::Free);
            }
        }
    }
    grid
}

fn roadmap(grid: &OccupancyGrid) -> (RegionMap, Roadmap) {
    let map = RegionMap::new(grid, &RegionOptions::default()).unwrap();
    let roadmap = Roadmap::new(grid, &map, &RoadmapOptions::default());
    (map, roadmap)
}

/// A ring of corridors with a bar across, and a room at it: two junctions, three ways between them, one to the room.
#[test]
fn a_ring_with_a_bar_has_two_junctions() {
    let grid = floor(
        220,
        130,
        &[
            [5, 5, 215, 25],
            [5, 105, 215, 125],
            [5, 5, 25, 125],
            [195, 5, 215, 125],
            [100, 5, 120, 125],
            [130, 40, 180, 90],
            [120, 60, 130, 69],
        ],
    );
    let (map, roadmap) = roadmap(&grid);
    assert_eq!((map.regions.len(), map.passages.len()), (2, 1));
    assert_eq!((roadmap.places.len(), roadmap.connections.len()), (3, 4));
    let room = roadmap.connections.iter().find(|connection| !connection.passages.is_empty()).unwrap();
    assert_eq!(room.passages, [0]);
    let ends = roadmap.places.iter().map(|place| place.star.as_ref().unwrap().gateways().count());
    let mut ends: Vec<usize> = ends.collect();
    ends.sort_unstable();
    assert_eq!(ends, [1, 3, 4]);
}

/// Rooms in a row, each with a door to a corridor.
#[test]
fn any_number_of_threads_draws_the_same_roadmap() {
    let rooms = (0..12)
        .flat_map(|room| [[5 + 50 * room, 30, 50 + 50 * room, 80], [20 + 50 * room, 25, 29 + 50 * room, 30]]);
    let free: Vec<[u32; 4]> = rooms.chain([[5, 5, 600, 25]]).collect();
    let grid = floor(610, 90, &free);
    let drawn = |threads: usize| {
        let crew = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        crew.install(|| roadmap(&grid).1)
    };
    let [one, four] = [1, 4].map(drawn);
    assert_eq!((one.nodes, one.ways), (four.nodes, four.ways));
    assert_eq!((one.places, one.connections), (four.places, four.connections));
}

#[test]
fn a_closed_room_is_a_place_without_a_star() {
    let (_, roadmap) = roadmap(&floor(100, 120, &[[10, 10, 90, 110]]));
    assert_eq!((roadmap.places.len(), roadmap.connections.len()), (1, 0));
    assert!(roadmap.places[0].star.is_none());
    assert!((roadmap.places[0].center[0] - 2.0).abs() < 0.2);
}

/// A niche that is wide open to a corridor which is wider than it.
#[test]
fn a_place_is_in_its_region() {
    let grid = floor(120, 70, &[[5, 5, 115, 29], [50, 31, 70, 61], [53, 29, 67, 31]]);
    let (map, roadmap) = roadmap(&grid);
    assert_eq!((map.regions.len(), roadmap.places.len()), (2, 2));
    for place in &roadmap.places {
        assert_eq!(map.region_at(place.center), Some(place.region));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    /// On floors of random rectangles no way comes near to an obstacle, every way ends at its nodes, and connections are
    /// chains of ways from place to place.
    #[test]
    fn ways_are_free_and_connections_are_ways(
        rooms in prop::collection::vec((1_u32..90, 1_u32..70, 6_u32..40, 6_u32..40), 2..12),
        chairs in prop::collection::vec((1_u32..99, 1_u32..79), 0..12),
    ) {
        let free: Vec<[u32; 4]> =
            rooms.iter().map(|&(x, y, w, h)| [x, y, (x + w).min(99), (y + h).min(79)]).collect();
        let mut grid = floor(100, 80, &free);
        chairs.iter().for_each(|&(column, row)| grid.set(Cell { column, row }, Occupancy::Occupied));
        let map = RegionMap::new(&grid, &RegionOptions::default());
        prop_assume!(map.is_ok());
        let map = map.unwrap();
        let options = RoadmapOptions::default();
        let roadmap = Roadmap::new(&grid, &map, &options);
        let lattice = *grid.lattice();
        let blocked: Vec<[f64; 2]> = lattice
            .cells()
            .filter(|&cell| grid.get(cell) != Occupancy::Free)
            .map(|cell| lattice.center(cell))
            .collect();
        for way in &roadmap.ways {
            let ends = way.ends.map(|end| roadmap.node(end).position);
            prop_assert_eq!(ends, [way.line[0], way.line[way.line.len() - 1]]);
            for pair in way.line.windows(2) {
                for step in 0..=20 {
                    let part = f64::from(step) / 20.0;
                    let point = [0, 1].map(|axis| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]));
                    let to_side = |center: &[f64; 2]| {
                        let beyond = [0, 1].map(|axis| ((point[axis] - center[axis]).abs() - 0.05).max(0.0));
                        beyond[0].hypot(beyond[1])
                    };
                    let clearance = blocked.iter().map(to_side).fold(f64::INFINITY, f64::min);
                    prop_assert!(clearance >= options.radius - 2e-3, "{} at {:?}", clearance, point);
                    prop_assert!(2.0 * clearance >= way.width - 2e-2);
                }
            }
        }
        for connection in &roadmap.connections {
            let centers = connection.ends.map(|(place, _)| roadmap.place(place).center);
            prop_assert_eq!([connection.line[0], connection.line[connection.line.len() - 1]], centers);
            let length: f64 = connection.ways.iter().map(|&way| roadmap.ways[way as usize].length).sum();
            prop_assert!((length - connection.length).abs() < 1e-6);
        }
        for (number, place) in roadmap.places.iter().enumerate() {
            // Where ways part in a passage is a place of a corridor.
            let is_in = map.region_at(place.center) == Some(place.region);
            prop_assert!(is_in || map.region(place.region).kind == RegionKind::Corridor);
            let at = roadmap.connections.iter().flat_map(|connection| connection.ends);
            let ends = at.filter(|(other, _)| other.index() == number).count();
            let gateways = place.star.as_ref().map_or(0, |star| star.gateways().count());
            prop_assert_eq!(ends, gateways);
        }
        let passages = roadmap.nodes.iter().filter(|node| matches!(node.kind, RoadNodeKind::Passage(_))).count();
        prop_assert!(passages <= map.passages.len());
    }
}
