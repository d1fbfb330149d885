//! The fine work once it is known where the robot was before: each keyframe matched with those of an earlier or later pass
//! beside it.

use hssh_metrics::{Pose, UncertainPose};

use super::keyframe::Keyframe;
use super::matching::refined;
use super::options::ClosingOptions;
use crate::matching::Cloud;

/// Keyframes on both sides of the nearest one of the other pass that are matched against.
const BESIDE: usize = 3;
/// The nearest one of another pass is no farther away than this, in metres.
const NEAR: f64 = 3.0;
/// A pass is where it seems to be if a closure says so no farther away than this on both passes: metres of travel.
const CONFIRMING: f64 = 8.0;
/// A match that moves the keyframe by more is another one: metres, and as many radians.
const MOVED: f64 = 0.12;

/// A keyframe seen from one of another pass.
pub(super) struct Refined {
    pub(super) from: usize,
    pub(super) to: usize,
    /// The later one as seen from the earlier one.
    pub(super) relative: UncertainPose,
}

/// Matches between passes. `poses` are those of the keyframes, good to some decimetres where passes meet; `closures` are the
/// keyframes, the earlier one first, of which it is known that they show one place.
pub(super) fn refine(
    keyframes: &[Keyframe],
    poses: &[Pose],
    closures: &[(usize, usize)],
    options: &ClosingOptions,
) -> Vec<Refined> {
    let at = |keyframe: usize| keyframes[keyframe].travelled;
    let is_near = |one: usize, other: usize| (at(one) - at(other)).abs() < CONFIRMING;
    let mut found = Vec::new();
    for later in 0..keyframes.len() {
        // By closure, the nearest keyframe of the other pass; passes that overlap are one.
        let mut nearest: Vec<usize> = Vec::new();
        for &(before, _) in closures.iter().filter(|(_, after)| is_near(*after, later)) {
            let beside = (0..later).filter(|&other| is_near(other, before));
            let away = |other: usize| (poses[later].translation() - poses[other].translation()).norm();
            let best =
                beside.min_by(|&a, &b| away(a).total_cmp(&away(b))).filter(|&other| away(other) < NEAR);
            let Some(best) = best.filter(|&best| at(later) - at(best) >= options.least_travel) else {
                continue;
            };
            if !nearest.iter().any(|&other| is_near(other, best)) {
                nearest.push(best);
            }
        }
        found.extend(nearest.into_iter().filter_map(|from| {
            let relative = matched(keyframes, poses, (from, later), options)?;
            Some(Refined { from, to: later, relative })
        }));
    }
    found
}

/// One keyframe against those around one of another pass.
fn matched(
    keyframes: &[Keyframe],
    poses: &[Pose],
    (from, later): (usize, usize),
    options: &ClosingOptions,
) -> Option<UncertainPose> {
    let mut cloud = Cloud::default();
    let around = from.saturating_sub(BESIDE)..(from + BESIDE + 1).min(later);
    // The nearest first, for what is there already is not added again.
    let mut order: Vec<usize> = around.collect();
    order.sort_by_key(|other| other.abs_diff(from));
    for other in order {
        cloud.insert(poses[from].between(poses[other]), &keyframes[other].surfaces, 0.06);
    }
    let start = poses[from].between(poses[later]);
    let relative = refined(&cloud, &keyframes[later].surfaces, start, options)?;
    let moved = start.between(relative.mean);
    (moved.translation().norm() < MOVED && moved.theta.abs() < MOVED).then_some(relative)
}
