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
/// At so many standard deviations the fit is none, to a unit.
const FAR: f64 = 5.0;
/// A hundredth is the unit of the numbers kept.
const UNIT: f64 = 100.0;

/// The blocks of one size, side by side; outside of them all is 0.
struct Level {
    /// The column and the row of the first block.
    first: i32,
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
        let (column, row) = (column - self.first, row - self.first);
        let is_inside = column >= 0 && row >= 0 && column < self.width && row < self.height;
        if is_inside { self.values[(row * self.width + column) as usize] } else { 0 }
    }

    /// The best of each block of `size` × `size` values.
    fn blocks(&self, size: i32) -> Self {
        let (width, height) = ((self.width + size - 1) / size, (self.height + size - 1) / size);
        let is_cut =
            |block: i32| (block % width + 1) * size > self.width || (block / width + 1) * size > self.height;
        let mut values: Vec<i8> =
            (0..width * height).map(|block| if is_cut(block) { 0 } else { i8::MIN }).collect();
        for (row, cells) in (0..).zip(self.values.chunks_exact(self.width as usize)) {
            let blocks = &mut values[(row / size * width) as usize..][..width as usize];
            for (block, cells) in blocks.iter_mut().zip(cells.chunks(size as usize)) {
                *block = cells.iter().fold(*block, |best, &value| best.max(value));
            }
        }
        Level { first: 0, width, height, values }
    }

    /// The best of four blocks from each on, also from those just before the first.
    fn of_four(&self) -> Self {
        let (width, height) = (self.width + 1, self.height + 1);
        let best = |block: i32| {
            let (column, row) = (block % width - 1, block / width - 1);
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(c, r)| self.at(column + c, row + r));
            four.into_iter().fold(i8::MIN, i8::max)
        };
        Level { first: -1, width, height, values: (0..width * height).map(best).collect() }
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
            let fit = if off < FAR * BLUR { (-0.5 * (off / BLUR).powi(2)).exp() } else { 0.0 };
            let is_contradicted = grid.get(cell) == Occupancy::Free && off > NEAR;
            let value =
                if is_contradicted { (CONTRADICTION * ((off - NEAR) / NEAR).min(1.0)).min(fit) } else { fit };
            (value * UNIT).round() as i8
        };
        let base = Level {
            first: 0,
            width: lattice.width() as i32,
            height: lattice.height() as i32,
            values: lattice.cells().map(value).collect(),
        };
        // Above level 0 a value is the best of the four blocks from the block's corner on, so that it bounds
        // every shift by less than a block: of a point in it.
        let above: Vec<Level> = (1..=Self::TOP).map(|level| base.blocks(1 << level).of_four()).collect();
        let levels = std::iter::once(base).chain(above).collect();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Lattice;
    use proptest::prelude::*;

    /// A wall, free space on its right, and nothing seen on its left.
    fn wall_in_the_middle() -> Field {
        let lattice = Lattice::new(21, 5, 0.1, [-1.05, -0.25]).unwrap();
        let cells = lattice.cells().map(|cell| match cell.column {
            0..10 => Occupancy::Unknown,
            10 => Occupancy::Occupied,
            _ => Occupancy::Free,
        });
        Field::new(&OccupancyGrid::new(lattice, cells.collect()).unwrap())
    }

    #[test]
    fn walls_speak_for_walls_free_space_against_them_and_the_unseen_is_silent() {
        let field = wall_in_the_middle();
        let score = |x: f64| field.score(&[field.cell(Vector2::new(x, 0.0))], (0, 0), 0);
        assert_eq!(score(0.0), 1.0);
        assert!(score(0.1) > 0.6 && score(-0.1) > 0.6, "{} {}", score(0.1), score(-0.1));
        assert_eq!((score(0.6), score(-0.6)), (-0.6, 0.0));
        assert_eq!((score(7.0), score(-7.0)), (0.0, 0.0), "outside nothing was seen");
        let points = [0.0, 0.1, 0.6, 0.9, -0.6, -0.9, 7.0].map(|x| Vector2::new(x, 0.0));
        assert_eq!(field.meets(points.into_iter()), (4, 2));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]
        /// What a level tells of a shift bounds every shift by less than a block, also from outside of the grid.
        #[test]
        fn levels_are_upper_bounds(
            width in 1_u32..40, height in 1_u32..40, kinds in prop::collection::vec(0_u8..30, 40 * 40),
            cells in prop::collection::vec((-20_i32..60, -20_i32..60), 1..4),
            shift in (-40_i32..40, -40_i32..40), level in 1_usize..=Field::TOP,
        ) {
            let lattice = Lattice::new(width, height, 0.1, [0.3, -0.7]).unwrap();
            let occupancies = kinds[..lattice.len()].iter().map(|kind| match kind {
                0 => Occupancy::Occupied,
                1..15 => Occupancy::Unknown,
                _ => Occupancy::Free,
            });
            let field = Field::new(&OccupancyGrid::new(lattice, occupancies.collect()).unwrap());
            let bound = field.score(&cells, shift, level);
            for (columns, rows) in (0..1 << level).flat_map(|c| (0..1 << level).map(move |r| (c, r))) {
                let score = field.score(&cells, (shift.0 + columns, shift.1 + rows), 0);
                prop_assert!(score <= bound, "{} at {} {} is above {}", score, columns, rows, bound);
            }
        }
    }
}
