//! Gateways: a line between the nearest obstacles on both sides of a way, where the way out of a place narrows
//! (section 2.2.2, third definition).

use std::ops::Range;

use nalgebra::{Vector2, vector};

use super::GatewayOptions;
use crate::distance::DistanceField;
use crate::grid::Cell;
use crate::skeleton::{AxisPoint, distances};

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

impl Gateway {
    /// The gateway of a width across a way at a point, for somebody who leaves in a direction of length 1.
    pub(crate) fn across(position: [f64; 2], direction: Vector2<f64>, width: f64) -> Self {
        let left = vector![-direction.y, direction.x] * (width / 2.0);
        let at = Vector2::from(position);
        let line = [at + left, at - left].map(|end| [end.x, end.y]);
        Gateway { position, bearing: direction.y.atan2(direction.x), width, line }
    }
}

impl Gateway {
    /// The same line for somebody who comes the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let bearing = hssh_metrics::wrap_angle(self.bearing + std::f64::consts::PI);
        let [left, right] = self.line;
        Gateway { bearing, line: [right, left], ..*self }
    }
}

/// The position of a place's gateway in a way out: of the points in `range`, the first that is about as narrow as
/// the narrowest.
pub(super) fn gateway_position(way: &[AxisPoint], range: Range<usize>, options: &GatewayOptions) -> usize {
    let narrowest = way[range.clone()].iter().map(|point| point.clearance).fold(f64::INFINITY, f64::min);
    let limit = narrowest * (1.0 + options.as_narrow);
    let first = range.start;
    range.into_iter().find(|&at| way[at].clearance <= limit).unwrap_or(first)
}

/// The gateway on a way out along the medial axis: `way` starts at the place, `clearance` is that of its center
/// and `start` how far along the way a gateway may be at the earliest. Where the way still narrows at the end of
/// the reach, it is looked for until it does not. Also its position in the way.
pub(super) fn gateway_on(
    way: &[AxisPoint],
    clearance: f64,
    start: f64,
    field: &DistanceField,
    options: &GatewayOptions,
) -> (usize, Gateway) {
    let along = distances(way);
    let total = along[along.len() - 1];
    let first = along.partition_point(|&at| at < start.min(total / 2.0)).min(way.len() - 1);
    let reach = start.max(options.reach * clearance) + options.reach_beyond;
    let mut end = along.partition_point(|&at| at <= reach).max(first + 1);
    while end < way.len() && way[end].clearance < way[end - 1].clearance {
        end += 1;
    }
    let at = gateway_position(way, first..end, options);
    (at, gateway_at(&way[at], bearing(way, &along, at, options), field))
}

/// The direction of the way from one of its points on, in radians.
pub(super) fn bearing(way: &[AxisPoint], along: &[f64], at: usize, options: &GatewayOptions) -> f64 {
    let aim = options.aim.max(2.0 * way[at].clearance);
    let ahead = along.partition_point(|&here| here < along[at] + aim).min(way.len() - 1);
    let behind = if along[ahead] - along[at] < aim / 2.0 {
        along.partition_point(|&here| here < along[ahead] - aim / 2.0)
    } else {
        at
    };
    let [from, to] = [way[behind].point, way[ahead].point];
    (to[1] - from[1]).atan2(to[0] - from[0])
}

/// The gateway across the middle line of a way at one of its points, leaving with `bearing`.
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
