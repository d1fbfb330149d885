//! How far a robot has to travel from one cell of free space to all others.

use crate::grid::{Cell, Lattice};

/// Steps to a neighbor across a side and across a corner, in fifths of a cell: 7/5 stands for √2.
const STRAIGHT: u32 = 5;
const DIAGONAL: u32 = 7;
const UNREACHED: u32 = u32::MAX;

/// Travelling distances from a cell.
pub(super) struct Geodesic {
    lattice: Lattice,
    fifths: Vec<u32>,
    /// The cells that were reached, the nearest first.
    reached: Vec<Cell>,
}

impl Geodesic {
    /// Distances from `start` through the cells that `is_free` tells, as far as `reach` metres.
    pub(super) fn new(lattice: &Lattice, start: Cell, reach: f64, is_free: impl Fn(Cell) -> bool) -> Self {
        let mut fifths = vec![UNREACHED; lattice.len()];
        let mut reached = Vec::new();
        let most = (reach / lattice.resolution() * f64::from(STRAIGHT)) as usize;
        // Dijkstra's algorithm, with one list of cells per distance.
        let mut waiting: Vec<Vec<Cell>> = vec![Vec::new(); most + DIAGONAL as usize + 1];
        fifths[lattice.index(start)] = 0;
        waiting[0].push(start);
        for distance in 0..=most {
            while let Some(cell) = waiting[distance].pop() {
                if fifths[lattice.index(cell)] != distance as u32 {
                    continue;
                }
                reached.push(cell);
                for (columns, rows) in neighbors() {
                    let Some(next) = lattice.step(cell, columns, rows).filter(|&next| is_free(next)) else {
                        continue;
                    };
                    let step = if columns != 0 && rows != 0 { DIAGONAL } else { STRAIGHT };
                    let farther = distance as u32 + step;
                    if farther < fifths[lattice.index(next)] {
                        fifths[lattice.index(next)] = farther;
                        waiting[farther as usize].push(next);
                    }
                }
            }
        }
        Geodesic { lattice: *lattice, fifths, reached }
    }

    /// Metres to a cell, if it was reached.
    pub(super) fn distance(&self, cell: Cell) -> Option<f64> {
        let fifths = self.fifths[self.lattice.index(cell)];
        (fifths != UNREACHED).then(|| f64::from(fifths) / f64::from(STRAIGHT) * self.lattice.resolution())
    }

    /// The cells that were reached, the nearest first.
    pub(super) fn reached(&self) -> &[Cell] {
        &self.reached
    }

    /// The connected groups of the cells whose distances are in a range, in the order of their nearest cells.
    pub(super) fn groups(&self, range: std::ops::Range<f64>) -> Vec<Vec<Cell>> {
        let is_in = |cell: Cell| self.distance(cell).is_some_and(|distance| range.contains(&distance));
        let mut is_seen = vec![false; self.lattice.len()];
        let mut groups = Vec::new();
        for &start in &self.reached {
            if is_seen[self.lattice.index(start)] || !is_in(start) {
                continue;
            }
            is_seen[self.lattice.index(start)] = true;
            let mut group = vec![start];
            let mut at = 0;
            while at < group.len() {
                for (columns, rows) in neighbors() {
                    if let Some(next) = self.lattice.step(group[at], columns, rows)
                        && !is_seen[self.lattice.index(next)]
                        && is_in(next)
                    {
                        is_seen[self.lattice.index(next)] = true;
                        group.push(next);
                    }
                }
                at += 1;
            }
            groups.push(group);
        }
        groups
    }
}

fn neighbors() -> impl Iterator<Item = (i32, i32)> {
    (-1..=1).flat_map(|rows| (-1..=1).map(move |columns| (columns, rows))).filter(|&step| step != (0, 0))
}
