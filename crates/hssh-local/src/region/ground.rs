//! The ground that regions are made of: the grid with what is certainly wall told from what was never seen.

use super::bits::Bits;
use super::options::RegionOptions;
use crate::distance::DistanceField;
use crate::grid::{Cell, Occupancy, OccupancyGrid};
use crate::skeleton::{SkeletonOptions, UnknownSpace, clear_field};

/// In a map that is not complete, thin unknown space is the face of a wall if there is wall no farther than this, in metres.
const FACE: f64 = 0.1;

/// What regions are made of.
pub(super) struct Ground {
    /// With rims settled.
    grid: OccupancyGrid,
    /// Without furniture.
    field: DistanceField,
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
        let field = clear_field(&grid, &clearing);
        Ground { grid, field, unknown: options.unknown }
    }

    /// How far each cell is from what no robot can go through.
    pub(super) fn field(&self) -> &DistanceField {
        &self.field
    }

    /// Whether no robot can be in the cell with an index.
    pub(super) fn is_obstacle(&self, index: usize) -> bool {
        self.field().squared_at(index) == 0
    }

    /// Whether all obstacles are wall, and no part of them was merely not seen.
    pub(super) fn is_all_wall(&self) -> bool {
        self.unknown != UnknownSpace::Unexplored
    }

    /// Whether the cell with an index is wall, or anything else that stands there for certain.
    pub(super) fn is_wall(&self, index: usize) -> bool {
        self.is_obstacle(index) && (self.is_all_wall() || self.grid.cells()[index] == Occupancy::Occupied)
    }

    /// Whether there is wall at a point in metres; there is beyond the map, unless it is unexplored.
    pub(super) fn is_wall_at(&self, point: [f64; 2]) -> bool {
        let lattice = self.grid.lattice();
        let at = lattice.cell_at(point).map(|cell| self.is_wall(lattice.index(cell)));
        at.unwrap_or(self.is_all_wall())
    }
}

/// The grid with what is certainly wall.
fn settled(grid: &OccupancyGrid, options: &RegionOptions) -> OccupancyGrid {
    if options.unknown == UnknownSpace::Unexplored {
        // What no scan met between two rays is thin as well, and no wall.
        let walls = DistanceField::new(*grid.lattice(), |index| grid.cells()[index] == Occupancy::Occupied);
        with_rims(grid, options.rim, |index| walls.clearance_at(index) <= FACE)
    } else {
        // Nothing is known beyond the map.
        let mut settled = without_rims(grid, options.rim);
        let lattice = *grid.lattice();
        let [last_column, last_row] = [lattice.width() - 1, lattice.height() - 1];
        let columns = (0..lattice.width()).flat_map(|column| [(column, 0), (column, last_row)]);
        let rows = (0..lattice.height()).flat_map(|row| [(0, row), (last_column, row)]);
        columns.chain(rows).for_each(|(column, row)| settled.set(Cell { column, row }, Occupancy::Occupied));
        settled
    }
}

/// The grid of which unknown space that is thinner than so many metres, between what is known, is wall: drawings have gray
/// rims, which would else be frontiers, and robots leave specks.
#[must_use]
pub fn without_rims(grid: &OccupancyGrid, thinnest: f64) -> OccupancyGrid {
    with_rims(grid, thinnest, |_| true)
}

/// The grid with walls in those of its cells, asked by index, that are unknown and in no square of that many metres of which
/// nothing is known.
fn with_rims(grid: &OccupancyGrid, thinnest: f64, is_wall: impl Fn(usize) -> bool) -> OccupancyGrid {
    let lattice = *grid.lattice();
    let reach = (thinnest / 2.0 / lattice.resolution()).round().max(1.0) as usize;
    let width = lattice.width() as usize;
    let is_unknown = |column: usize, row: usize| grid.cells()[row * width + column] == Occupancy::Unknown;
    let wide = Bits::new([width, lattice.height() as usize], reach, is_unknown).opened();
    let mut walled = grid.clone();
    for (index, cell) in lattice.cells().enumerate() {
        let is_rim = || !wide.contains(cell.column as usize, cell.row as usize);
        if grid.cells()[index] == Occupancy::Unknown && is_rim() && is_wall(index) {
            walled.set(cell, Occupancy::Occupied);
        }
    }
    walled
}
