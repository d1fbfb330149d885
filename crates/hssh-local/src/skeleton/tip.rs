//! What is before the axis where it stops: a wall, unknown space, or the border of the grid.

use super::graph::{AxisPoint, Tip, distances};
use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};

/// A wall counts even this many cells behind the first cell that is not free: its face is often unsure.
const WALL_FACE: u32 = 3;

/// A way that was seen up to a slanting line is tapered for at most this many times its half width.
const LONGEST_TAPER: f64 = 4.0;

/// Directions looked at, in degrees from straight on.
const FAN: [f64; 9] = [-40.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0];

/// What is before the first point of a line, given the points of the line from there on: what a fan
/// of rays from the first point away from the others meets. It is a wall only if two thirds of them say so.
pub(super) fn tip(points: &[AxisPoint], grid: &OccupancyGrid, field: &DistanceField) -> Tip {
    let lattice = field.lattice();
    let tip = points[0];
    let back = (tip.clearance / lattice.resolution()).ceil() as usize;
    let inner = points[back.clamp(1, points.len() - 1)];
    let ahead = [tip.point[0] - inner.point[0], tip.point[1] - inner.point[1]];
    let direction = ahead[1].atan2(ahead[0]);
    let reach = 2.0 * tip.clearance + 4.0 * lattice.resolution();
    let mut met = [0_u32; 3];
    for degrees in FAN {
        let angle = direction + degrees.to_radians();
        if let Some(tip) = first_met(tip.point, [angle.cos(), angle.sin()], reach, grid, field) {
            met[tip as usize] += 1;
        }
    }
    let [wall, frontier, border] = met;
    if wall >= 2 * (frontier + border) {
        Tip::Wall
    } else if frontier >= border {
        Tip::Frontier
    } else {
        Tip::Border
    }
}

/// Cuts off the beginning of a line that ends before unknown space or at the border, as far as unknown
/// cells are nearest to it or its free disc is not all on the grid: there the line follows the edge of
/// what was seen, and not the way.
pub(super) fn cut_taper(points: &mut Vec<AxisPoint>, grid: &OccupancyGrid, field: &DistanceField) {
    let lattice = field.lattice();
    let is_beside_unknown = |point: &AxisPoint| {
        let around = lattice.side_neighbors(point.cell).chain([point.cell]);
        let mut nearest = around.filter_map(|cell| field.nearest(cell));
        nearest.any(|cell| grid.get(cell) == Occupancy::Unknown)
    };
    let leaves_grid = |point: &AxisPoint| {
        let [x, y] = point.point;
        let reach = point.clearance;
        let edges = [[x - reach, y], [x + reach, y], [x, y - reach], [x, y + reach]];
        edges.into_iter().any(|edge| lattice.cell_at(edge).is_none())
    };
    let along = distances(points);
    let is_sure = |&at: &usize| !is_beside_unknown(&points[at]) && !leaves_grid(&points[at]);
    let begins = (0..points.len()).find(is_sure).unwrap_or(0);
    let longest = LONGEST_TAPER * points[begins].clearance;
    if begins + 1 < points.len() && along[begins] <= longest {
        points.drain(..begins);
    }
}

/// What a ray from a point meets within `reach` metres; nothing if it is free all along. Obstacles that
/// were taken for clutter do not count.
fn first_met(
    from: [f64; 2],
    direction: [f64; 2],
    reach: f64,
    grid: &OccupancyGrid,
    field: &DistanceField,
) -> Option<Tip> {
    let step = grid.lattice().resolution() / 2.0;
    let cell_at = |count: u32| {
        let along = f64::from(count) * step;
        grid.lattice().cell_at([from[0] + along * direction[0], from[1] + along * direction[1]])
    };
    for count in 0..=(reach / step) as u32 {
        let Some(cell) = cell_at(count) else { return Some(Tip::Border) };
        if field.squared_cells(cell) == Some(0) {
            let mut face = (count..=count + 2 * WALL_FACE).filter_map(cell_at);
            let is_wall = face.any(|cell| grid.get(cell) == Occupancy::Occupied);
            return Some(if is_wall { Tip::Wall } else { Tip::Frontier });
        }
    }
    None
}
