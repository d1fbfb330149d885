//! What a neighborhood looks like from where the robot is: its ways out, and whether it is a place.

use hssh_metrics::wrap_angle;
use nalgebra::{Vector2, vector};

use super::center::center;
use super::geodesic::Geodesic;
use super::options::PlaceOptions;
use super::ways::{WayOut, ways_out};
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::skeleton::{FreeSpace, SkeletonParameters};

/// A neighborhood as seen in a local map.
#[derive(Clone, PartialEq, Debug)]
pub struct Sighting {
    /// Where the axes of the ways out meet, in the frame of the grid.
    pub center: Vector2<f64>,
    /// How far the free disc around the neighborhood's middle reaches, in metres.
    pub clearance: f64,
    /// The ways out, in no particular order.
    pub ways: Vec<WayOut>,
    /// Whether there is a choice or a turn: anything but a way on and a way back.
    pub is_place: bool,
}

/// Looks at the neighborhood of a point in metres. `None` if no robot fits there.
#[must_use]
pub fn sight(grid: &OccupancyGrid, from: Vector2<f64>, options: &PlaceOptions) -> Option<Sighting> {
    let parameters = SkeletonParameters {
        clutter: options.clutter,
        narrowest_passage: options.narrowest_way,
        ..SkeletonParameters::default()
    };
    let free = FreeSpace::new(&without_gaps(grid, options.gap), &parameters);
    let lattice = grid.lattice();
    let start = nearest_free(lattice, &free, from)?;
    let middle = widest(lattice, &free, start, options.climb);
    let clearance = free.field().clearance(middle);
    let border = clearance + options.margin;
    let distances = Geodesic::new(lattice, middle, border + options.depth, |cell| free.contains(cell));
    let ways = ways_out(lattice, &distances, border, options);
    let [x, y] = lattice.center(middle);
    let center = center(ways.iter().map(|way| way.axis), vector![x, y]);
    let is_near = (center - from).norm() < options.arrival + clearance;
    let is_place = is_near && is_place(&ways, options);
    Some(Sighting { center, clearance, ways, is_place })
}

/// A way on and a way back make a path; nothing at all is no place either.
fn is_place(ways: &[WayOut], options: &PlaceOptions) -> bool {
    match ways {
        [] | [_] => false,
        [one, other] => {
            let turn = wrap_angle(one.gateway.bearing - other.gateway.bearing - std::f64::consts::PI);
            turn.abs() > options.straight
        }
        _ => true,
    }
}

/// The grid with what was not seen taken for free within `gap` metres of free cells.
fn without_gaps(grid: &OccupancyGrid, gap: f64) -> OccupancyGrid {
    let lattice = *grid.lattice();
    let to_free = DistanceField::new(lattice, |index| grid.cells()[index] == Occupancy::Free);
    let filled = lattice.cells().map(|cell| match grid.get(cell) {
        Occupancy::Unknown if to_free.clearance(cell) <= gap => Occupancy::Free,
        known => known,
    });
    OccupancyGrid::new(lattice, filled.collect()).expect("there is one cell for each cell of the grid")
}

/// The cell nearest to a point in which a robot fits, no farther than a metre away.
fn nearest_free(lattice: &Lattice, free: &FreeSpace, from: Vector2<f64>) -> Option<Cell> {
    let here = lattice.cell_at([from.x, from.y])?;
    let reach = (1.0 / lattice.resolution()).ceil() as i32;
    let around = (-reach..=reach).flat_map(|rows| (-reach..=reach).map(move |columns| (columns, rows)));
    let near = around.filter_map(|(columns, rows)| {
        Some((columns.pow(2) + rows.pow(2), lattice.step(here, columns, rows)?))
    });
    near.filter(|&(_, cell)| free.contains(cell)).min_by_key(|&(squared, _)| squared).map(|(_, cell)| cell)
}

/// The cell with the most room around it within `reach` metres of travel: the thesis's maximum of the
/// medial axis.
fn widest(lattice: &Lattice, free: &FreeSpace, start: Cell, reach: f64) -> Cell {
    let near = Geodesic::new(lattice, start, reach, |cell| free.contains(cell));
    let cells = lattice.cells().filter(|&cell| near.distance(cell).is_some());
    let room = |cell: Cell| free.field().clearance(cell);
    cells.reduce(|best, cell| if room(cell) > room(best) { cell } else { best }).unwrap_or(start)
}
