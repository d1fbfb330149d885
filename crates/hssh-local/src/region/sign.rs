//! Signs of a plan: what is drawn, and stands nowhere. The leaf of a door with its arc, words, and the frame of a page.

use rustc_hash::FxHashSet;

use super::leaf::Leaf;
use super::options::RegionOptions;
use super::sweep::{self, Sweeps};
use super::{frame, hollow, lettering};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::skeleton::UnknownSpace;

/// The signs of doors.
#[derive(Default)]
pub(super) struct DoorSigns {
    /// The leaves as they are drawn.
    pub(super) leaves: Vec<Leaf>,
    /// The cells of leaves, of their arcs, and of lines across their openings, by index.
    pub(super) cells: FxHashSet<usize>,
}

/// Frees the cells of the frame of a page.
pub(super) fn free_frames(grid: &mut OccupancyGrid, options: &RegionOptions) {
    let frames =
        frame::frames(grid.lattice(), |index| is_obstacle(grid, index, options), options.thickest_wall);
    free(grid, frames);
}

/// Frees the cells of words and of the signs of doors; `drawn` is the plan before anything in it was settled. Beside doors that
/// are drawn like that walls are often two lines: what is between them becomes wall.
pub(super) fn free_signs(
    grid: &mut OccupancyGrid,
    drawn: &OccupancyGrid,
    options: &RegionOptions,
) -> DoorSigns {
    // What a robot drew has unknown parts, and no words.
    let is_lettered = !grid.cells().contains(&Occupancy::Unknown);
    let words = is_lettered.then(|| lettering::lettering(drawn, |index| is_obstacle(grid, index, options)));
    let Sweeps { leaves, cells, ways } =
        sweep::sweeps(grid.lattice(), |index| is_obstacle(grid, index, options), &options.leaf);
    if !leaves.is_empty() {
        let wall =
            hollow::hollows(grid, |index| is_obstacle(grid, index, options), options.thickest_wall, &ways);
        wall.into_iter().for_each(|index| grid.set(grid.lattice().cell(index), Occupancy::Occupied));
    }
    let cells: FxHashSet<usize> = cells.into_iter().map(|cell| grid.lattice().index(cell)).collect();
    free(grid, cells.iter().copied().chain(words.into_iter().flatten()));
    DoorSigns { leaves, cells }
}

/// Whether no robot can be in the cell with an index.
pub(super) fn is_obstacle(grid: &OccupancyGrid, index: usize, options: &RegionOptions) -> bool {
    match grid.cells()[index] {
        Occupancy::Free => false,
        Occupancy::Occupied => true,
        Occupancy::Unknown => options.unknown != UnknownSpace::Free,
    }
}

fn free(grid: &mut OccupancyGrid, cells: impl IntoIterator<Item = usize>) {
    cells.into_iter().for_each(|index| grid.set(grid.lattice().cell(index), Occupancy::Free));
}
