//! How well a wall fits where: near the walls that were seen well, where free space was seen badly, and where
//! nothing was seen neither. With its maxima over ever larger blocks, for a search that skips what cannot win.

use nalgebra::Vector2;

use crate::distance::DistanceField;
use crate::grid::{Cell, Occupancy, OccupancyGrid};

/// How far a wall may be off and still fit, in metres, standard deviation.
const BLUR: f64 = 0.12;
/// A wall is where another is if it is not farther off, in metres.
const NEAR: f64 = 0.2;
/// How much a wall in what was seen free speaks against a pose; one on a wall counts 1.
const CONTRADICTION: f64 = -0.6;
/// A hundredth is the unit of the numbers kept.
const UNIT: f64 = 100.0;

/// The blocks of one size, side by side.
struct Level {
    width: i32,
    height: i32,
    values: Vec<i8>,
}

/// How well a wall fits at each cell, and the best of it in blocks of 2, 4, 8… cells.
pub(super) struct Field {
    origin: Vector2<f64>,
    cell: f64,
    levels: Vec<Level>,
}

impl Level {
    fn at(&self, column: i32, row: i32) -> i8 {
        let is_inside = column >= 0 && row >= 0 && column < self.width && row < self.height;
        if is_inside { self.values[(row * self.width + column) as usize] } else { 0 }
    }
}

impl Field {
    /// How many sizes of blocks there are: the largest are so many doublings of a cell.
    pub(super) const TOP: usize = 4;

    pub(super) fn new(grid: &OccupancyGrid) -> Self {
        let lattice = *grid.lattice();
        let to_wall = DistanceField::new(lattice, |index| grid.cells()[index] == Occupancy::Occupied);
        let value = |cell: Cell| {
            let squared = to_wall.squared_cells(cell).map_or(f64::INFINITY, f64::from);
            let off = squared.sqrt() * lattice.resolution();
            let fit = (-0.5 * (off / BLUR).powi(2)).exp();
            let is_contradicted = grid.get(cell) == Occupancy::Free && off > NEAR;
            let value =
                if is_contradicted { (CONTRADICTION * ((off - NEAR) / NEAR).min(1.0)).min(fit) } else { fit };
            (value * UNIT).round() as i8
        };
        let base = Level {
            width: lattice.width() as i32,
            height: lattice.height() as i32,
            values: lattice.cells().map(value).collect(),
        };
        let mut levels = vec![base];
        // Above level 0 a value is the best of the four blocks from the block's corner on, so that it bounds
        // every shift by less than a block: of a point in it.
        for level in 1..=Self::TOP {
            let below = &levels[0];
            let size = 1 << level;
            let (width, height) = (below.width / size + 1, below.height / size + 1);
            let mut blocks = Level { width, height, values: vec![0; (width * height) as usize] };
            let mut single = vec![i8::MIN; (width * height) as usize];
            for row in 0..below.height {
                for column in 0..below.width {
                    let block = ((row / size) * width + column / size) as usize;
                    single[block] = single[block].max(below.values[(row * below.width + column) as usize]);
                }
            }
            let at =
                |column: i32, row: i32| {
                    let is_inside = column < width && row < height;
                    if is_inside {
                        single[(row * width + column) as usize]
                            .max(if column + 1 == width || row + 1 == height { 0 } else { i8::MIN })
                    } else {
                        0
                    }
                };
            for row in 0..height {
                for column in 0..width {
                    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(c, r)| at(column + c, row + r));
                    blocks.values[(row * width + column) as usize] = corners.into_iter().max().unwrap_or(0);
                }
            }
            levels.push(blocks);
        }
        let [x, y] = lattice.origin();
        Field { origin: Vector2::new(x, y), cell: lattice.resolution(), levels }
    }

    /// The cell that a point is in.
    pub(super) fn cell(&self, point: Vector2<f64>) -> (i32, i32) {
        let at = (point - self.origin) / self.cell;
        (at.x.floor() as i32, at.y.floor() as i32)
    }

    /// The mean fit of walls in some cells that are shifted; at a level above 0 the most that it can be for
    /// shifts up to a block more in either direction.
    pub(super) fn score(&self, cells: &[(i32, i32)], shift: (i32, i32), level: usize) -> f64 {
        let blocks = &self.levels[level];
        let sum: i32 = cells
            .iter()
            .map(|&(column, row)| i32::from(blocks.at((column + shift.0) >> level, (row + shift.1) >> level)))
            .sum();
        f64::from(sum) / (UNIT * cells.len().max(1) as f64)
    }

    /// What walls at points meet: how many lie where this submap has seen something, and how many of these at
    /// a wall.
    pub(super) fn meets(&self, points: impl Iterator<Item = Vector2<f64>>) -> (usize, usize) {
        let (mut seen, mut near) = (0, 0);
        for point in points {
            let (column, row) = self.cell(point);
            let value = self.levels[0].at(column, row);
            let is_near = f64::from(value) >= UNIT * (-0.5 * (NEAR / BLUR).powi(2)).exp() - 1.0 && value > 0;
            seen += usize::from(is_near || value < 0);
            near += usize::from(is_near);
        }
        (seen, near)
    }
}
