//! What a neighborhood looks like from where the robot is: its ways out, and whether it is a place.

use std::collections::BTreeSet;

use nalgebra::{Vector2, vector};

use super::center::center;
use super::dead_end::dead_end;
use super::ways::ways_out;
use crate::geodesic::Geodesic;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
use crate::place::local_path::is_straight;
use crate::place::{Gateway, LocalStar, PlaceOptions};
use crate::skeleton::FreeSpace;

/// A place is looked at again at most so often.
const MOST_LOOKS: usize = 8;

/// A neighborhood as seen in a local map.
#[derive(Clone, PartialEq, Debug)]
pub struct Sighting {
    /// Where the axes of the ways out meet, in the frame of the grid.
    pub center: Vector2<f64>,
    /// How far the free disc around the neighborhood's middle reaches, in metres.
    pub clearance: f64,
    /// The gateways of the ways out, in no particular order.
    pub gateways: Vec<Gateway>,
    /// Whether there is a choice, a turn or an end: anything but a way on and a way back.
    pub is_place: bool,
}

impl Sighting {
    /// The star of the gateways; `None` if there are none.
    #[must_use]
    pub fn star(&self, options: &PlaceOptions) -> Option<LocalStar> {
        LocalStar::new(self.center.into(), &self.gateways, options)
    }
}

/// Looks at the neighborhood of a point in metres. `None` if no robot fits there.
///
/// What looks like a place is looked at again from the center that it seems to have, until the center stays
/// where it is: from the corridor before a corner, the way around the corner points aside, and only from the
/// corner itself does it show its axis. So a place has the same center from wherever it is sighted, as the
/// distinctive state of hill-climbing would be (section 2.1.1).
#[must_use]
pub fn sight(grid: &OccupancyGrid, from: Vector2<f64>, options: &PlaceOptions) -> Option<Sighting> {
    let grid = without_gaps(grid, options.gap);
    let free = FreeSpace::new(&grid, &options.skeleton);
    let mut here = nearest_free(grid.lattice(), &free, from)?;
    let (mut sighting, mut inside) = look_from(&grid, &free, here, options);
    for _ in 0..MOST_LOOKS {
        if !sighting.is_place || inside == here {
            break;
        }
        here = inside;
        (sighting, inside) = look_from(&grid, &free, here, options);
    }
    sighting.is_place &= (sighting.center - from).norm() < options.arrival + sighting.clearance;
    Some(sighting)
}

/// The neighborhood as it looks from one cell, and its cell that is nearest to its center.
fn look_from(
    grid: &OccupancyGrid,
    free: &FreeSpace,
    start: Cell,
    options: &PlaceOptions,
) -> (Sighting, Cell) {
    let lattice = grid.lattice();
    let middle = widest(lattice, free, start, options.climb);
    let clearance = free.field().clearance(middle);
    let border = clearance + options.margin;
    let distances = Geodesic::new(lattice, middle, border + options.depth(), |cell| free.contains(cell));
    let ways = ways_out(free, &distances, border, options);
    let [x, y] = lattice.center(middle);
    let crossing = center(ways.iter().map(|way| way.axis), vector![x, y]);
    let gateways: Vec<Gateway> = ways.iter().map(|way| way.gateway).collect();
    let place = match &ways[..] {
        [] => None,
        [only] => {
            let is_way: BTreeSet<Cell> = only.cells.iter().copied().collect();
            let pocket = distances.reached().iter().filter(|cell| !is_way.contains(cell));
            let pocket: Vec<Cell> = pocket.copied().collect();
            dead_end(grid, free, &pocket, only.axis.direction, options)
        }
        [one, other] => (!is_straight(&one.gateway, &other.gateway, options)).then_some(crossing),
        _ => Some(crossing),
    };
    let center = place.unwrap_or(crossing);
    let off = |cell: Cell| {
        let [x, y] = lattice.center(cell);
        (center - vector![x, y]).norm_squared()
    };
    let near = distances.reached().iter().copied();
    let inside = near
        .take_while(|&cell| distances.distance(cell).is_some_and(|distance| distance <= border))
        .min_by(|&a, &b| off(a).total_cmp(&off(b)));
    let is_place = place.is_some();
    (Sighting { center, clearance, gateways, is_place }, inside.unwrap_or(middle))
}

/// The grid with what was not seen taken for free within `gap` metres of free cells.
fn without_gaps(grid: &OccupancyGrid, gap: f64) -> OccupancyGrid {
    let lattice = *grid.lattice();
    // From the middle of a free cell to that of an unknown one: so far that `gap` is left between their sides.
    let reach = gap / lattice.resolution() + 0.5;
    let cells = reach as i32;
    let around: Vec<(i32, i32)> = (-cells..=cells)
        .flat_map(|rows| (-cells..=cells).map(move |columns| (columns, rows)))
        .filter(|&(columns, rows)| f64::from(columns).hypot(f64::from(rows)) <= reach)
        .collect();
    let mut filled = grid.clone();
    for cell in lattice.cells().filter(|&cell| grid.get(cell) == Occupancy::Free) {
        for near in around.iter().filter_map(|&(columns, rows)| lattice.step(cell, columns, rows)) {
            if grid.get(near) == Occupancy::Unknown {
                filled.set(near, Occupancy::Free);
            }
        }
    }
    filled
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
    let room = |cell: Cell| free.field().clearance(cell);
    let cells = near.reached().iter().copied();
    cells.reduce(|best, cell| if room(cell) > room(best) { cell } else { best }).unwrap_or(start)
}
