//! The exact Euclidean distance transform: how far each cell is from the nearest obstacle, and which
//! one that is, in time linear in the number of cells (after Meijster, Roerdink and Hesselink, 2000).

use rayon::prelude::*;

use crate::grid::{Cell, Lattice};

/// Marks a cell without any obstacle to measure from.
const NOWHERE: u32 = u32::MAX;
/// The same for a row or a column: a lattice has none with that number.
const NO_LINE: u16 = u16::MAX;
/// From so many cells on, rows are filled in on several threads: fewer take less time than it takes to wake these.
const MANY: usize = 1 << 18;

/// For each cell of a lattice its nearest obstacle.
///
/// Cells beyond the lattice are no obstacles: free space is open at the border.
#[derive(Clone, PartialEq, Debug)]
pub struct DistanceField {
    lattice: Lattice,
    /// Squared distance in cells between the middles of a cell and of its nearest obstacle.
    squared: Vec<u32>,
    /// The nearest obstacle's column; its row follows from the distance.
    columns: Vec<u16>,
}

impl DistanceField {
    /// The distances from the cells for which `is_obstacle` holds; it is asked by index.
    #[must_use]
    pub fn new(lattice: Lattice, is_obstacle: impl Fn(usize) -> bool) -> Self {
        let rows = nearest_rows(&lattice, is_obstacle);
        let mut field =
            DistanceField { lattice, squared: vec![0; lattice.len()], columns: vec![0; lattice.len()] };
        let width = lattice.width() as usize;
        let fill = |envelope: &mut Envelope, row: usize, (squared, columns): (&mut [u32], &mut [u16])| {
            envelope.fill(row as u16, &rows[row * width..][..width], squared, columns);
        };
        if lattice.len() < MANY {
            let lines = field.squared.chunks_exact_mut(width).zip(field.columns.chunks_exact_mut(width));
            let mut envelope = Envelope::default();
            lines.enumerate().for_each(|(row, line)| fill(&mut envelope, row, line));
        } else {
            let lines =
                field.squared.par_chunks_exact_mut(width).zip(field.columns.par_chunks_exact_mut(width));
            lines
                .enumerate()
                .for_each_init(Envelope::default, |envelope, (row, line)| fill(envelope, row, line));
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
        let squared = self.squared_cells(cell)?;
        let column = u32::from(self.columns[self.lattice.index(cell)]);
        let off = (squared - column.abs_diff(cell.column).pow(2)).isqrt();
        let below = cell.row.checked_sub(off).map(|row| Cell { column, row });
        let is_obstacle = |site: &Cell| self.squared[self.lattice.index(*site)] == 0;
        Some(below.filter(is_obstacle).unwrap_or(Cell { column, row: cell.row + off }))
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
        self.clearance_of(self.squared[index])
    }

    /// The same of a cell with that squared distance.
    pub(crate) fn clearance_of(&self, squared: u32) -> f64 {
        match squared {
            NOWHERE => f64::INFINITY,
            squared => (f64::from(squared).sqrt() - 0.5).max(0.0) * self.lattice.resolution(),
        }
    }
}

/// First phase: for each cell, the row of the nearest obstacle in its column, the lower one of two.
fn nearest_rows(lattice: &Lattice, is_obstacle: impl Fn(usize) -> bool) -> Vec<u16> {
    let width = lattice.width() as usize;
    let mut rows = vec![NO_LINE; lattice.len()];
    for row in 0..lattice.height() as usize {
        let (below, here) = rows.split_at_mut(row * width);
        let below = &below[row.saturating_sub(1) * width..];
        for (column, nearest) in here[..width].iter_mut().enumerate() {
            if is_obstacle(row * width + column) {
                *nearest = row as u16;
            } else if row > 0 {
                *nearest = below[column];
            }
        }
    }
    for row in (0..lattice.height() as usize - 1).rev() {
        let (here, above) = rows[row * width..].split_at_mut(width);
        let row = row as u16;
        for (nearest, &above) in here.iter_mut().zip(&above[..width]) {
            let is_obstacle_above = above != NO_LINE && above > row;
            let is_nearer = *nearest == NO_LINE || above.wrapping_sub(row) < row.wrapping_sub(*nearest);
            if is_obstacle_above && is_nearer {
                *nearest = above;
            }
        }
    }
    rows
}

/// Second phase: the lower envelope of parabolas along a row, one for each column with an obstacle.
#[derive(Default)]
struct Envelope {
    /// Column and squared vertical distance of each parabola of the envelope.
    parabolas: Vec<(i64, i64)>,
    /// The first column at which each is the lowest.
    from: Vec<i64>,
}

impl Envelope {
    /// Fills in a row. Obstacles in it part it: what is beyond one is nearer to that than to anything behind it.
    fn fill(&mut self, row: u16, rows: &[u16], squared: &mut [u32], columns: &mut [u16]) {
        let mut start = 0;
        while start < rows.len() {
            if rows[start] == row {
                (squared[start], columns[start]) = (0, start as u16);
                start += 1;
                continue;
            }
            let free = rows[start..].iter().take_while(|&&nearest| nearest != row).count();
            let end = start + free;
            self.build(row, start.saturating_sub(1), &rows[start.saturating_sub(1)..rows.len().min(end + 1)]);
            self.write(start as i64, &mut squared[start..end], &mut columns[start..end]);
            start = end;
        }
    }

    /// The envelope of columns from a first one on.
    fn build(&mut self, row: u16, first: usize, rows: &[u16]) {
        self.parabolas.clear();
        self.from.clear();
        for (column, &nearest) in (first..).zip(rows).filter(|&(_, &nearest)| nearest != NO_LINE) {
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

    fn write(&self, start: i64, squared: &mut [u32], columns: &mut [u16]) {
        if self.parabolas.is_empty() {
            squared.fill(NOWHERE);
            columns.fill(NO_LINE);
            return;
        }
        let mut lowest = 0;
        for (column, (squared, nearest)) in (start..).zip(squared.iter_mut().zip(columns)) {
            while self.from.get(lowest + 1).is_some_and(|&from| from <= column) {
                lowest += 1;
            }
            let (bottom, vertical) = self.parabolas[lowest];
            *squared = ((column - bottom).pow(2) + vertical) as u32;
            *nearest = bottom as u16;
        }
    }
}

/// The first column at which the parabola of the right one of two columns is strictly below the other.
fn first_column_below((left, left_squared): (i64, i64), (right, right_squared): (i64, i64)) -> i64 {
    // Beside the left one, so that the numbers are small.
    let apart = right - left;
    let numerator = apart * apart + right_squared - left_squared;
    left + numerator.div_euclid(2 * apart) + 1
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
