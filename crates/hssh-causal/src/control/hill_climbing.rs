//! Hill-climbing: to the center of a place that the local model shows, or to the point that is farthest from all
//! that is around (section 2.1.1).

use std::f64::consts::TAU;

use super::trajectory::toward;
use super::view::View;
use super::{Command, Handling, Percept};

/// Directions that are tried from a point.
const DIRECTIONS: u32 = 16;
/// Metres between the points that are compared first, so that no bump of the measure is taken for its summit.
const SURVEY_STEP: f64 = 0.2;
/// The last length of a step, in metres.
const LAST_STEP: f64 = 0.02;
/// The least speed of an approach, metres per second.
const CREEP: f64 = 0.05;

/// Where the distinctiveness measure is greatest, in the robot's frame: at the center of the place that the local
/// perceptual model shows, if the robot sees that there is room for it (section 2.2: such a model saves the robot
/// the search). Else the measure is the distance to the nearest obstacle, and at its greatest a robot is as far from
/// one obstacle as from others on all sides.
pub(super) fn summit(percept: &Percept, handling: &Handling) -> [f64; 2] {
    let view = View::new(percept);
    let center = percept.neighborhood.as_ref().and_then(|here| here.center);
    if let Some(center) = center.filter(|&at| view.clearance_at(at) > handling.radius + handling.margin) {
        return center;
    }
    let circles = (1..=(handling.climb / SURVEY_STEP) as u32).map(|k| f64::from(k) * SURVEY_STEP);
    let within_reach = circles.flat_map(|radius| around([0.0, 0.0], radius));
    let (mut height, mut at) = highest(&view, std::iter::once([0.0, 0.0]).chain(within_reach));
    let mut step = SURVEY_STEP / 2.0;
    while step >= LAST_STEP {
        let (higher, point) = highest(&view, around(at, step));
        if higher > height {
            (height, at) = (higher, point);
        } else {
            step /= 2.0;
        }
    }
    at
}

/// Points on a circle.
fn around(center: [f64; 2], radius: f64) -> impl Iterator<Item = [f64; 2]> {
    (0..DIRECTIONS).map(move |k| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(DIRECTIONS)).sin_cos();
        [center[0] + radius * cos, center[1] + radius * sin]
    })
}

/// The first of the points with the greatest clearance, which comes first.
fn highest(view: &View, points: impl Iterator<Item = [f64; 2]>) -> (f64, [f64; 2]) {
    let heights = points.map(|point| (view.clearance_at(point), point));
    heights.fold((0.0, [0.0, 0.0]), |best, other| if other.0 > best.0 { other } else { best })
}

/// Goes to the summit, around what is in the way, and ever slower.
pub(super) fn climb(percept: &Percept, handling: &Handling) -> Command {
    let [x, y] = summit(percept, handling);
    let (distance, bearing) = (x.hypot(y), y.atan2(x));
    if distance <= handling.centered {
        return Command::REST;
    }
    let room = percept.ahead(handling.radius + handling.margin) - handling.radius - handling.margin;
    if bearing.abs() <= handling.widest_curve && room < handling.look_ahead.min(distance) {
        return toward(percept, bearing, handling);
    }
    let speed = handling.speed.min(distance).min(room);
    Command::toward([x, y], speed.max(CREEP), handling)
}
