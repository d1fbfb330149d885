//! Distances that a robot travels from many cells at once.

use crate::grid::{Cell, Lattice};

/// Steps to a neighbor across a side and across a corner, in fifths of a cell: 7/5 stands for √2.
const STRAIGHT: u32 = 5;
const DIAGONAL: u32 = 7;

/// Marks a cell that was not reached.
pub(super) const UNREACHED: u32 = u32::MAX;

/// For each cell which of the sources is nearest, by its position in the list; through the cells that `is_free`
/// tells, as far as `reach` metres.
pub(super) fn flood(
    lattice: &Lattice,
    sources: &[Cell],
    reach: f64,
    is_free: impl Fn(Cell) -> bool,
) -> Vec<u32> {
    let mut source_of = vec![UNREACHED; lattice.len()];
    let mut fifths = vec![UNREACHED; lattice.len()];
    let most = (reach / lattice.resolution() * f64::from(STRAIGHT)).floor() as usize;
    // Dijkstra's algorithm, with one list of cells per distance.
    let mut waiting: Vec<Vec<Cell>> = vec![Vec::new(); most + DIAGONAL as usize + 1];
    for (number, &source) in sources.iter().enumerate() {
        let index = lattice.index(source);
        if source_of[index] == UNREACHED {
            (source_of[index], fifths[index]) = (number as u32, 0);
            waiting[0].push(source);
        }
    }
    for distance in 0..=most {
        while let Some(cell) = waiting[distance].pop() {
            let index = lattice.index(cell);
            if fifths[index] != distance as u32 {
                continue;
            }
            for (columns, rows) in (-1..=1).flat_map(|rows| (-1..=1).map(move |columns| (columns, rows))) {
                let Some(next) = lattice.step(cell, columns, rows).filter(|&next| is_free(next)) else {
                    continue;
                };
                let farther = distance as u32 + if columns != 0 && rows != 0 { DIAGONAL } else { STRAIGHT };
                let next_index = lattice.index(next);
                if farther < fifths[next_index] && farther as usize <= most {
                    (fifths[next_index], source_of[next_index]) = (farther, source_of[index]);
                    waiting[farther as usize].push(next);
                }
            }
        }
    }
    source_of
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
            let found = flood(&lattice, &sources, reach, |cell| is_free(cell.column, cell.row));
            prop_assert_eq!(found.len(), lattice.len());
            for (index, &source) in found.iter().enumerate() {
                let least = alone.iter().map(|distances| distances[index]).min().unwrap_or(u32::MAX);
                let is_reached = f64::from(least) * 0.1 <= reach;
                prop_assert_eq!(source != UNREACHED, is_reached, "{} fifths", least);
                if is_reached {
                    prop_assert_eq!(alone[source as usize][index], least);
                }
            }
        }
    }
}
