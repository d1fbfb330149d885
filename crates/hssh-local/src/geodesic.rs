//! How far a robot has to travel through free space from one cell, or the nearest of many, to all others.

use crate::grid::{Cell, Lattice};

/// Steps to a neighbor across a side and across a corner, in fifths of a cell: 7/5 stands for √2.
const STRAIGHT: u32 = 5;
const DIAGONAL: u32 = 7;
const UNREACHED: u32 = u32::MAX;

/// Travelling distances from the nearest of some cells.
pub(crate) struct Geodesic {
    lattice: Lattice,
    fifths: Vec<u32>,
    /// For each cell which of the starts is nearest, by its position in the list.
    nearest: Vec<u32>,
    /// Farther than so many fifths of a cell nothing was looked at.
    most: usize,
    /// The cells that were reached, the nearest first.
    reached: Vec<Cell>,
}

impl Geodesic {
    /// Distances from `start` through the cells that `is_free` tells, as far as `reach` metres.
    pub(crate) fn new(lattice: &Lattice, start: Cell, reach: f64, is_free: impl Fn(Cell) -> bool) -> Self {
        Self::from_nearest(lattice, &[start], reach, is_free)
    }

    /// Distances from the nearest of `starts`.
    pub(crate) fn from_nearest(
        lattice: &Lattice,
        starts: &[Cell],
        reach: f64,
        is_free: impl Fn(Cell) -> bool,
    ) -> Self {
        let mut fifths = vec![UNREACHED; lattice.len()];
        let mut nearest = vec![UNREACHED; lattice.len()];
        let mut reached = Vec::new();
        let most = (reach / lattice.resolution() * f64::from(STRAIGHT)) as usize;
        // Dijkstra's algorithm, with one list of cells per distance.
        let mut waiting: Vec<Vec<Cell>> = vec![Vec::new(); most + DIAGONAL as usize + 1];
        for (number, &start) in starts.iter().enumerate() {
            let index = lattice.index(start);
            if fifths[index] == UNREACHED {
                (fifths[index], nearest[index]) = (0, number as u32);
                waiting[0].push(start);
            }
        }
        for distance in 0..=most {
            while let Some(cell) = waiting[distance].pop() {
                let index = lattice.index(cell);
                if fifths[index] != distance as u32 {
                    continue;
                }
                reached.push(cell);
                for (columns, rows) in neighbors() {
                    let Some(next) = lattice.step(cell, columns, rows).filter(|&next| is_free(next)) else {
                        continue;
                    };
                    let step = if columns != 0 && rows != 0 { DIAGONAL } else { STRAIGHT };
                    let farther = distance as u32 + step;
                    let next_index = lattice.index(next);
                    if farther < fifths[next_index] {
                        (fifths[next_index], nearest[next_index]) = (farther, nearest[index]);
                        waiting[farther as usize].push(next);
                    }
                }
            }
        }
        Geodesic { lattice: *lattice, fifths, nearest, most, reached }
    }

    /// Which of the starts is nearest to a cell, by its position in the list, if the cell was reached.
    pub(crate) fn nearest(&self, cell: Cell) -> Option<usize> {
        let index = self.lattice.index(cell);
        // Beyond the reach a distance may be known, and need not be the shortest.
        (self.fifths[index] as usize <= self.most).then(|| self.nearest[index] as usize)
    }

    /// Metres to a cell, if it was reached.
    pub(crate) fn distance(&self, cell: Cell) -> Option<f64> {
        let fifths = self.fifths[self.lattice.index(cell)];
        (fifths != UNREACHED).then(|| f64::from(fifths) / f64::from(STRAIGHT) * self.lattice.resolution())
    }

    /// The cells that were reached, the nearest first.
    pub(crate) fn reached(&self) -> &[Cell] {
        &self.reached
    }

    /// The connected groups of the cells whose distances are in a range, in the order of their nearest cells.
    pub(crate) fn groups(&self, range: std::ops::Range<f64>) -> Vec<Vec<Cell>> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The distance in fifths of a cell from each cell to a source, by going through all cells until nothing
    /// becomes shorter.
    fn distances(
        width: u32,
        height: u32,
        source: (u32, u32),
        is_free: impl Fn(u32, u32) -> bool,
    ) -> Vec<u32> {
        let mut distances = vec![u32::MAX; (width * height) as usize];
        distances[(source.1 * width + source.0) as usize] = 0;
        loop {
            let before = distances.clone();
            for (column, row) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
                let here = before[(row * width + column) as usize];
                if here == u32::MAX {
                    continue;
                }
                for (c, r) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
                    let off = (c.abs_diff(column), r.abs_diff(row));
                    let step = match off {
                        (0, 1) | (1, 0) => 5,
                        (1, 1) => 7,
                        _ => continue,
                    };
                    if is_free(c, r) {
                        let there = &mut distances[(r * width + c) as usize];
                        *there = (*there).min(here + step);
                    }
                }
            }
            if before == distances {
                return distances;
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// Against the distances from each source alone.
        #[test]
        fn the_source_is_a_nearest_one(
            (width, height) in (1_u32..9, 1_u32..9), noise in prop::collection::vec(0_u8..3, 9 * 9),
            places in prop::collection::vec((0_u32..9, 0_u32..9), 0..4), reach in 0.0_f64..4.0,
        ) {
            let lattice = Lattice::new(width, height, 0.5, [3.0, -2.0]).unwrap();
            let is_free = |column: u32, row: u32| noise[(row * 9 + column) as usize] > 0;
            let sources: Vec<Cell> =
                places.iter().map(|at| Cell { column: at.0 % width, row: at.1 % height }).collect();
            let alone: Vec<Vec<u32>> =
                sources.iter().map(|cell| distances(width, height, (cell.column, cell.row), is_free)).collect();
            let found =
                Geodesic::from_nearest(&lattice, &sources, reach, |cell| is_free(cell.column, cell.row));
            for (index, cell) in lattice.cells().enumerate() {
                let source = found.nearest(cell);
                let least = alone.iter().map(|distances| distances[index]).min().unwrap_or(u32::MAX);
                let is_reached = f64::from(least) * 0.1 <= reach;
                prop_assert_eq!(source.is_some(), is_reached, "{} fifths", least);
                if let Some(source) = source {
                    prop_assert_eq!(alone[source][index], least);
                }
            }
        }
    }
}
