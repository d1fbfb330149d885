//! Laws of the medial axis: it is thin, and connected as free space is.

use proptest::prelude::*;

use super::mask::Mask;
use super::medial_axis::medial_axis;
use super::{FreeSpace, Skeleton, SkeletonOptions, Tip};
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};

/// No clutter and no closed passage: free space is exactly the free cells.
fn exact() -> SkeletonOptions {
    SkeletonOptions { clutter: 0.0, narrowest_passage: 0.0, ..SkeletonOptions::default() }
}

/// A grid from a drawing, the top row first: `#` occupied, `?` unknown, anything else free.
fn drawn(rows: &[&str], resolution: f64) -> OccupancyGrid {
    let lattice = Lattice::new(rows[0].len() as u32, rows.len() as u32, resolution, [0.0, 0.0]).unwrap();
    let cells = lattice.cells().map(|cell| {
        match rows[rows.len() - 1 - cell.row as usize].as_bytes()[cell.column as usize] {
            b'#' => Occupancy::Occupied,
            b'?' => Occupancy::Unknown,
            _ => Occupancy::Free,
        }
    });
    OccupancyGrid::new(lattice, cells.collect()).unwrap()
}

/// The number of connected groups of cells that are in the set, or not in it, with steps to neighbors
/// by sides only or also by corners; outside the lattice nothing is in the set.
fn groups(lattice: &Lattice, is_in: impl Fn(Cell) -> bool, of_members: bool, by_corners: bool) -> usize {
    let side = |length: u32| i64::from(length) + 2;
    let (width, height) = (side(lattice.width()), side(lattice.height()));
    let wanted = |x: i64, y: i64| {
        let inside = (1..width - 1).contains(&x) && (1..height - 1).contains(&y);
        (inside && is_in(Cell { column: (x - 1) as u32, row: (y - 1) as u32 })) == of_members
    };
    let mut seen = vec![vec![false; height as usize]; width as usize];
    let mut count = 0;
    for start in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        let mut stack = vec![start];
        if seen[start.0 as usize][start.1 as usize] || !wanted(start.0, start.1) {
            continue;
        }
        count += 1;
        while let Some((x, y)) = stack.pop() {
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            if !inside || seen[x as usize][y as usize] || !wanted(x, y) {
                continue;
            }
            seen[x as usize][y as usize] = true;
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                if by_corners || (dx == 0) != (dy == 0) {
                    stack.push((x + dx, y + dy));
                }
            }
        }
    }
    count
}

/// The number of components, and of components of the complement, of which all but one are holes.
fn topology(lattice: &Lattice, is_in: impl Fn(Cell) -> bool + Copy) -> (usize, usize) {
    (groups(lattice, is_in, true, true), groups(lattice, is_in, false, false))
}

fn contains(mask: &Mask, cell: Cell) -> bool {
    mask.contains(mask.position(cell))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    /// Thinning keeps components and holes, and leaves no two by two block but at junctions: nothing can
    /// be taken away except the ends of lines.
    #[test]
    fn the_axis_is_thin_and_connected_as_free_space_is(
        width in 3_u32..30, height in 3_u32..30, blocks in prop::collection::vec((0_u32..30, 0_u32..30, 1_u32..7, 1_u32..7), 1..14),
    ) {
        let lattice = Lattice::new(width, height, 0.1, [0.0, 0.0]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
        for (left, low, wide, high) in blocks {
            for (column, row) in (left..left + wide).flat_map(|x| (low..low + high).map(move |y| (x, y))) {
                if column < width && row < height {
                    grid.set(Cell { column, row }, Occupancy::Occupied);
                }
            }
        }
        prop_assume!(grid.count(Occupancy::Occupied) > 0 && grid.count(Occupancy::Free) > 0);
        let free = FreeSpace::new(&grid, &exact());
        let axis = medial_axis(&free, &exact());
        let is_free = |cell| grid.get(cell) == Occupancy::Free;
        prop_assert_eq!(topology(&lattice, is_free), topology(&lattice, |cell| contains(&axis, cell)));
        for position in axis.members() {
            prop_assert!(!axis.is_simple(position) || axis.is_end(position));
        }
    }
}

/// Whether a cell is simple, against counting components of its neighborhood.
#[test]
fn simple_cells_are_those_that_separate_nothing() {
    let lattice = Lattice::new(3, 3, 1.0, [0.0, 0.0]).unwrap();
    let middle = Cell { column: 1, row: 1 };
    for pattern in 0..512_usize {
        if pattern >> lattice.index(middle) & 1 == 0 {
            continue;
        }
        let mask = Mask::new(&lattice, |index| pattern >> index & 1 == 1);
        let with = |cell: Cell| pattern >> lattice.index(cell) & 1 == 1;
        let without = |cell: Cell| cell != middle && with(cell);
        let stays = topology(&lattice, with) == topology(&lattice, without);
        assert_eq!(mask.is_simple(mask.position(middle)), stays, "{pattern:b}");
    }
}

#[test]
fn a_corridor_has_one_line_and_its_tips_say_what_is_there() {
    let wall = "#".repeat(60);
    let open = format!("#{}", ".".repeat(59));
    let unseen = format!("#{}{}", ".".repeat(49), "?".repeat(10));
    for (middle, tips) in [(&open, [Tip::Wall, Tip::Border]), (&unseen, [Tip::Wall, Tip::Frontier])] {
        let mut rows = vec![wall.as_str()];
        rows.extend([middle.as_str(); 9]);
        rows.push(wall.as_str());
        let grid = drawn(&rows, 0.2);
        let options = SkeletonOptions::default();
        let skeleton = Skeleton::new(&grid, &FreeSpace::new(&grid, &options), &options);
        assert_eq!(skeleton.edges.len(), 1);
        let mut found: Vec<Tip> = skeleton.nodes.iter().filter_map(|node| node.tip).collect();
        found.sort();
        assert_eq!(found, tips);
        let middle = 5.5 * 0.2;
        let inner = skeleton.edges[0].points.iter().filter(|point| (2.0..8.0).contains(&point.point[0]));
        assert!(inner.clone().count() > 25);
        for point in inner {
            assert!((point.point[1] - middle).abs() < 1e-9, "{point:?}");
        }
    }
}

#[test]
fn a_ring_is_one_loop_and_clutter_does_not_matter() {
    let outer = "#".repeat(31);
    let free = format!("#{}#", ".".repeat(29));
    let block = format!("#{}{}{}#", ".".repeat(9), "#".repeat(11), ".".repeat(9));
    let speck = format!("#...#{}#", ".".repeat(25));
    let mut rows = vec![outer.as_str()];
    rows.extend([free.as_str(); 4]);
    rows.push(&speck);
    rows.extend([free.as_str(); 4]);
    rows.extend([block.as_str(); 11]);
    rows.extend([free.as_str(); 9]);
    rows.push(&outer);
    let grid = drawn(&rows, 0.2);
    let options = SkeletonOptions::default();
    let skeleton = Skeleton::new(&grid, &FreeSpace::new(&grid, &options), &options);
    assert_eq!((skeleton.nodes.len(), skeleton.edges.len()), (1, 1));
    assert_eq!(skeleton.edges[0].nodes[0], skeleton.edges[0].nodes[1]);
}

/// Free boxes (low corner, high corner, in metres) in solid rock, with solid boxes in them again.
fn dug(free: &[[[f64; 2]; 2]], solid: &[[[f64; 2]; 2]]) -> OccupancyGrid {
    let lattice = Lattice::new(150, 60, 0.2, [0.0, 0.0]).unwrap();
    let cells = lattice.cells().map(|cell| {
        let [x, y] = lattice.center(cell);
        let is_in = |boxes: &[[[f64; 2]; 2]]| {
            boxes.iter().any(|[low, high]| low[0] < x && x < high[0] && low[1] < y && y < high[1])
        };
        if is_in(free) && !is_in(solid) { Occupancy::Free } else { Occupancy::Occupied }
    });
    OccupancyGrid::new(lattice, cells.collect()).unwrap()
}

/// A corridor through the whole grid, and above it a lobby around a table: a branch that leads some 9 m on, into a
/// loop and back.
#[test]
fn a_lobby_around_a_table_is_a_branch_and_as_deep_as_its_far_side() {
    let corridor = [[0.0, 1.0], [30.0, 3.0]];
    let (door, lobby) = ([[14.0, 2.0], [16.0, 5.0]], [[12.0, 4.4], [18.0, 10.4]]);
    let grid = dug(&[corridor, door, lobby], &[[[14.0, 6.4], [16.0, 8.4]]]);
    let edges = |shallowest_branch| {
        let options = SkeletonOptions { shallowest_branch, ..SkeletonOptions::default() };
        Skeleton::new(&grid, &FreeSpace::new(&grid, &options), &options).edges.len()
    };
    assert_eq!((edges(1.0), edges(8.0)), (4, 4));
    // Some 3 m in, and 15 m around the table, less 1 m of room at the junction: 9.3 m.
    assert_eq!(edges(10.0), 1, "only the corridor is left");
}

#[test]
fn a_piece_of_free_space_that_is_too_small_has_no_axis() {
    let grid = dug(&[[[0.0, 1.0], [30.0, 3.0]], [[4.0, 6.0], [10.0, 8.0]]], &[]);
    let pieces = |shallowest_branch| {
        let options = SkeletonOptions { shallowest_branch, ..SkeletonOptions::default() };
        Skeleton::new(&grid, &FreeSpace::new(&grid, &options), &options).edges.len()
    };
    assert_eq!((pieces(1.0), pieces(8.0)), (2, 1));
}
