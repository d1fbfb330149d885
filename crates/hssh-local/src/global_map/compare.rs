//! How far the walls of one map are from those of another.

use hssh_metrics::Pose;
use nalgebra::vector;

use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};

/// The mean distance in metres from the occupied cells of a map to the nearest occupied cell of a
/// reference, of those that fall onto the reference. `placed` is the frame of the map in the frame of
/// the reference. `None` if no such cell does.
#[must_use]
pub fn mean_wall_distance(map: &OccupancyGrid, reference: &OccupancyGrid, placed: Pose) -> Option<f64> {
    let lattice = *reference.lattice();
    let to_wall = DistanceField::new(lattice, |index| reference.cells()[index] == Occupancy::Occupied);
    let walls = map.lattice().cells().filter(|&cell| map.get(cell) == Occupancy::Occupied);
    let distances: Vec<f64> = walls
        .filter_map(|cell| {
            let [x, y] = map.lattice().center(cell);
            let point = placed.translation() + placed.rotation() * vector![x, y];
            lattice.cell_at([point.x, point.y]).map(|cell| to_wall.clearance(cell))
        })
        .filter(|distance| distance.is_finite())
        .collect();
    (!distances.is_empty()).then(|| distances.iter().sum::<f64>() / distances.len() as f64)
}
