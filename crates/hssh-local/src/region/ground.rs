//! The ground that regions are made of: the grid with what is certainly wall told from what was never seen.

use rustc_hash::FxHashSet;

use super::bits::Bits;
use super::kind::End;
use super::leaf::{self, Leaf};
use super::options::RegionOptions;
use super::sign::{self, DoorSigns};
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::skeleton::{SkeletonOptions, UnknownSpace, clear_field};

/// In a map that is not complete, thin unknown space is the face of a wall if there is wall no farther than this, in metres.
const FACE: f64 = 0.1;

/// What regions are made of.
pub(super) struct Ground {
    /// With rims settled, and without leaves of doors.
    grid: OccupancyGrid,
    /// Without furniture.
    field: DistanceField,
    unknown: UnknownSpace,
    /// The outermost cells, by their indices, that are wall only because the map ends there.
    open_edge: FxHashSet<usize>,
    leaves: Vec<Leaf>,
    /// The cells of what is drawn of doors, by their indices.
    signs: FxHashSet<usize>,
}

impl Ground {
    pub(super) fn new(drawn: &OccupancyGrid, options: &RegionOptions) -> Self {
        let mut grid = settled(drawn, options);
        // No robot sees an arc, a word or the frame of a page.
        let is_plan = options.unknown != UnknownSpace::Unexplored;
        if is_plan {
            sign::free_frames(&mut grid, options);
        }
        let is_open = |&index: &usize| {
            drawn.cells()[index] == Occupancy::Free && grid.cells()[index] != Occupancy::Free
        };
        let open_edge =
            edge(drawn.lattice()).map(|cell| drawn.lattice().index(cell)).filter(is_open).collect();
        let DoorSigns { mut leaves, cells: signs } =
            if is_plan { sign::free_signs(&mut grid, drawn, options) } else { DoorSigns::default() };
        let is_obstacle = |index: usize| sign::is_obstacle(&grid, index, options);
        let (ajar, covered) = leaf::leaves(grid.lattice(), is_obstacle, &options.leaf);
        leaves.extend(ajar);
        covered.into_iter().for_each(|cell| grid.set(cell, Occupancy::Free));
        let clearing = SkeletonOptions {
            unknown: options.unknown,
            clutter: options.furniture,
            apart: options.apart,
            narrowest_passage: options.narrowest,
            ..SkeletonOptions::default()
        };
        let field = clear_field(&grid, &clearing);
        Ground { grid, field, unknown: options.unknown, open_edge, leaves, signs }
    }

    /// How far each cell is from what no robot can go through.
    pub(super) fn field(&self) -> &DistanceField {
        &self.field
    }

    /// The leaves of doors that stand open.
    pub(super) fn leaves(&self) -> &[Leaf] {
        &self.leaves
    }

    /// The cells of what is drawn of doors, by their indices: leaves with the arcs that they sweep.
    pub(super) fn into_signs(self) -> FxHashSet<usize> {
        self.signs
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

    /// Whether the map ends anywhere where it is free, and that is taken for wall.
    pub(super) fn has_open_edge(&self) -> bool {
        !self.open_edge.is_empty()
    }

    /// Whether the cell with an index is wall, and not merely where the map ends.
    pub(super) fn is_seen_wall(&self, index: usize) -> bool {
        self.is_wall(index) && !self.open_edge.contains(&index)
    }

    /// What there is where a region has no wall.
    pub(super) fn end(&self) -> End {
        if self.is_all_wall() { End::OfMap } else { End::Unseen }
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
        edge(grid.lattice()).for_each(|cell| settled.set(cell, Occupancy::Occupied));
        settled
    }
}

/// The outermost cells; those in the corners twice.
fn edge(lattice: &Lattice) -> impl Iterator<Item = Cell> + use<> {
    let (width, height) = (lattice.width(), lattice.height());
    let columns = (0..width).flat_map(move |column| [(column, 0), (column, height - 1)]);
    let rows = (0..height).flat_map(move |row| [(0, row), (width - 1, row)]);
    columns.chain(rows).map(|(column, row)| Cell { column, row })
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
