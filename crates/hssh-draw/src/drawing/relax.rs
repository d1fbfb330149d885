//! Moving places apart that a schematic drawing puts on each other or on a link, while links keep as much
//! of their length and direction as they can.

use hssh_metrics::{Pose, wrap_angle};
use hssh_topology::{PlaceId, TopologicalMap};
use nalgebra::vector;

use super::spring::{Spring, misfits, position};
use super::unfold::unfolded;
use crate::svg::{Point, toward};

/// Places closer than that (in units of a link) push each other apart.
const PLACE_DISTANCE: f64 = 1.1;
/// A place closer than that to a link of others is pushed off it.
const LINK_DISTANCE: f64 = 0.5;
/// Places nearer than that make a drawing illegible.
const LEGIBLE_DISTANCE: f64 = 0.7;
/// So does a place farther than that from where a link wants it.
const LEGIBLE_MISFIT: f64 = 0.25;
/// Strength of pushing apart, relative to the pull of the links.
const REPULSION: f64 = 1.5;
/// Rounds of relaxation, for maps of up to [`LARGE`] places.
const ROUNDS: usize = 600;
const LARGE: usize = 200;

/// The poses, changed if they are illegible: gradient descent on the misfit of all links plus the overlap
/// of all that comes too close, from these poses and from the unfolded map. Of the two results the one
/// with fewer crossings is taken.
pub(super) fn set_apart(map: &TopologicalMap, ends: &[(PlaceId, f64)], mut poses: Vec<Pose>) -> Vec<Pose> {
    let springs: Vec<Spring> = map
        .links()
        .map(|(from, to)| Spring {
            from: map.place(from).index(),
            to: map.place(to).index(),
            leaving: ends[from.index()].1,
            entering: ends[to.index()].1,
        })
        .filter(|spring| spring.from != spring.to)
        .collect();
    if is_legible(&poses, &springs) {
        return poses;
    }
    scatter(&mut poses);
    let spread = relaxed(unfolded(&poses, &springs), &springs);
    let plain = relaxed(poses, &springs);
    let poses = if crossings(&spread, &springs) < crossings(&plain, &springs) { spread } else { plain };
    upright(&poses)
}

/// The poses after as many steps downhill as the size of the map allows.
fn relaxed(mut poses: Vec<Pose>, springs: &[Spring]) -> Vec<Pose> {
    let size = poses.len().max(LARGE) / LARGE;
    let rounds = (ROUNDS / (size * size)).max(50);
    for round in 0..rounds {
        // Long steps first, to get out of folds; short ones at the end, to come to rest.
        let step = 0.16 * (1.0 - 0.8 * round as f64 / rounds as f64);
        descend(&mut poses, springs, step);
    }
    poses
}

/// The same poses seen from the first one.
fn upright(poses: &[Pose]) -> Vec<Pose> {
    poses.iter().map(|&pose| poses[0].between(pose)).collect()
}

/// How many pairs of links cross when drawn straight.
fn crossings(poses: &[Pose], springs: &[Spring]) -> usize {
    let turn = |a: usize, b: usize, c: usize| {
        let (a, b, c) = (position(&poses[a]), position(&poses[b]), position(&poses[c]));
        (b - a).perp(&(c - a))
    };
    let parts = |spring: &Spring, a: usize, b: usize| {
        turn(spring.from, spring.to, a) * turn(spring.from, spring.to, b) < 0.0
    };
    let cross =
        |one: &Spring, other: &Spring| parts(one, other.from, other.to) && parts(other, one.from, one.to);
    let pairs = springs
        .iter()
        .enumerate()
        .flat_map(|(index, one)| springs[..index].iter().map(move |other| (one, other)));
    pairs.filter(|(one, other)| cross(one, other)).count()
}

fn is_legible(poses: &[Pose], springs: &[Spring]) -> bool {
    let apart = poses.iter().enumerate().all(|(index, pose)| {
        let far_from = |other: &Pose| (position(pose) - position(other)).norm() > LEGIBLE_DISTANCE;
        poses[..index].iter().all(far_from)
    });
    let fits = |spring: &Spring| {
        let (leaving, entering) = misfits(spring, poses);
        leaving.norm() < LEGIBLE_MISFIT && entering.norm() < LEGIBLE_MISFIT
    };
    apart && springs.iter().all(fits)
}

/// Moves every place a little, each in a direction of its own, so that no two are in one spot.
fn scatter(poses: &mut [Pose]) {
    /// The golden angle: multiples of it never come near each other.
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    for (index, pose) in poses.iter_mut().enumerate() {
        let offset = toward(GOLDEN_ANGLE * index as f64) * 0.05;
        *pose = Pose { x: pose.x + offset.x, y: pose.y + offset.y, ..*pose };
    }
}

/// One step downhill, for all places at once.
fn descend(poses: &mut [Pose], springs: &[Spring], step: f64) {
    let mut moves = vec![Point::zeros(); poses.len()];
    let mut turns = vec![(0.0, 0u32); poses.len()];
    pull(poses, springs, &mut moves, &mut turns);
    push_places(poses, &mut moves);
    push_off_links(poses, springs, &mut moves);
    for ((pose, motion), (turn, links)) in poses.iter_mut().zip(&moves).zip(turns) {
        let length = motion.norm();
        let motion = motion * step * if length > 2.0 { 2.0 / length } else { 1.0 };
        let turn = if links == 0 { 0.0 } else { 3.0 * step * turn / f64::from(links) };
        *pose = Pose::new(pose.x + motion.x, pose.y + motion.y, pose.theta + turn);
    }
}

/// Links want to be of length 1 and to leave in the direction of their ends.
fn pull(poses: &[Pose], springs: &[Spring], moves: &mut [Point], turns: &mut [(f64, u32)]) {
    for spring in springs {
        let (from, to) = (&poses[spring.from], &poses[spring.to]);
        let gap = position(to) - position(from);
        let (leaving, entering) = misfits(spring, poses);
        let pull = (leaving - entering) / 2.0;
        moves[spring.from] += pull;
        moves[spring.to] -= pull;
        let between = |gap: Point, end: f64, pose: &Pose| wrap_angle(gap.y.atan2(gap.x) - end - pose.theta);
        for (place, turn) in [
            (spring.from, between(gap, spring.leaving, from)),
            (spring.to, between(-gap, spring.entering, to)),
        ] {
            turns[place].0 += turn;
            turns[place].1 += 1;
        }
    }
}

/// Places push each other apart.
fn push_places(poses: &[Pose], moves: &mut [Point]) {
    for one in 0..poses.len() {
        for other in 0..one {
            let gap = position(&poses[one]) - position(&poses[other]);
            let distance = gap.norm();
            if distance < PLACE_DISTANCE && distance > 0.0 {
                let push = gap * (REPULSION * (PLACE_DISTANCE - distance) / distance);
                moves[one] += push;
                moves[other] -= push;
            }
        }
    }
}

/// Places are pushed off the straight line of links that are not theirs.
fn push_off_links(poses: &[Pose], springs: &[Spring], moves: &mut [Point]) {
    for spring in springs {
        let (start, end) = (position(&poses[spring.from]), position(&poses[spring.to]));
        let along = end - start;
        for place in (0..poses.len()).filter(|&place| place != spring.from && place != spring.to) {
            let offset = position(&poses[place]) - start;
            let part = (offset.dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
            let gap = offset - along * part;
            let distance = gap.norm();
            if distance < LINK_DISTANCE {
                let away = if distance > 1e-9 { gap / distance } else { vector![-along.y, along.x] };
                let push = away * (REPULSION * (LINK_DISTANCE - distance));
                moves[place] += push;
                moves[spring.from] -= push * (1.0 - part);
                moves[spring.to] -= push * part;
            }
        }
    }
}
