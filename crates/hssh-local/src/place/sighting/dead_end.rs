//! Dead ends: neighborhoods with one way out and walls all around.

use nalgebra::{Vector2, vector};

use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::place::PlaceOptions;
use crate::skeleton::FreeSpace;

/// A point is about as wide as the widest one if it has this part of its clearance.
const ABOUT_AS_WIDE: f64 = 0.9;

/// The center of a dead end: of the points in its `pocket` with most room, the innermost. The only way out
/// leads in the direction `outward`. `None` if an opening through which a robot would fit leads to where
/// nothing was seen: then nobody knows whether the way goes on.
pub(super) fn dead_end(
    grid: &OccupancyGrid,
    free: &FreeSpace,
    pocket: &[Cell],
    outward: Vector2<f64>,
    options: &PlaceOptions,
) -> Option<Vector2<f64>> {
    let lattice = grid.lattice();
    let is_open = |&&cell: &&Cell| {
        is_at_edge(lattice, free, cell)
            && free.field().nearest(cell).is_some_and(|obstacle| grid.get(obstacle) == Occupancy::Unknown)
    };
    let opening = pocket.iter().filter(is_open).count() as f64 * lattice.resolution();
    if opening >= options.skeleton.narrowest_passage {
        return None;
    }
    let room = |cell: Cell| free.field().clearance(cell);
    let most = pocket.iter().map(|&cell| room(cell)).fold(0.0, f64::max);
    let middle = |&cell: &Cell| {
        let [x, y] = lattice.center(cell);
        vector![x, y]
    };
    let wide = pocket.iter().filter(|&&cell| room(cell) >= ABOUT_AS_WIDE * most).map(middle);
    wide.min_by(|a, b| a.dot(&outward).total_cmp(&b.dot(&outward)))
}

/// Whether a robot's middle cannot go on from here in some direction.
fn is_at_edge(lattice: &Lattice, free: &FreeSpace, cell: Cell) -> bool {
    lattice.side_neighbors(cell).any(|near| !free.contains(near))
}
