//! Things: obstacles that hang together, in cells that may be larger than those of the map.

use crate::grid::{Cell, Lattice};

/// Obstacles that hang together in a lattice of larger cells.
pub(super) struct Thing {
    /// Its larger cells.
    pub(super) members: Vec<Cell>,
    low: Cell,
    high: Cell,
}

impl Thing {
    /// How many larger cells there are from one side to the other, along both axes.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.high.column - self.low.column + 1, self.high.row - self.low.row + 1]
    }

    /// Whether it reaches none of the outermost cells of so many columns and rows.
    fn is_inside(&self, columns: u32, rows: u32) -> bool {
        self.low.column > 0 && self.low.row > 0 && self.high.column + 1 < columns && self.high.row + 1 < rows
    }
}

/// The things that stand free of the end of the map, as obstacles in cells that are so many times as large hang together.
pub(super) fn things(lattice: &Lattice, is_obstacle: impl Fn(usize) -> bool, times: u32) -> Vec<Thing> {
    let [columns, rows] = [lattice.width(), lattice.height()].map(|cells| cells.div_ceil(times));
    let index = |cell: Cell| cell.row as usize * columns as usize + cell.column as usize;
    let mut is_waiting = vec![false; columns as usize * rows as usize];
    let width = lattice.width() as usize;
    for row in 0..lattice.height() {
        for column in 0..lattice.width() {
            if is_obstacle(row as usize * width + column as usize) {
                is_waiting[index(Cell { column: column / times, row: row / times })] = true;
            }
        }
    }
    let mut things = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let start = Cell { column, row };
            if !std::mem::replace(&mut is_waiting[index(start)], false) {
                continue;
            }
            let mut thing = Thing { members: vec![start], low: start, high: start };
            let mut at = 0;
            while let Some(&here) = thing.members.get(at) {
                let Thing { low, high, .. } = &mut thing;
                *low = Cell { column: low.column.min(here.column), row: low.row.min(here.row) };
                *high = Cell { column: high.column.max(here.column), row: high.row.max(here.row) };
                for row in here.row.saturating_sub(1)..(here.row + 2).min(rows) {
                    for column in here.column.saturating_sub(1)..(here.column + 2).min(columns) {
                        let near = Cell { column, row };
                        if std::mem::replace(&mut is_waiting[index(near)], false) {
                            thing.members.push(near);
                        }
                    }
                }
                at += 1;
            }
            if thing.is_inside(columns, rows) {
                things.push(thing);
            }
        }
    }
    things
}
