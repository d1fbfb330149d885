//! The ground that regions are made of: the grid with what is certainly wall told from what was never seen.

use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};

/// The grid of which unknown space that is too thin to be anything but the edge of a wall is wall: drawings have gray
/// rims, and robots leave specks. The outermost cells are wall, too, for nothing is known beyond.
pub(super) fn settled(grid: &OccupancyGrid, thinnest: f64) -> OccupancyGrid {
    let lattice = *grid.lattice();
    let mut settled = grid.clone();
    let reach = (thinnest / 2.0 / lattice.resolution()).round().max(1.0) as u32;
    let is_wide = opened(&lattice, reach, |cell| grid.get(cell) == Occupancy::Unknown);
    for cell in lattice.cells() {
        let is_rim = grid.get(cell) == Occupancy::Unknown && !is_wide[lattice.index(cell)];
        if is_rim || is_outermost(&lattice, cell) {
            settled.set(cell, Occupancy::Occupied);
        }
    }
    settled
}

fn is_outermost(lattice: &Lattice, Cell { column, row }: Cell) -> bool {
    column == 0 || row == 0 || column + 1 == lattice.width() || row + 1 == lattice.height()
}

/// The cells of squares of `2 reach + 1` cells a side that lie wholly within a set; beyond the lattice all belongs to it.
fn opened(lattice: &Lattice, reach: u32, contains: impl Fn(Cell) -> bool) -> Vec<bool> {
    let mut is_in: Vec<bool> = lattice.cells().map(contains).collect();
    for is_eroding in [true, false] {
        for is_along_rows in [true, false] {
            slide(lattice, &mut is_in, reach, is_along_rows, is_eroding);
        }
    }
    is_in
}

/// Within each line of cells, those stay that have only members within reach if `is_eroding`, else those that have any.
fn slide(lattice: &Lattice, is_in: &mut [bool], reach: u32, is_along_rows: bool, is_eroding: bool) {
    let (width, height) = (lattice.width() as usize, lattice.height() as usize);
    let (lines, length, step, stride) =
        if is_along_rows { (height, width, 1, width) } else { (width, height, width, 1) };
    let reach = reach as usize;
    for line in 0..lines {
        let at = |position: usize| line * stride + position * step;
        // How far back the last cell is that decides: one outside the set for erosion, one in it for dilation.
        let deciding: Vec<usize> =
            (0..length).filter(|&position| is_in[at(position)] != is_eroding).collect();
        let mut next = 0;
        for position in 0..length {
            while next < deciding.len() && deciding[next] + reach < position {
                next += 1;
            }
            let is_decided = next < deciding.len() && deciding[next] <= position + reach;
            is_in[at(position)] = is_decided != is_eroding;
        }
    }
}
