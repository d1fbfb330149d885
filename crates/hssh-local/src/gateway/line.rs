//! A gateway as a line across the medial axis, between the nearest obstacles on its two sides.

use crate::distance::DistanceField;
use crate::grid::Cell;
use crate::skeleton::AxisPoint;

/// How many cells around a point of the axis are asked for their nearest obstacles.
const AROUND: i32 = 2;

/// Where one leaves a place: a line between two obstacles. Metres and radians in the frame of the grid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gateway {
    /// Where the medial axis crosses it.
    pub position: [f64; 2],
    /// The outward direction, counterclockwise from the x axis, from −π to π.
    pub bearing: f64,
    /// How wide it is between the obstacles.
    pub width: f64,
    /// Its two ends, the one to the left of somebody who leaves first.
    pub line: [[f64; 2]; 2],
}

/// The gateway across a line of the axis at one of its points, leaving with `bearing`.
pub(crate) fn gateway_at(at: &AxisPoint, bearing: f64, field: &DistanceField) -> Gateway {
    let [left, right] = sides(at, bearing, field);
    let across = [left[0] - right[0], left[1] - right[1]];
    let between = across[0].hypot(across[1]);
    let width = (between - field.lattice().resolution()).max(0.0);
    Gateway { position: at.point, bearing, width, line: [left, right] }
}

/// The nearest obstacles to the left and to the right of a point on the axis. If one side has none, it
/// is taken to be as far away as the other.
fn sides(at: &AxisPoint, bearing: f64, field: &DistanceField) -> [[f64; 2]; 2] {
    let lattice = field.lattice();
    let ahead = [bearing.cos(), bearing.sin()];
    let mut nearest: [Option<(f64, [f64; 2])>; 2] = [None; 2];
    for (columns, rows) in
        (-AROUND..=AROUND).flat_map(|rows| (-AROUND..=AROUND).map(move |columns| (columns, rows)))
    {
        let Some(site) = lattice.step(at.cell, columns, rows).and_then(|cell: Cell| field.nearest(cell))
        else {
            continue;
        };
        let site = lattice.center(site);
        let toward = [site[0] - at.point[0], site[1] - at.point[1]];
        let side = usize::from(ahead[0] * toward[1] - ahead[1] * toward[0] < 0.0);
        let away = toward[0].hypot(toward[1]);
        if nearest[side].is_none_or(|(least, _)| away < least) {
            nearest[side] = Some((away, site));
        }
    }
    let mirrored = |site: [f64; 2]| [2.0 * at.point[0] - site[0], 2.0 * at.point[1] - site[1]];
    match nearest.map(|side| side.map(|(_, site)| site)) {
        [Some(left), Some(right)] => [left, right],
        [Some(left), None] => [left, mirrored(left)],
        [None, Some(right)] => [mirrored(right), right],
        [None, None] => [at.point; 2],
    }
}
