//! The ground that regions are made of: the grid with what is certainly wall told from what was never seen.

use super::options::RegionOptions;
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::skeleton::{FreeSpace, SkeletonOptions, UnknownSpace};

/// In a map that is not complete, thin unknown space is the face of a wall if there is wall no farther than this, in metres.
const FACE: f64 = 0.1;

/// What regions are made of.
pub(super) struct Ground {
    /// With rims settled.
    grid: OccupancyGrid,
    /// Without furniture.
    free: FreeSpace,
    unknown: UnknownSpace,
}

impl Ground {
    pub(super) fn new(grid: &OccupancyGrid, options: &RegionOptions) -> Self {
        let grid = settled(grid, options);
        let clearing = SkeletonOptions {
            unknown: options.unknown,
            clutter: options.furniture,
            apart: options.apart,
            narrowest_passage: options.narrowest,
            ..SkeletonOptions::default()
        };
        let free = FreeSpace::new(&grid, &clearing);
        Ground { grid, free, unknown: options.unknown }
    }

    pub(super) fn free(&self) -> &FreeSpace {
        &self.free
    }

    /// How far each cell is from what no robot can go through.
    pub(super) fn field(&self) -> &DistanceField {
        self.free.field()
    }

    /// Whether no robot can be in the cell with an index.
    pub(super) fn is_obstacle(&self, index: usize) -> bool {
        self.field().squared_at(index) == 0
    }

    /// Whether the cell with an index is wall, or anything else that stands there for certain.
    pub(super) fn is_wall(&self, index: usize) -> bool {
        self.is_obstacle(index)
            && (self.unknown != UnknownSpace::Unexplored || self.grid.cells()[index] == Occupancy::Occupied)
    }

    /// Whether there is wall at a point in metres; there is beyond the map, unless it is unexplored.
    pub(super) fn is_wall_at(&self, point: [f64; 2]) -> bool {
        let lattice = self.grid.lattice();
        let at = lattice.cell_at(point).map(|cell| self.is_wall(lattice.index(cell)));
        at.unwrap_or(self.unknown != UnknownSpace::Unexplored)
    }
}

/// The grid with what is certainly wall.
fn settled(grid: &OccupancyGrid, options: &RegionOptions) -> OccupancyGrid {
    let lattice = *grid.lattice();
    let is_rim = rims(grid, options.rim);
    if options.unknown == UnknownSpace::Unexplored {
        // What no scan met between two rays is thin as well, and no wall.
        let walls = DistanceField::new(lattice, |index| grid.cells()[index] == Occupancy::Occupied);
        with_walls(grid, |index| is_rim[index] && walls.clearance_at(index) <= FACE)
    } else {
        // Nothing is known beyond the map.
        with_walls(grid, |index| is_rim[index] || is_outermost(&lattice, lattice.cell(index)))
    }
}

/// The grid of which unknown space that is thinner than so many metres, between what is known, is wall: drawings have gray
/// rims, which would else be frontiers, and robots leave specks.
#[must_use]
pub fn without_rims(grid: &OccupancyGrid, thinnest: f64) -> OccupancyGrid {
    let is_rim = rims(grid, thinnest);
    with_walls(grid, |index| is_rim[index])
}

/// The grid with walls in further cells, by their indices.
fn with_walls(grid: &OccupancyGrid, is_wall: impl Fn(usize) -> bool) -> OccupancyGrid {
    let lattice = *grid.lattice();
    let mut walled = grid.clone();
    for cell in lattice.cells().filter(|&cell| is_wall(lattice.index(cell))) {
        walled.set(cell, Occupancy::Occupied);
    }
    walled
}

/// For each cell whether it is unknown, and in no square of that many metres of which nothing is known.
fn rims(grid: &OccupancyGrid, thinnest: f64) -> Vec<bool> {
    let lattice = grid.lattice();
    let reach = (thinnest / 2.0 / lattice.resolution()).round().max(1.0) as u32;
    let mut is_rim = opened(lattice, reach, |cell| grid.get(cell) == Occupancy::Unknown);
    for (is_rim, &known) in is_rim.iter_mut().zip(grid.cells()) {
        *is_rim = known == Occupancy::Unknown && !*is_rim;
    }
    is_rim
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
