//! What is known of each cell of a lattice.

use super::{Cell, Lattice};

/// What is known of a cell.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Occupancy {
    /// Never seen.
    #[default]
    Unknown,
    /// Seen, and nothing is there.
    Free,
    /// Something is there.
    Occupied,
}

/// A lattice with what is known of its cells.
#[derive(Clone, PartialEq, Debug)]
pub struct OccupancyGrid {
    lattice: Lattice,
    cells: Vec<Occupancy>,
}

/// Why cells make no grid.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum GridError {
    /// More or fewer cells than the lattice has.
    #[error("a lattice of {expected} cells was given {given}")]
    CellCount {
        /// What the lattice has.
        expected: usize,
        /// What was given.
        given: usize,
    },
}

impl OccupancyGrid {
    /// A grid from its cells in row-major order, the bottom row first.
    ///
    /// # Errors
    /// If there are not as many cells as the lattice has.
    pub fn new(lattice: Lattice, cells: Vec<Occupancy>) -> Result<Self, GridError> {
        if cells.len() != lattice.len() {
            return Err(GridError::CellCount { expected: lattice.len(), given: cells.len() });
        }
        Ok(OccupancyGrid { lattice, cells })
    }

    /// A grid with every cell alike.
    #[must_use]
    pub fn filled(lattice: Lattice, occupancy: Occupancy) -> Self {
        OccupancyGrid { lattice, cells: vec![occupancy; lattice.len()] }
    }

    /// Where the cells are.
    #[must_use]
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// All cells in row-major order, the bottom row first.
    #[must_use]
    pub fn cells(&self) -> &[Occupancy] {
        &self.cells
    }

    /// What is known of a cell of this grid.
    #[must_use]
    pub fn get(&self, cell: Cell) -> Occupancy {
        self.cells[self.lattice.index(cell)]
    }

    /// Says what is known of a cell of this grid.
    pub fn set(&mut self, cell: Cell, occupancy: Occupancy) {
        self.cells[self.lattice.index(cell)] = occupancy;
    }

    /// What is known at a point in metres: unknown outside the grid.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> Occupancy {
        self.lattice.cell_at(point).map_or(Occupancy::Unknown, |cell| self.get(cell))
    }

    /// The number of cells of which this is known.
    #[must_use]
    pub fn count(&self, occupancy: Occupancy) -> usize {
        self.cells.iter().filter(|&&cell| cell == occupancy).count()
    }

    /// The first cell on the straight line between two cells that is not free, if there is one: what
    /// blocks the view from one to the other.
    #[must_use]
    pub fn first_blocked(&self, from: Cell, to: Cell) -> Option<Cell> {
        self.lattice.line(from, to).find(|&cell| self.get(cell) != Occupancy::Free)
    }

    /// The smallest part of the grid that has all cells of which something is known, and a margin of one cell as far as the
    /// grid has it; the grid itself if nothing is known.
    #[must_use]
    pub fn known_part(self) -> OccupancyGrid {
        let is_known = |cell: &Cell| self.get(*cell) != Occupancy::Unknown;
        let extend = |bounds: Option<[Cell; 2]>, cell: Cell| {
            let [low, high] = bounds.unwrap_or([cell; 2]);
            Some([
                Cell { column: low.column.min(cell.column), row: low.row.min(cell.row) },
                Cell { column: high.column.max(cell.column), row: high.row.max(cell.row) },
            ])
        };
        let Some([low, high]) = self.lattice.cells().filter(is_known).fold(None, extend) else { return self };
        let first = Cell { column: low.column.saturating_sub(1), row: low.row.saturating_sub(1) };
        let end = [(high.column + 2).min(self.lattice.width()), (high.row + 2).min(self.lattice.height())];
        let lattice = self.lattice.part(first, end);
        let inside = |row: u32| {
            let start = self.lattice.index(Cell { column: first.column, row: first.row + row });
            start..start + lattice.width() as usize
        };
        let cells = (0..lattice.height()).flat_map(|row| self.cells[inside(row)].iter().copied()).collect();
        OccupancyGrid { lattice, cells }
    }

    /// The part of the grid within a square of `side` metres around a point, with the same cells;
    /// `None` if no cell of the grid is in it.
    #[must_use]
    pub fn window(&self, center: [f64; 2], side: f64) -> Option<OccupancyGrid> {
        let (lattice, first) = self.lattice.window(center, side)?;
        let known = |cell: Cell| Cell { column: first.column + cell.column, row: first.row + cell.row };
        let cells = lattice.cells().map(|cell| self.get(known(cell))).collect();
        Some(OccupancyGrid { lattice, cells })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkered() -> OccupancyGrid {
        let lattice = Lattice::new(10, 8, 0.5, [-1.0, -2.0]).unwrap();
        let occupancy = |cell: Cell| {
            [Occupancy::Free, Occupancy::Occupied][usize::from((cell.column + cell.row).is_multiple_of(2))]
        };
        OccupancyGrid::new(lattice, lattice.cells().map(occupancy).collect()).unwrap()
    }

    #[test]
    fn a_window_shows_the_same_things_at_the_same_points() {
        let grid = checkered();
        let window = grid.window([0.0, 0.0], 3.0).unwrap();
        assert_eq!((window.lattice().width(), window.lattice().height()), (5, 6));
        for cell in window.lattice().cells() {
            assert_eq!(window.get(cell), grid.at(window.lattice().center(cell)));
        }
        assert_eq!(grid.window([100.0, 0.0], 3.0), None);
    }

    #[test]
    fn the_known_part_shows_the_same_things_at_the_same_points() {
        let mut grid = OccupancyGrid::filled(*checkered().lattice(), Occupancy::Unknown);
        assert_eq!(grid.clone().known_part(), grid);
        grid.set(Cell { column: 3, row: 0 }, Occupancy::Free);
        grid.set(Cell { column: 5, row: 2 }, Occupancy::Occupied);
        let part = grid.clone().known_part();
        assert_eq!((part.lattice().width(), part.lattice().height()), (5, 4));
        for cell in part.lattice().cells() {
            assert_eq!(part.get(cell), grid.at(part.lattice().center(cell)));
        }
        assert_eq!([Occupancy::Free, Occupancy::Occupied].map(|known| part.count(known)), [1, 1]);
    }

    #[test]
    fn the_wrong_number_of_cells_is_no_grid() {
        let lattice = *checkered().lattice();
        let error = OccupancyGrid::new(lattice, vec![Occupancy::Free]).unwrap_err();
        assert_eq!(error.to_string(), "a lattice of 80 cells was given 1");
    }

    #[test]
    fn outside_is_unknown() {
        assert_eq!(checkered().at([99.0, 0.0]), Occupancy::Unknown);
    }

    #[test]
    fn a_wall_blocks_the_view() {
        let lattice = Lattice::new(7, 1, 1.0, [0.0, 0.0]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
        let cell = |column| Cell { column, row: 0 };
        assert_eq!(grid.first_blocked(cell(0), cell(6)), None);
        grid.set(cell(4), Occupancy::Occupied);
        assert_eq!(grid.first_blocked(cell(0), cell(6)), Some(cell(4)));
        assert_eq!(grid.first_blocked(cell(6), cell(0)), Some(cell(4)));
    }
}
