//! Hill-climbing: to the point of a place that is farthest from all that is around (section 2.1.1).

use std::f64::consts::TAU;

use super::{Command, Handling, Percept};

/// Directions that are tried from a point.
const DIRECTIONS: u32 = 16;
/// The first and the last length of a step, in metres.
const STEPS: (f64, f64) = (0.4, 0.02);
/// The least speed of an approach, metres per second.
const CREEP: f64 = 0.05;

/// Where the distinctiveness measure, the distance to the nearest obstacle, is greatest: there a robot is as
/// far from one obstacle as from others on all sides. In the robot's frame.
pub(super) fn summit(percept: &Percept, handling: &Handling) -> [f64; 2] {
    let (mut at, mut height) = ([0.0, 0.0], percept.clearance_at([0.0, 0.0]));
    let mut step = STEPS.0;
    while step >= STEPS.1 {
        let around = (0..DIRECTIONS).map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(DIRECTIONS)).sin_cos();
            [at[0] + step * cos, at[1] + step * sin]
        });
        let within = around.filter(|[x, y]| x.hypot(*y) <= handling.climb);
        let heights = within.map(|point| (percept.clearance_at(point), point));
        match heights.reduce(|best, other| if other.0 > best.0 { other } else { best }) {
            Some((higher, point)) if higher > height => (at, height) = (point, higher),
            _ => step /= 2.0,
        }
    }
    at
}

/// Goes to the summit, and ever slower.
pub(super) fn climb(percept: &Percept, handling: &Handling) -> Command {
    let [x, y] = summit(percept, handling);
    let distance = x.hypot(y);
    if distance <= handling.centered {
        return Command::REST;
    }
    let room = percept.ahead(handling.radius + handling.margin) - handling.radius - handling.margin;
    let speed = handling.speed.min(distance).min(room);
    // What is close behind is reached backward.
    if x < 0.0 && distance < 2.0 * handling.radius {
        let back = Command::toward([-x, -y], handling.speed.min(distance), handling);
        return Command { speed: -back.speed, turn: back.turn };
    }
    Command::toward([x, y], speed.max(CREEP), handling)
}
