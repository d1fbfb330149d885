//! The lattice of a grid: where its cells are in the plane.

use super::CellLine;

/// A cell of a lattice. Row 0 is at the bottom: rows count upwards, along y.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Cell {
    /// From 0 at the left, along x.
    pub column: u32,
    /// From 0 at the bottom, along y.
    pub row: u32,
}

/// Square cells in rows and columns, with their place in the frame of the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lattice {
    width: u32,
    height: u32,
    resolution: f64,
    origin: [f64; 2],
}

/// Why numbers make no lattice.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum LatticeError {
    /// No cells at all.
    #[error("a grid of {width} × {height} cells is empty: both must be at least 1")]
    Empty {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// More cells than can be counted in memory.
    #[error(
        "a grid of {width} × {height} cells is too large: at most {} a side and {} altogether; crop it, or make the cells larger",
        Lattice::LONGEST_SIDE,
        Lattice::MOST_CELLS
    )]
    TooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Cells without a size, or of one that makes no sense.
    #[error(
        "the resolution must be a positive number of metres per cell, from {} to {}, not {:e}; a cell is some centimetres as a rule",
        Lattice::RESOLUTIONS.start(), Lattice::RESOLUTIONS.end(), .0
    )]
    Resolution(f64),
    /// No place in the plane.
    #[error("the origin must be two numbers of metres, between -{most:e} and {most:e}, not ({:e}, {:e})", .0[0], .0[1], most = Lattice::FARTHEST)]
    Origin([f64; 2]),
}

impl Lattice {
    /// The most cells of one lattice: 2²⁸, a square of 16,384 by 16,384.
    pub const MOST_CELLS: u64 = 1 << 28;
    /// The most columns and the most rows: 2¹⁵, so that a squared distance fits 32 bits.
    pub const LONGEST_SIDE: u32 = 1 << 15;
    /// How many metres the side of a cell may have.
    pub const RESOLUTIONS: std::ops::RangeInclusive<f64> = 1e-3..=100.0;
    /// How far the origin may be from that of the frame, in metres: more than the earth is around.
    pub const FARTHEST: f64 = 1e8;

    /// A lattice of `width` columns and `height` rows with cells of `resolution` metres; `origin` is
    /// the lower left corner of cell (0, 0), in metres.
    ///
    /// # Errors
    /// If there are no cells or too many, or a number is not as it says.
    pub fn new(width: u32, height: u32, resolution: f64, origin: [f64; 2]) -> Result<Self, LatticeError> {
        if width == 0 || height == 0 {
            return Err(LatticeError::Empty { width, height });
        }
        let cells = u64::from(width) * u64::from(height);
        if width.max(height) > Self::LONGEST_SIDE || cells > Self::MOST_CELLS {
            return Err(LatticeError::TooLarge { width, height });
        }
        if !Self::RESOLUTIONS.contains(&resolution) {
            return Err(LatticeError::Resolution(resolution));
        }
        if !origin.iter().all(|coordinate| coordinate.abs() <= Self::FARTHEST) {
            return Err(LatticeError::Origin(origin));
        }
        Ok(Lattice { width, height, resolution, origin })
    }

    /// The number of columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The side of a cell in metres.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The lower left corner of cell (0, 0) in metres.
    #[must_use]
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// The number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Never: a lattice has cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The position of a cell in row-major order from the bottom; the cell must be of this lattice.
    #[must_use]
    pub fn index(&self, cell: Cell) -> usize {
        debug_assert!(cell.column < self.width && cell.row < self.height, "{cell:?} is outside {self:?}");
        cell.row as usize * self.width as usize + cell.column as usize
    }

    /// The cell at a position in row-major order.
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        let width = self.width as usize;
        Cell { column: (index % width) as u32, row: (index / width) as u32 }
    }

    /// All cells in row-major order from the bottom.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let width = self.width;
        (0..self.height).flat_map(move |row| (0..width).map(move |column| Cell { column, row }))
    }

    /// The cell in which a point in metres lies, if it lies on the lattice. Lower and left borders
    /// belong to a cell.
    #[must_use]
    pub fn cell_at(&self, point: [f64; 2]) -> Option<Cell> {
        let [column, row] = self.continuous(point).map(f64::floor);
        let inside =
            (0.0..f64::from(self.width)).contains(&column) && (0.0..f64::from(self.height)).contains(&row);
        inside.then_some(Cell { column: column as u32, row: row as u32 })
    }

    /// The middle of a cell in metres.
    #[must_use]
    pub fn center(&self, cell: Cell) -> [f64; 2] {
        self.point([f64::from(cell.column) + 0.5, f64::from(cell.row) + 0.5])
    }

    /// A point in metres in units of cells from the lower left corner of the lattice: cell (c, r)
    /// covers c to c + 1 and r to r + 1.
    #[must_use]
    pub fn continuous(&self, point: [f64; 2]) -> [f64; 2] {
        [(point[0] - self.origin[0]) / self.resolution, (point[1] - self.origin[1]) / self.resolution]
    }

    /// The inverse of [`Lattice::continuous`].
    #[must_use]
    pub fn point(&self, continuous: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + continuous[0] * self.resolution, self.origin[1] + continuous[1] * self.resolution]
    }

    /// The cell `columns` to the right and `rows` up, if there is one.
    #[must_use]
    pub fn step(&self, cell: Cell, columns: i32, rows: i32) -> Option<Cell> {
        let column = cell.column.checked_add_signed(columns).filter(|&column| column < self.width)?;
        let row = cell.row.checked_add_signed(rows).filter(|&row| row < self.height)?;
        Some(Cell { column, row })
    }

    /// The cells that share a side with a cell: right, up, left, down, those that exist.
    pub fn side_neighbors(&self, cell: Cell) -> impl Iterator<Item = Cell> + use<> {
        let lattice = *self;
        [(1, 0), (0, 1), (-1, 0), (0, -1)]
            .into_iter()
            .filter_map(move |(columns, rows)| lattice.step(cell, columns, rows))
    }

    /// The part of the lattice within a square of `side` metres around a point, with the same cells, and the
    /// cell of this lattice that is the first one of the part; `None` if the square has none of its cells.
    pub(crate) fn window(&self, center: [f64; 2], side: f64) -> Option<(Lattice, Cell)> {
        let bounds = |low: f64, count: u32| {
            let first = low.round().clamp(0.0, f64::from(count)) as u32;
            let end = (low + side / self.resolution).round().clamp(0.0, f64::from(count)) as u32;
            (first, end.saturating_sub(first))
        };
        let [x, y] = self.continuous([center[0] - side / 2.0, center[1] - side / 2.0]);
        let ((column, width), (row, height)) = (bounds(x, self.width), bounds(y, self.height));
        let origin = self.point([f64::from(column), f64::from(row)]);
        let lattice = Lattice::new(width, height, self.resolution, origin).ok()?;
        Some((lattice, Cell { column, row }))
    }

    /// The part of the lattice from a first cell up to, and without, the column and row of an end beyond it.
    pub(crate) fn part(&self, first: Cell, end: [u32; 2]) -> Lattice {
        let origin = self.point([f64::from(first.column), f64::from(first.row)]);
        let (width, height) = (end[0] - first.column, end[1] - first.row);
        Lattice { width, height, origin, ..*self }
    }

    /// The cells of the straight line between two cells of the lattice, both included.
    #[must_use]
    pub fn line(&self, from: Cell, to: Cell) -> CellLine {
        CellLine::new(from, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn rows_count_upwards_from_the_origin() {
        let lattice = Lattice::new(4, 3, 0.5, [-1.0, 10.0]).unwrap();
        assert_eq!(lattice.cell_at([-1.0, 10.0]), Some(Cell { column: 0, row: 0 }));
        assert_eq!(lattice.cell_at([0.9, 11.4]), Some(Cell { column: 3, row: 2 }));
        assert_eq!(lattice.cell_at([1.0, 11.0]), None);
        assert_eq!(lattice.cell_at([f64::NAN, 11.0]), None);
        assert_eq!(lattice.center(Cell { column: 0, row: 2 }), [-0.75, 11.25]);
    }

    #[test]
    fn what_is_no_lattice_is_refused() {
        let refusal = |width, height, resolution, x| {
            Lattice::new(width, height, resolution, [x, 0.0]).unwrap_err().to_string()
        };
        assert_eq!(refusal(0, 5, 0.1, 0.0), "a grid of 0 × 5 cells is empty: both must be at least 1");
        assert!(refusal(u32::MAX, u32::MAX, 0.1, 0.0).contains("too large"));
        assert!(refusal(1, 1, f64::NAN, 0.0).contains("metres per cell"));
        assert!(refusal(1, 1, 0.1, f64::INFINITY).contains("origin"));
    }

    proptest! {
        #[test]
        fn cells_and_points_are_inverse(width in 1_u32..60, height in 1_u32..60, pick: prop::sample::Index,
                                        resolution in 0.01_f64..2.0, x in -50.0_f64..50.0, y in -50.0_f64..50.0) {
            let lattice = Lattice::new(width, height, resolution, [x, y]).unwrap();
            let cell = lattice.cell(pick.index(lattice.len()));
            prop_assert_eq!(lattice.cell_at(lattice.center(cell)), Some(cell));
            prop_assert_eq!(lattice.cell(lattice.index(cell)), cell);
            prop_assert!(lattice.side_neighbors(cell).all(|near| near.column.abs_diff(cell.column) + near.row.abs_diff(cell.row) == 1));
        }
    }
}
