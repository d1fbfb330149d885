//! Where one submap lies best on another: every pose of a window, without trying all (branch and bound; after
//! Olson 2009 and Hess, Kohler, Rapp, Andor 2016).

use hssh_metrics::Pose;
use nalgebra::Vector2;

use super::field::Field;
use super::submap::CELL;

/// Radians between the headings that are tried.
const TURN: f64 = 0.02;

/// The poses that are tried: around a pose, so many metres and radians to each side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) center: Pose,
    pub(super) across: f64,
    pub(super) around: f64,
}

/// A pose of a submap in the frame of another one, and how well it fits: at most 1.
#[derive(Clone, Copy)]
pub(super) struct Fit {
    pub(super) pose: Pose,
    pub(super) score: f64,
}

/// A block of poses with one heading: shifts from `shift` on, a block of the level wide.
struct Block {
    heading: usize,
    shift: (i32, i32),
    level: usize,
    bound: f64,
}

/// The poses of a window, and what walls meet from each heading.
struct Search<'a> {
    field: &'a Field,
    window: &'a Window,
    headings: Vec<f64>,
    /// By heading, the cells of the walls from the window's center.
    cells: Vec<Vec<(i32, i32)>>,
    /// Cells to each side.
    across: i32,
    /// Where poses do not count, and how many metres around.
    but: Option<(Pose, f64)>,
}

/// The best pose in the window with a score above `threshold`; poses within `apart` metres of `but` do not count.
pub(super) fn search(
    field: &Field,
    walls: &[Vector2<f64>],
    window: &Window,
    threshold: f64,
    but: Option<(Pose, f64)>,
) -> Option<Fit> {
    let search = Search::new(field, walls, window, but);
    let mut blocks = search.blocks();
    let mut best: Option<Fit> = None;
    let mut least = threshold;
    while let Some(block) = blocks.pop() {
        if block.bound <= least || search.is_excluded(&block) {
            continue;
        }
        if block.level == 0 {
            least = block.bound;
            best = Some(Fit { pose: search.pose(&block), score: block.bound });
            continue;
        }
        let parts = search.parts(&block).into_iter().filter(|part| part.bound > least);
        let first = blocks.len();
        blocks.extend(parts);
        blocks[first..].sort_by(|a, b| a.bound.total_cmp(&b.bound));
    }
    best
}

impl<'a> Search<'a> {
    fn new(field: &'a Field, walls: &[Vector2<f64>], window: &'a Window, but: Option<(Pose, f64)>) -> Self {
        let steps = (window.around / TURN).ceil() as i32;
        let headings: Vec<f64> =
            (-steps..=steps).map(|step| window.center.theta + f64::from(step) * TURN).collect();
        let seen_with = |&theta: &f64| {
            let at = Pose { theta, ..window.center };
            let rotation = at.rotation();
            walls.iter().map(|wall| field.cell(at.translation() + rotation * wall)).collect()
        };
        let cells = headings.iter().map(seen_with).collect();
        Search { field, window, headings, cells, across: (window.across / CELL).ceil() as i32, but }
    }

    /// Blocks that cover the window, the best last.
    fn blocks(&self) -> Vec<Block> {
        let across = self.across;
        let top = (0..=Field::TOP).rev().find(|&level| (1 << level) <= across.max(1)).unwrap_or(0);
        let corners = || (-across..=across).step_by(1 << top);
        let shifts: Vec<(i32, i32)> =
            corners().flat_map(|row| corners().map(move |column| (column, row))).collect();
        let of_heading = |heading: usize| shifts.iter().map(move |&shift| self.block(heading, shift, top));
        let mut blocks: Vec<Block> = (0..self.headings.len()).flat_map(of_heading).collect();
        blocks.sort_by(|a, b| a.bound.total_cmp(&b.bound));
        blocks
    }

    fn block(&self, heading: usize, shift: (i32, i32), level: usize) -> Block {
        Block { heading, shift, level, bound: self.field.score(&self.cells[heading], shift, level) }
    }

    /// The quarters of a block, without those that lie beyond the window.
    fn parts(&self, block: &Block) -> Vec<Block> {
        let level = block.level - 1;
        let half = 1 << level;
        let corners = [(0, 0), (half, 0), (0, half), (half, half)]
            .map(|(column, row)| (block.shift.0 + column, block.shift.1 + row));
        let inside = corners.into_iter().filter(|&(column, row)| column.max(row) <= self.across);
        inside.map(|shift| self.block(block.heading, shift, level)).collect()
    }

    /// The first pose of a block.
    fn pose(&self, block: &Block) -> Pose {
        let (x, y) = (f64::from(block.shift.0) * CELL, f64::from(block.shift.1) * CELL);
        Pose::new(self.window.center.x + x, self.window.center.y + y, self.headings[block.heading])
    }

    /// Whether none of a block's poses counts.
    fn is_excluded(&self, block: &Block) -> bool {
        self.but.is_some_and(|(but, apart)| {
            let size = f64::from((1 << block.level) - 1) * CELL;
            let middle = self.pose(block).translation() + Vector2::new(size, size) / 2.0;
            (middle - but.translation()).norm() + size * 0.7072 < apart
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{Lattice, Occupancy, OccupancyGrid};
    use proptest::prelude::*;

    /// A grid with a corner at `low`, row by row: 0 is a wall, 1 unknown, the rest free.
    fn grid(width: u32, height: u32, low: [f64; 2], kinds: &[u8]) -> OccupancyGrid {
        let lattice = Lattice::new(width, height, CELL, low).unwrap();
        let cells = kinds[..lattice.len()].iter().map(|kind| match kind {
            0 => Occupancy::Occupied,
            1 => Occupancy::Unknown,
            _ => Occupancy::Free,
        });
        OccupancyGrid::new(lattice, cells.collect()).unwrap()
    }

    /// How well a wall fits at a point, from the definition.
    fn likeness(grid: &OccupancyGrid, at: [f64; 2]) -> f64 {
        let lattice = grid.lattice();
        let [column, row] = [0, 1].map(|axis| ((at[axis] - lattice.origin()[axis]) / CELL).floor());
        if column < 0.0 || row < 0.0 || column >= lattice.width().into() || row >= lattice.height().into() {
            return 0.0;
        }
        let walls = lattice.cells().filter(|&cell| grid.get(cell) == Occupancy::Occupied);
        let away =
            |cell: crate::grid::Cell| (f64::from(cell.column) - column).hypot(f64::from(cell.row) - row);
        let off = CELL * walls.map(away).fold(f64::INFINITY, f64::min);
        let fit = (-(off / 0.12) * (off / 0.12) / 2.0).exp();
        let here = crate::grid::Cell { column: column as u32, row: row as u32 };
        let is_contradicted = grid.get(here) == Occupancy::Free && off > 0.2;
        let value = if is_contradicted { fit.min(-0.6 * ((off - 0.2) / 0.2).min(1.0)) } else { fit };
        (100.0 * value).round() / 100.0
    }

    /// The mean of that over walls that are seen from a pose.
    fn mean_likeness(grid: &OccupancyGrid, walls: &[Vector2<f64>], pose: [f64; 3]) -> f64 {
        let (sin, cos) = pose[2].sin_cos();
        let at = |wall: &Vector2<f64>| {
            [pose[0] + cos * wall.x - sin * wall.y, pose[1] + sin * wall.x + cos * wall.y]
        };
        walls.iter().map(|wall| likeness(grid, at(wall))).sum::<f64>() / walls.len() as f64
    }

    /// All poses of a window outside a disc.
    fn poses(window: &Window, but: Option<([f64; 2], f64)>) -> Vec<[f64; 3]> {
        let (across, around) = ((window.across / CELL).ceil() as i32, (window.around / TURN).ceil() as i32);
        let mut poses = Vec::new();
        for turn in -around..=around {
            for (column, row) in (-across..=across).flat_map(|c| (-across..=across).map(move |r| (c, r))) {
                let (x, y) =
                    (window.center.x + f64::from(column) * CELL, window.center.y + f64::from(row) * CELL);
                if but.is_none_or(|(middle, apart)| (x - middle[0]).hypot(y - middle[1]) >= apart) {
                    poses.push([x, y, window.center.theta + f64::from(turn) * TURN]);
                }
            }
        }
        poses
    }

    fn walls() -> impl Strategy<Value = Vec<Vector2<f64>>> {
        let wall = (-1.5_f64..1.5, -1.5_f64..1.5).prop_map(|(x, y)| Vector2::new(x, y));
        prop::collection::vec(wall, 1..6)
    }

    fn window() -> impl Strategy<Value = Window> {
        (-1.0_f64..1.0, -1.0_f64..1.0, -3.0_f64..3.0, 0.05_f64..1.9, 0.0_f64..0.05).prop_map(
            |(x, y, theta, across, around)| Window { center: Pose::new(x, y, theta), across, around },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        /// Against all poses one by one: the best score, and nothing only if nothing is above the threshold.
        #[test]
        fn finds_what_trying_everything_finds(
            width in 1_u32..22, height in 1_u32..22, low in (-2.0_f64..0.0, -2.0_f64..0.0),
            kinds in prop::collection::vec(0_u8..9, 22 * 22),
            walls in walls(), window in window(), threshold in -0.3_f64..0.9,
            but in prop::option::of((-1.0_f64..1.0, -1.0_f64..1.0, 0.05_f64..1.0)),
        ) {
            let grid = grid(width, height, [low.0, low.1], &kinds);
            let middle = but.map(|(x, y, apart)| ([window.center.x + x, window.center.y + y], apart));
            let expected = poses(&window, middle)
                .into_iter()
                .map(|pose| mean_likeness(&grid, &walls, pose))
                .fold(f64::NEG_INFINITY, f64::max);
            let excluded = middle.map(|([x, y], apart)| (Pose::new(x, y, 0.0), apart));
            let found = search(&Field::new(&grid), &walls, &window, threshold, excluded);
            prop_assert_eq!(found.is_some(), expected > threshold, "{:?} is the best", expected);
            if let Some(Fit { pose, score }) = found {
                prop_assert!((score - expected).abs() < 1e-9, "{} instead of {}", score, expected);
                prop_assert!((mean_likeness(&grid, &walls, [pose.x, pose.y, pose.theta]) - score).abs() < 1e-9);
                let off = pose.translation() - window.center.translation();
                prop_assert!(off.amax() < window.across + CELL);
                if let Some(([x, y], apart)) = middle {
                    prop_assert!((pose.x - x).hypot(pose.y - y) >= apart);
                }
            }
        }
    }
}
