//! How probably a passage has a door: by its width, by the wall that it is in, and by what it parts.

use super::ground::Ground;
use super::options::DoorwayOptions;
use crate::place::Gateway;

/// Metres from one sample to the next.
const STEP: f64 = 0.05;

/// The probability that a passage has a door; `narrower` is the width of the narrower of the regions it joins.
pub(super) fn door_probability(
    gateway: &Gateway,
    narrower: f64,
    ground: &Ground,
    options: &DoorwayOptions,
) -> f64 {
    let odds = options.base
        + options.room * (narrower / options.room_width).min(1.0).ln()
        + options.wall * wall_beside(gateway, ground, options)
        + options.way * way_through(gateway, ground, options)
        - options.excess * (gateway.width - options.widest_leaf).max(0.0);
    1.0 / (1.0 + (-odds).exp())
}

/// The part of the line beyond an end of the gateway that is wall, at the end where it is more.
fn wall_beside(gateway: &Gateway, ground: &Ground, options: &DoorwayOptions) -> f64 {
    let ahead = [gateway.bearing.cos(), gateway.bearing.sin()];
    let left = [-ahead[1], ahead[0]];
    let offsets = || steps(-options.tolerance, options.tolerance);
    let covered = |end: [f64; 2], side: f64| {
        let is_wall = |along: &f64| {
            offsets().any(|off| ground.is_wall_at(moved(moved(end, left, side * along), ahead, off)))
        };
        let all = steps(STEP, options.beside).count();
        steps(STEP, options.beside).filter(is_wall).count() as f64 / all as f64
    };
    covered(gateway.line[0], 1.0).max(covered(gateway.line[1], -1.0))
}

/// The part of the way straight through that is free, on the side where it is less.
fn way_through(gateway: &Gateway, ground: &Ground, options: &DoorwayOptions) -> f64 {
    let ahead = [gateway.bearing.cos(), gateway.bearing.sin()];
    let left = [-ahead[1], ahead[0]];
    let free = |direction: f64| {
        let points: Vec<[f64; 2]> = steps(2.0 * STEP, options.through)
            .flat_map(|along| [-options.half_leaf, 0.0, options.half_leaf].map(|off| (along, off)))
            .map(|(along, off)| moved(moved(gateway.position, ahead, direction * along), left, off))
            .collect();
        points.iter().filter(|&&point| !ground.is_obstacle_at(point)).count() as f64 / points.len() as f64
    };
    free(1.0).min(free(-1.0))
}

/// Numbers from one to another, a step apart.
fn steps(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / STEP).round() as u32;
    (0..=count).map(move |step| from + f64::from(step) * STEP)
}

fn moved(from: [f64; 2], direction: [f64; 2], by: f64) -> [f64; 2] {
    [from[0] + by * direction[0], from[1] + by * direction[1]]
}
