//! Regions of floors whose rooms are known, and the parts of the way to them against brute force.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;

use super::border::{Border, Gap, Pair};
use super::flood::{Joining, NO_PIECE, flood};
use super::ground::Ground;
use super::island::Islands;
use super::merge::{Extent, cut_odds, merged};
use super::{CutOptions, RegionKind, RegionMap, RegionOptions};
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::skeleton::UnknownSpace;

/// A grid of 5 cm of which the rectangles (left, bottom, right, top in metres) are free, one after the other painted over by
/// `then`; all else is wall.
fn floor(size: [f64; 2], free: &[[f64; 4]], then: &[([f64; 4], Occupancy)]) -> OccupancyGrid {
    let cells = |metres: f64| (metres / 0.05).round() as u32;
    let lattice = Lattice::new(cells(size[0]), cells(size[1]), 0.05, [0.0, 0.0]).unwrap();
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
    let painted = free.iter().map(|&area| (area, Occupancy::Free)).chain(then.iter().copied());
    for ([left, bottom, right, top], occupancy) in painted {
        for row in cells(bottom)..cells(top) {
            for column in cells(left)..cells(right) {
                grid.set(Cell { column, row }, occupancy);
            }
        }
    }
    grid
}

fn regions(grid: &OccupancyGrid) -> RegionMap {
    RegionMap::new(grid, &RegionOptions::default()).unwrap()
}

/// Two rooms above a corridor, each with a door to it and one between them.
const ROOMS: [[f64; 4]; 6] = [
    [0.5, 0.5, 12.5, 2.5],
    [0.5, 2.7, 6.4, 7.5],
    [6.6, 2.7, 12.5, 7.5],
    [2.0, 2.5, 2.9, 2.7],
    [10.0, 2.5, 10.9, 2.7],
    [6.4, 5.0, 6.6, 5.9],
];

#[test]
fn rooms_and_a_corridor_are_parted_by_doors() {
    let map = regions(&floor([13.0, 8.0], &ROOMS, &[]));
    let kinds: Vec<RegionKind> = map.regions.iter().map(|region| region.kind).collect();
    assert_eq!(kinds.len(), 3, "{kinds:?}");
    assert_eq!(kinds.iter().filter(|&&kind| kind == RegionKind::Corridor).count(), 1, "{kinds:?}");
    assert_eq!(map.passages.len(), 3);
    for passage in &map.passages {
        assert!(passage.is_door(), "{passage:?}");
        assert!((passage.gateway.width - 0.9).abs() < 0.1, "{passage:?}");
        let ahead = |sign: f64| {
            let (sin, cos) = passage.gateway.bearing.sin_cos();
            let [x, y] = passage.gateway.position;
            map.region_at([x + sign * 0.5 * cos, y + sign * 0.5 * sin]).unwrap()
        };
        assert_eq!(
            passage.regions,
            [ahead(-1.0), ahead(1.0)],
            "the bearing points from the first to the second"
        );
    }
    let areas: f64 = map.regions.iter().map(|region| region.area).sum();
    let outline: f64 = map.outlines().iter().flat_map(|outline| &outline.around).map(|ring| area(ring)).sum();
    assert!((areas - outline).abs() < 0.01 * areas, "{areas} {outline}");
}

fn area(ring: &[[f64; 2]]) -> f64 {
    let twice = (0..ring.len()).map(|at| {
        let ([ax, ay], [bx, by]) = (ring[at], ring[(at + 1) % ring.len()]);
        ax * by - ay * bx
    });
    twice.sum::<f64>() / 2.0
}

/// Tables, a cupboard along a wall and chairs are no walls, and gray rims no frontiers.
#[test]
fn furniture_and_gray_rims_part_nothing() {
    let furniture = [
        ([2.0, 5.0, 2.8, 5.8], Occupancy::Occupied),
        ([4.0, 4.0, 4.1, 4.1], Occupancy::Occupied),
        ([4.6, 4.0, 4.7, 4.1], Occupancy::Unknown),
        ([9.0, 6.9, 11.0, 7.5], Occupancy::Occupied),
        ([0.5, 2.45, 2.0, 2.5], Occupancy::Unknown),
        ([12.45, 2.7, 12.5, 7.5], Occupancy::Unknown),
    ];
    let map = regions(&floor([13.0, 8.0], &ROOMS, &furniture));
    assert_eq!((map.regions.len(), map.passages.len()), (3, 3));
}

/// A wall that a laser saw in pieces, each no longer than a chair.
/// Cells of the wall that stand out on both sides, now and then, as a laser draws them.
#[test]
fn a_corridor_with_rough_walls_is_one_region() {
    let bump = |at: u32| {
        let left = 1.0 + 1.35 * f64::from(at);
        let bottom = if at.is_multiple_of(2) { 0.5 } else { 2.45 };
        ([left, bottom, left + 0.05, bottom + 0.05], Occupancy::Occupied)
    };
    let bumps: Vec<([f64; 4], Occupancy)> = (0..12).map(bump).collect();
    let map = regions(&floor([18.0, 3.0], &[[0.5, 0.5, 17.5, 2.5]], &bumps));
    assert_eq!(map.regions.len(), 1, "{:?}", map.regions);
}

#[test]
fn pieces_in_a_row_are_a_wall() {
    let pieces: Vec<([f64; 4], Occupancy)> = (0..16)
        .map(|piece| 2.8 + 0.3 * f64::from(piece))
        .map(|from| ([6.4, from, 6.5, from + 0.2], Occupancy::Occupied))
        .collect();
    let halls = [[0.5, 0.5, 12.5, 2.5], [0.5, 2.7, 12.5, 7.5], [2.0, 2.5, 2.9, 2.7], [10.0, 2.5, 10.9, 2.7]];
    assert_eq!(regions(&floor([13.0, 8.0], &halls, &[])).regions.len(), 2);
    assert_eq!(regions(&floor([13.0, 8.0], &halls, &pieces)).regions.len(), 3);
    // Every other one is missing: what stands so far apart are posts.
    let posts: Vec<([f64; 4], Occupancy)> = pieces.into_iter().step_by(2).collect();
    assert_eq!(regions(&floor([13.0, 8.0], &halls, &posts)).regions.len(), 2);
}

/// The same passage between a wall and the end of a partition, and between the wall and a cupboard that stands free.
#[test]
fn there_is_no_door_beside_what_stands_free() {
    let passage = |end: f64| {
        let map = regions(&floor(
            [13.0, 8.0],
            &[[0.5, 0.5, 12.5, 7.5]],
            &[([6.0, 1.4, 6.2, end], Occupancy::Occupied)],
        ));
        map.passages.iter().map(|passage| passage.door_probability).fold(0.0, f64::max)
    };
    assert!(passage(7.5) > 0.5, "{}", passage(7.5));
    assert!(passage(4.0) < passage(7.5), "{}", passage(4.0));
    assert!(passage(2.6) < 0.5, "{}", passage(2.6));
}

/// Rooms without any way out, however small, and a yard without any walls.
#[test]
fn what_nothing_leads_out_of_is_one_region() {
    for side in [2.0, 8.0] {
        let map = regions(&floor([side + 1.0, side + 3.0], &[[0.5, 0.5, side + 0.5, side + 2.5]], &[]));
        assert_eq!((map.regions.len(), map.passages.len()), (1, 0), "{side} m");
    }
    let yard = floor([20.0, 20.0], &[[0.0, 0.0, 20.0, 20.0]], &[]);
    assert_eq!(regions(&yard).regions.len(), 1);
}

/// A ray of a laser through a window is no room.
#[test]
fn a_ray_belongs_to_the_room_it_came_from() {
    let ray = [([12.5, 4.0, 17.0, 4.1], Occupancy::Free)];
    let map = regions(&floor([18.0, 8.0], &ROOMS, &ray));
    assert_eq!(map.regions.len(), 3);
    assert_eq!(map.region_at([15.0, 4.05]), map.region_at([11.0, 4.05]));
}

/// Unknown space between two halves of a hall is a wall in a plan; in a map that is not complete it parts nothing.
#[test]
fn unexplored_space_parts_nothing() {
    let pinched = |what| {
        floor(
            [13.0, 6.0],
            &[[0.5, 0.5, 12.5, 5.5]],
            &[([6.0, 0.5, 6.6, 2.4], what), ([6.0, 3.3, 6.6, 5.5], what)],
        )
    };
    let count = |what, unknown| {
        let options = RegionOptions { unknown, ..RegionOptions::default() };
        let map = RegionMap::new(&pinched(what), &options).unwrap();
        (map.regions.len(), map.passages.iter().filter(|passage| passage.is_door()).count())
    };
    assert_eq!(count(Occupancy::Occupied, UnknownSpace::Unexplored), (2, 1));
    assert_eq!(count(Occupancy::Unknown, UnknownSpace::Wall), (2, 1));
    assert_eq!(count(Occupancy::Unknown, UnknownSpace::Unexplored), (1, 0));
}

/// A room of 4 m square of which the walls on some sides were never seen.
#[test]
fn the_part_of_the_rim_that_was_seen_is_told() {
    let sides = [[0.0, 0.0, 5.0, 0.5], [4.5, 0.0, 5.0, 5.0], [0.0, 4.5, 5.0, 5.0], [0.0, 0.0, 0.5, 5.0]];
    for unseen in 0..=3_u32 {
        let unknown: Vec<([f64; 4], Occupancy)> =
            sides[..unseen as usize].iter().map(|&side| (side, Occupancy::Unknown)).collect();
        let grid = floor([5.0, 5.0], &[[0.5, 0.5, 4.5, 4.5]], &unknown);
        let unexplored = RegionOptions { unknown: UnknownSpace::Unexplored, ..RegionOptions::default() };
        let [region] = &RegionMap::new(&grid, &unexplored).unwrap().regions[..] else { panic!("one room") };
        assert!(
            (region.explored - 1.0 + f64::from(unseen) / 4.0).abs() < 0.02,
            "{unseen}: {}",
            region.explored
        );
        let known = if unseen < 2 { RegionKind::Room } else { RegionKind::Unexplored };
        assert_eq!(region.kind, known, "{unseen}");
        assert_eq!(regions(&grid).regions[0].explored, 1.0);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    /// Where every constriction joins, pieces are the connected parts of free space; in any case they are connected.
    #[test]
    fn pieces_are_connected(width in 3_u32..24, height in 3_u32..24, density in 1_u32..9, as_wide in 0.0_f64..1.0,
                            noise in prop::collection::vec(0_u32..100, 24 * 24)) {
        let lattice = Lattice::new(width, height, 0.1, [0.0, 0.0]).unwrap();
        let is_obstacle = |index: usize| index == 0 || noise[index] < density * density;
        let field = DistanceField::new(lattice, is_obstacle);
        let free: BTreeSet<usize> = (0..lattice.len()).filter(|&index| !is_obstacle(index)).collect();
        for (as_wide, is_whole) in [(0.0, true), (as_wide, false)] {
            let pieces = flood(&field, Joining { as_wide, least: 0.0 });
            let mut members: BTreeMap<u32, BTreeSet<usize>> = BTreeMap::new();
            for (index, &label) in pieces.labels.iter().enumerate() {
                prop_assert_eq!(label != NO_PIECE, free.contains(&index));
                if label != NO_PIECE {
                    members.entry(label).or_default().insert(index);
                }
            }
            prop_assert_eq!(members.len(), pieces.widest.len());
            let parts: usize = members.values().map(|piece| parts(&lattice, piece)).sum();
            prop_assert_eq!(parts, members.len());
            if is_whole {
                prop_assert_eq!(members.len(), self::parts(&lattice, &free));
            }
        }
    }

    /// Against the closure of what is no farther apart.
    #[test]
    fn things_are_as_large_as_all_that_hangs_together(
        width in 8_u32..40, height in 8_u32..40, apart in 1_u32..4, wall in 4_u32..20, density in 1_u32..20,
        noise in prop::collection::vec(0_u32..100, 40 * 40), asked in prop::collection::vec(0_usize..1600, 1..20),
    ) {
        let lattice = Lattice::new(width, height, 0.1, [0.0, 0.0]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
        for cell in lattice.cells().filter(|cell| noise[lattice.index(*cell)] < density) {
            grid.set(cell, Occupancy::Occupied);
        }
        let options = RegionOptions {
            furniture: 0.0,
            apart: 0.1 * f64::from(apart),
            island: 0.1 * f64::from(wall) - 0.05,
            ..RegionOptions::default()
        };
        let ground = Ground::new(&grid, &options);
        let obstacles: Vec<Cell> = lattice.cells().filter(|&cell| ground.is_obstacle(lattice.index(cell))).collect();
        prop_assume!(!obstacles.is_empty());
        let mut islands = Islands::new(&ground, &options);
        for at in asked {
            let cell = obstacles[at % obstacles.len()];
            let point = lattice.center(cell);
            let found = islands.smaller([point, point]);
            let expected = thing(&obstacles, cell, apart, [width, height]).map_or(1.0, |cells| {
                (0.1 * f64::from(cells) / options.island).min(1.0)
            });
            prop_assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }

    /// Against weighing every border anew at every step.
    #[test]
    fn pieces_join_as_if_all_were_weighed_anew(
        pieces in 2_u32..9,
        sizes in prop::collection::vec((0.5_f64..30.0, 0.2_f64..1.5), 9),
        drawn in prop::collection::vec((0_u32..9, 0_u32..9, 0.3_f64..4.0, 0.0_f64..5.0), 1..20),
    ) {
        let options = CutOptions::default();
        let extents: Vec<Extent> =
            sizes[..pieces as usize].iter().map(|&(area, mean)| Extent { area, volume: area * mean }).collect();
        let mut borders: BTreeMap<Pair, Border> = BTreeMap::new();
        for &(a, b, width, wall) in &drawn {
            let (a, b) = (a % pieces, b % pieces);
            if a != b {
                let border = borders.entry((a.min(b), a.max(b))).or_default();
                border.gaps.push(Gap { cell: 0, width, is_between_walls: true, between: (width / 4.0).min(1.0) });
                border.wall += wall;
            }
        }
        let found = merged(extents.clone(), borders.clone(), &options);
        prop_assert_eq!(found.region_of, naive(extents, borders, &options));
    }
}

/// How many cells long or wide all is that hangs together with a cell; nothing if it leads beyond the map.
fn thing(obstacles: &[Cell], start: Cell, apart: u32, [width, height]: [u32; 2]) -> Option<u32> {
    let mut thing = vec![start];
    let mut at = 0;
    while at < thing.len() {
        for &near in obstacles {
            let is_near =
                thing[at].column.abs_diff(near.column) <= apart && thing[at].row.abs_diff(near.row) <= apart;
            if is_near && !thing.contains(&near) {
                thing.push(near);
            }
        }
        at += 1;
    }
    let extent = |of: fn(&Cell) -> u32, all: u32| {
        let (low, high) = (thing.iter().map(of).min()?, thing.iter().map(of).max()?);
        (low >= apart && high + apart < all).then_some(high - low + 1)
    };
    Some(extent(|cell| cell.column, width)?.max(extent(|cell| cell.row, height)?))
}

/// How many connected parts a set of cells has.
fn parts(lattice: &Lattice, cells: &BTreeSet<usize>) -> usize {
    let mut rest = cells.clone();
    let mut count = 0;
    while let Some(start) = rest.pop_first() {
        count += 1;
        let mut waiting = vec![start];
        while let Some(index) = waiting.pop() {
            let near: Vec<usize> = rest
                .iter()
                .copied()
                .filter(|&other| {
                    let [a, b] = [index, other].map(|index| lattice.cell(index));
                    a.column.abs_diff(b.column) <= 1 && a.row.abs_diff(b.row) <= 1
                })
                .collect();
            near.iter().for_each(|other| assert!(rest.remove(other)));
            waiting.extend(near);
        }
    }
    count
}

/// Joins the pieces on both sides of the border with the least odds as long as these are not positive.
fn naive(mut extents: Vec<Extent>, mut borders: BTreeMap<Pair, Border>, options: &CutOptions) -> Vec<u32> {
    let mut region_of: Vec<u32> = (0..extents.len() as u32).collect();
    loop {
        let odds = |(&(a, b), border): (&Pair, &Border)| {
            (cut_odds(border, [extents[a as usize], extents[b as usize]], options), (a, b))
        };
        let least = borders.iter().map(odds).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, (kept, gone))) = least.filter(|&(odds, _)| odds <= 0.0) else { return region_of };
        let Extent { area, volume } = extents[gone as usize];
        extents[kept as usize].area += area;
        extents[kept as usize].volume += volume;
        region_of.iter_mut().filter(|region| **region == gone).for_each(|region| *region = kept);
        for ((a, b), border) in std::mem::take(&mut borders) {
            let [a, b] = [a, b].map(|end| if end == gone { kept } else { end });
            if a != b {
                borders.entry((a.min(b), a.max(b))).or_default().extend(border);
            }
        }
    }
}
