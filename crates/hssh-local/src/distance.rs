//! The exact Euclidean distance transform: how far each cell is from the nearest obstacle, and which
//! one that is, in time linear in the number of cells (after Meijster, Roerdink and Hesselink, 2000).

use crate::grid::{Cell, Lattice};

/// Marks a cell without any obstacle to measure from.
const NOWHERE: u32 = u32::MAX;

/// For each cell of a lattice its nearest obstacle.
///
/// Cells beyond the lattice are no obstacles: free space is open at the border.
#[derive(Clone, PartialEq, Debug)]
pub struct DistanceField {
    lattice: Lattice,
    /// Squared distance in cells between the middles of a cell and of its nearest obstacle.
    squared: Vec<u32>,
    /// The nearest obstacle's index in the lattice.
    nearest: Vec<u32>,
}

impl DistanceField {
    /// The distances from the cells for which `is_obstacle` holds; it is asked by index.
    #[must_use]
    pub fn new(lattice: Lattice, is_obstacle: impl Fn(usize) -> bool) -> Self {
        let rows = nearest_rows(&lattice, is_obstacle);
        let mut field =
            DistanceField { lattice, squared: vec![0; lattice.len()], nearest: vec![0; lattice.len()] };
        let mut envelope = Envelope::default();
        for row in 0..lattice.height() {
            let first = lattice.index(Cell { column: 0, row });
            let range = first..first + lattice.width() as usize;
            envelope.build(row, &rows[range.clone()]);
            envelope.write(
                row,
                &lattice,
                &rows[range.clone()],
                &mut field.squared[range.clone()],
                &mut field.nearest[range],
            );
        }
        field
    }

    /// Where the cells are.
    #[must_use]
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The squared distance in cells from the middle of a cell to the middle of its nearest obstacle;
    /// `None` if there is no obstacle at all.
    #[must_use]
    pub fn squared_cells(&self, cell: Cell) -> Option<u32> {
        Some(self.squared[self.lattice.index(cell)]).filter(|&squared| squared != NOWHERE)
    }

    /// The nearest obstacle of a cell; `None` if there is no obstacle at all.
    #[must_use]
    pub fn nearest(&self, cell: Cell) -> Option<Cell> {
        let nearest = self.nearest[self.lattice.index(cell)];
        (nearest != NOWHERE).then(|| self.lattice.cell(nearest as usize))
    }

    /// The squared distance in cells of the cell with an index; without any obstacle, the greatest number.
    pub(crate) fn squared_at(&self, index: usize) -> u32 {
        self.squared[index]
    }

    /// Whether the cell with an index is no obstacle, and there are obstacles.
    pub(crate) fn is_free_at(&self, index: usize) -> bool {
        !matches!(self.squared[index], 0 | NOWHERE)
    }

    /// How many metres are free around the middle of a cell: the distance to the middle of the nearest
    /// obstacle less half a cell, 0 in an obstacle, infinite if there is none.
    #[must_use]
    pub fn clearance(&self, cell: Cell) -> f64 {
        self.clearance_at(self.lattice.index(cell))
    }

    /// The same of the cell with an index.
    pub(crate) fn clearance_at(&self, index: usize) -> f64 {
        match self.squared[index] {
            NOWHERE => f64::INFINITY,
            squared => (f64::from(squared).sqrt() - 0.5).max(0.0) * self.lattice.resolution(),
        }
    }
}

/// First phase: for each cell, the row of the nearest obstacle in its column.
fn nearest_rows(lattice: &Lattice, is_obstacle: impl Fn(usize) -> bool) -> Vec<u32> {
    let width = lattice.width() as usize;
    let mut rows = vec![NOWHERE; lattice.len()];
    for index in 0..lattice.len() {
        if is_obstacle(index) {
            rows[index] = (index / width) as u32;
        } else if index >= width {
            rows[index] = rows[index - width];
        }
    }
    for index in (0..lattice.len() - width).rev() {
        let above = rows[index + width];
        let row = (index / width) as u32;
        let below = rows[index];
        let is_obstacle_above = above != NOWHERE && above > row;
        if is_obstacle_above && (below == NOWHERE || above - row < row - below) {
            rows[index] = above;
        }
    }
    rows
}

/// Second phase: the lower envelope of the parabolas of one row, one for each column with an obstacle.
#[derive(Default)]
struct Envelope {
    /// Column and squared vertical distance of each parabola of the envelope.
    parabolas: Vec<(i64, i64)>,
    /// The first column at which each is the lowest.
    from: Vec<i64>,
}

impl Envelope {
    fn build(&mut self, row: u32, rows: &[u32]) {
        self.parabolas.clear();
        self.from.clear();
        for (column, &nearest) in rows.iter().enumerate().filter(|&(_, &nearest)| nearest != NOWHERE) {
            let added = (column as i64, i64::from(nearest.abs_diff(row)).pow(2));
            let mut from = 0;
            while let (Some(&top), Some(&top_from)) = (self.parabolas.last(), self.from.last()) {
                from = first_column_below(top, added);
                if from > top_from {
                    break;
                }
                self.parabolas.pop();
                self.from.pop();
                from = 0;
            }
            self.parabolas.push(added);
            self.from.push(from);
        }
    }

    fn write(&self, row: u32, lattice: &Lattice, rows: &[u32], squared: &mut [u32], nearest: &mut [u32]) {
        if self.parabolas.is_empty() {
            squared.fill(NOWHERE);
            nearest.fill(NOWHERE);
            return;
        }
        debug_assert!(row < lattice.height());
        let mut lowest = 0;
        for column in 0..rows.len() {
            while self.from.get(lowest + 1).is_some_and(|&from| from <= column as i64) {
                lowest += 1;
            }
            let (bottom, vertical) = self.parabolas[lowest];
            squared[column] = ((column as i64 - bottom).pow(2) + vertical) as u32;
            let site = Cell { column: bottom as u32, row: rows[bottom as usize] };
            nearest[column] = lattice.index(site) as u32;
        }
    }
}

/// The first column at which the parabola of the right one of two columns is strictly below the other.
fn first_column_below((left, left_squared): (i64, i64), (right, right_squared): (i64, i64)) -> i64 {
    let numerator = right * right - left * left + right_squared - left_squared;
    numerator.div_euclid(2 * (right - left)) + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        /// Against the definition: the least distance over all obstacles.
        #[test]
        fn is_the_least_distance(width in 1_u32..24, height in 1_u32..24, density in 0_u32..8,
                                 noise in prop::collection::vec(0_u32..100, 24 * 24)) {
            let lattice = Lattice::new(width, height, 0.1, [0.0, 0.0]).unwrap();
            let obstacles: Vec<Cell> =
                lattice.cells().filter(|&cell| noise[lattice.index(cell)] < density * density).collect();
            let field = DistanceField::new(lattice, |index| obstacles.contains(&lattice.cell(index)));
            let squared = |a: Cell, b: Cell| a.column.abs_diff(b.column).pow(2) + a.row.abs_diff(b.row).pow(2);
            for cell in lattice.cells() {
                let expected = obstacles.iter().map(|&obstacle| squared(cell, obstacle)).min();
                prop_assert_eq!(field.squared_cells(cell), expected);
                let to_nearest = field.nearest(cell).map(|nearest| {
                    assert!(obstacles.contains(&nearest));
                    squared(cell, nearest)
                });
                prop_assert_eq!(to_nearest, expected);
            }
        }
    }

    #[test]
    fn clearance_ends_at_the_side_of_an_obstacle() {
        let lattice = Lattice::new(5, 1, 2.0, [0.0, 0.0]).unwrap();
        let field = DistanceField::new(lattice, |index| index == 0);
        let clearances: Vec<f64> = lattice.cells().map(|cell| field.clearance(cell)).collect();
        assert_eq!(clearances, [0.0, 1.0, 3.0, 5.0, 7.0]);
        assert_eq!(DistanceField::new(lattice, |_| false).clearance(lattice.cell(0)), f64::INFINITY);
    }
}
