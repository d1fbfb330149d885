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
