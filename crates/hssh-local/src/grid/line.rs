//! The cells of a straight line between two cells, in order (Bresenham's algorithm).

use super::Cell;

/// Goes from cell to cell along a straight line; consecutive cells share a side or a corner.
#[derive(Clone, Debug)]
pub struct CellLine {
    at: Cell,
    to: Cell,
    /// Cells to go in each direction, the vertical ones counted negative.
    distance: [i64; 2],
    step: [i32; 2],
    error: i64,
    is_over: bool,
}

impl CellLine {
    pub(super) fn new(from: Cell, to: Cell) -> Self {
        let distance = [i64::from(to.column.abs_diff(from.column)), -i64::from(to.row.abs_diff(from.row))];
        let toward = |from: u32, to: u32| if from < to { 1 } else { -1 };
        CellLine {
            at: from,
            to,
            distance,
            step: [toward(from.column, to.column), toward(from.row, to.row)],
            error: distance[0] + distance[1],
            is_over: false,
        }
    }
}

impl Iterator for CellLine {
    type Item = Cell;

    fn next(&mut self) -> Option<Cell> {
        if self.is_over {
            return None;
        }
        let here = self.at;
        self.is_over = here == self.to;
        let twice = 2 * self.error;
        if twice >= self.distance[1] {
            self.error += self.distance[1];
            self.at.column = self.at.column.wrapping_add_signed(self.step[0]);
        }
        if twice <= self.distance[0] {
            self.error += self.distance[0];
            self.at.row = self.at.row.wrapping_add_signed(self.step[1]);
        }
        Some(here)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Every cell of the line is within half a cell of the exact line, and no step is a jump.
        #[test]
        fn follows_the_exact_line(from in (0_u32..50, 0_u32..50), to in (0_u32..50, 0_u32..50)) {
            let cell = |(column, row)| Cell { column, row };
            let line: Vec<Cell> = CellLine::new(cell(from), cell(to)).collect();
            prop_assert_eq!((line[0], line[line.len() - 1]), (cell(from), cell(to)));
            let [dx, dy] = [f64::from(to.0) - f64::from(from.0), f64::from(to.1) - f64::from(from.1)];
            let longest = dx.abs().max(dy.abs());
            prop_assert_eq!(line.len(), longest as usize + 1);
            for (step, at) in line.iter().enumerate() {
                let part = if longest > 0.0 { step as f64 / longest } else { 0.0 };
                prop_assert!((f64::from(at.column) - f64::from(from.0) - part * dx).abs() <= 0.5 + 1e-9);
                prop_assert!((f64::from(at.row) - f64::from(from.1) - part * dy).abs() <= 0.5 + 1e-9);
            }
        }
    }
}
