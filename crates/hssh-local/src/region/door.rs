//! How probably a passage has a door: by its width, by the wall that it is in, by what it parts, and by leaves that stand open.

use std::f64::consts::PI;

use super::ground::Ground;
use super::island::Islands;
use super::leaf::Leaf;
use super::options::DoorwayOptions;
use crate::place::Gateway;
use crate::skeleton::distance;

/// Metres from one sample to the next.
const STEP: f64 = 0.05;
/// So many directions to either side of the line are tried for a wall, ...
const TURNS: i32 = 4;
/// ... which are so many radians from one another: the ends of a passage are corners of jambs.
const TURN: f64 = PI / 36.0;

/// The probability that a passage has a door; `narrower` is the width of the narrower of the regions it joins.
pub(super) fn door_probability(
    gateway: &Gateway,
    narrower: f64,
    ground: &Ground,
    islands: &mut Islands<'_>,
    options: &DoorwayOptions,
) -> f64 {
    let leaves = leaves_in(gateway, ground, options);
    let odds = options.base
        + options.room * (narrower / options.room_width).min(1.0).ln()
        + options.wall * wall_beside(gateway, ground, options)
        + options.free_standing * islands.smaller(gateway.line).ln()
        + if leaves > 0.0 { options.leaf } else { 0.0 }
        - options.excess * (gateway.width - leaves.max(options.widest_leaf)).max(0.0);
    1.0 / (1.0 + (-odds).exp())
}

/// How long the leaves are together that stand open in a gateway: they hang at its ends, and would close it. 0 if there are none.
fn leaves_in(gateway: &Gateway, ground: &Ground, options: &DoorwayOptions) -> f64 {
    let hangs = |leaf: &&Leaf| gateway.line.into_iter().any(|end| distance(end, leaf.hinge) <= options.hinge);
    let lengths: f64 = ground.leaves().iter().filter(hangs).map(Leaf::length).sum();
    if (lengths - gateway.width).abs() <= options.leaf_fits * gateway.width { lengths } else { 0.0 }
}

/// The part of the line beyond an end of the gateway that is wall, at the end where it is more.
fn wall_beside(gateway: &Gateway, ground: &Ground, options: &DoorwayOptions) -> f64 {
    let [left, right] = gateway.line;
    let across = (left[1] - right[1]).atan2(left[0] - right[0]);
    covered(left, across, ground, options).max(covered(right, across + PI, ground, options))
}

/// The part of a line from a point in about a direction that is wall, in the direction where it is most.
fn covered(end: [f64; 2], direction: f64, ground: &Ground, options: &DoorwayOptions) -> f64 {
    let offsets = || steps(-options.tolerance, options.tolerance);
    let all = steps(STEP, options.beside).count() as f64;
    let part = |turn: i32| {
        let (sin, cos) = (direction + f64::from(turn) * TURN).sin_cos();
        let at = |along: f64, off: f64| [end[0] + along * cos - off * sin, end[1] + along * sin + off * cos];
        let is_wall = |along: &f64| offsets().any(|off| ground.is_wall_at(at(*along, off)));
        steps(STEP, options.beside).filter(is_wall).count() as f64 / all
    };
    (-TURNS..=TURNS).map(part).fold(0.0, f64::max)
}

/// Numbers from one to another, a step apart.
fn steps(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / STEP).round() as u32;
    (0..=count).map(move |step| from + f64::from(step) * STEP)
}
