//! Floor plans: worlds built of corridors with walls, as occupancy grids.

use hssh_local::{Cell, DistanceField, Lattice, LatticeError, Occupancy, OccupancyGrid};

use crate::geometry::Point;
use crate::world::World;

/// How thick walls are, in metres; what is behind them is unknown.
const WALL: f64 = 0.3;

/// Why a world cannot be built.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum FloorPlanError {
    /// Corridors without a width.
    #[error("corridors must be a positive number of metres wide, not {0}")]
    Width(f64),
    /// Too large or too fine, or no resolution.
    #[error("the floor plan is no grid: {0}")]
    Lattice(#[from] LatticeError),
}

/// The world's links as corridors `width` metres wide, in cells of `resolution` metres; the frame is the world's.
///
/// Corridors are free and have walls on both sides, unknown is what no corridor comes near. Dead ends and the
/// outer sides of corners are round.
///
/// # Errors
/// If the width or the resolution is not positive, or the plan has too many cells.
pub fn floor_plan(world: &World, width: f64, resolution: f64) -> Result<OccupancyGrid, FloorPlanError> {
    if !(width.is_finite() && width > 0.0) {
        return Err(FloorPlanError::Width(width));
    }
    let pieces = pieces(world);
    let mut free = OccupancyGrid::filled(lattice(&pieces, width, resolution)?, Occupancy::Unknown);
    for piece in &pieces {
        dig(&mut free, *piece, width / 2.0);
    }
    let lattice = *free.lattice();
    let to_corridor = DistanceField::new(lattice, |index| free.cells()[index] == Occupancy::Free);
    let built = lattice.cells().map(|cell| match free.get(cell) {
        Occupancy::Unknown if to_corridor.clearance(cell) < WALL => Occupancy::Occupied,
        known => known,
    });
    Ok(OccupancyGrid::new(lattice, built.collect()).expect("there is one cell for each cell of the lattice"))
}

/// All straight pieces of the links; of a place without links the place itself.
fn pieces(world: &World) -> Vec<[Point; 2]> {
    let mut pieces: Vec<[Point; 2]> = world.places().iter().map(|place| [place.position; 2]).collect();
    for link in world.links() {
        if let Some(way) = world.way(link.ends[0]) {
            pieces.extend(way.windows(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    pieces
}

/// A lattice that holds all corridors with their walls, and a cell to spare.
fn lattice(pieces: &[[Point; 2]], width: f64, resolution: f64) -> Result<Lattice, LatticeError> {
    let margin = width / 2.0 + WALL + resolution;
    let points = || pieces.iter().flatten();
    let low = points().fold([f64::INFINITY; 2], |[x, y], point| [x.min(point.x), y.min(point.y)]);
    let high = points().fold([f64::NEG_INFINITY; 2], |[x, y], point| [x.max(point.x), y.max(point.y)]);
    let count = |axis: usize| ((high[axis] - low[axis] + 2.0 * margin) / resolution).ceil() as u32;
    Lattice::new(count(0), count(1), resolution, low.map(|least| least - margin))
}

/// Frees the cells whose middles are within `reach` of a piece.
fn dig(grid: &mut OccupancyGrid, [from, to]: [Point; 2], reach: f64) {
    let lattice = *grid.lattice();
    let corner = |x: f64, y: f64| lattice.cell_at([x, y]);
    let low = corner(from.x.min(to.x) - reach, from.y.min(to.y) - reach);
    let high = corner(from.x.max(to.x) + reach, from.y.max(to.y) + reach);
    let (Some(low), Some(high)) = (low, high) else { return };
    for row in low.row..=high.row {
        for column in low.column..=high.column {
            let cell = Cell { column, row };
            let [x, y] = lattice.center(cell);
            if distance(Point::new(x, y), from, to) <= reach {
                grid.set(cell, Occupancy::Free);
            }
        }
    }
}

/// From a point to a piece of a line.
fn distance(point: Point, from: Point, to: Point) -> f64 {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let squared = dx * dx + dy * dy;
    let along = ((point.x - from.x) * dx + (point.y - from.y) * dy) / squared.max(f64::MIN_POSITIVE);
    let along = along.clamp(0.0, 1.0);
    point.distance_to(Point::new(from.x + along * dx, from.y + along * dy))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{grid, random_planar};

    #[test]
    fn corridors_are_as_wide_as_asked_for_and_have_walls() {
        let plan = floor_plan(&grid(2, 2, 10.0).unwrap(), 2.0, 0.1).unwrap();
        for (y, occupancy) in [
            (0.0, Occupancy::Free),
            (0.95, Occupancy::Free),
            (-0.95, Occupancy::Free),
            (1.1, Occupancy::Occupied),
            (-1.1, Occupancy::Occupied),
            (-5.0, Occupancy::Unknown),
        ] {
            assert_eq!(plan.at([5.0, y]), occupancy, "at {y}");
        }
    }

    #[test]
    fn every_way_can_be_walked_and_the_border_is_closed() {
        for seed in 0..5 {
            let world = random_planar(7, 0.4, 15.0, seed).unwrap();
            let plan = floor_plan(&world, 2.0, 0.1).unwrap();
            for gateway in world.gateways() {
                for pair in world.way(gateway).unwrap().windows(2) {
                    let cell = |point: Point| plan.lattice().cell_at([point.x, point.y]).unwrap();
                    assert_eq!(plan.first_blocked(cell(pair[0]), cell(pair[1])), None);
                }
            }
            let (width, height) = (plan.lattice().width(), plan.lattice().height());
            let is_border = |cell: &Cell| {
                cell.column == 0 || cell.row == 0 || cell.column + 1 == width || cell.row + 1 == height
            };
            assert!(plan.lattice().cells().filter(is_border).all(|cell| plan.get(cell) != Occupancy::Free));
        }
    }

    #[test]
    fn what_cannot_be_built_is_refused() {
        let world = grid(2, 2, 10.0).unwrap();
        assert_eq!(floor_plan(&world, -1.0, 0.1), Err(FloorPlanError::Width(-1.0)));
        let error = floor_plan(&world, 2.0, 0.0).unwrap_err().to_string();
        assert!(error.contains("no grid"), "{error}");
    }
}
