//! Whether two submaps show one place, and how they lie on one another.

use hssh_metrics::{Covariance, Pose, UncertainPose};
use nalgebra::{Matrix3, Vector2, Vector3};

use super::keyframe::Keyframe;
use super::options::ClosingOptions;
use super::search::{Window, search};
use super::submap::{CELL, Submap};
use crate::matching::{MatchOptions, align};

/// Two matches nearer than this to one another are one, in metres.
const APART: f64 = 1.0;
/// A window so small leaves no room for another match: metres.
const SMALL: f64 = 1.2;

/// One submap found in another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    /// The later submap…
    pub(super) query: usize,
    /// …and the earlier one.
    pub(super) reference: usize,
    /// The later one's middle in the frame of the earlier one's.
    pub(super) relative: UncertainPose,
    pub(super) score: f64,
    pub(super) agreement: f64,
    pub(super) overlap: f64,
    /// Whether nothing else in the window fits nearly as well.
    pub(super) is_clear: bool,
    /// Whether the window was so small that there was nothing else to find.
    pub(super) is_expected: bool,
}

/// Looks for a submap in an earlier one. `None` if it does not lie in the window.
pub(super) fn find(
    submaps: &[Submap],
    keyframes: &[Keyframe],
    (query, reference): (usize, usize),
    window: &Window,
    options: &ClosingOptions,
) -> Option<Match> {
    let (one, other) = (&submaps[reference], &submaps[query]);
    // The more cells, the longer it takes; a few hundred tell as much as all.
    let step = (other.walls.len() / 300).max(1);
    let walls: Vec<Vector2<f64>> = other.walls.iter().step_by(step).copied().collect();
    let best = search(&one.field, &walls, window, options.least_score, None)?;
    let is_expected = window.across <= SMALL;
    let is_clear = is_expected
        || search(&one.field, &walls, window, options.ambiguity * best.score, Some((best.pose, APART)))
            .is_none();
    let prior = UncertainPose {
        mean: best.pose,
        covariance: Covariance::from_standard_deviations(0.5, 0.5, 0.1).expect("positive"),
    };
    let matching = MatchOptions { floor: (0.0, 0.0), hits_per_observation: 20.0, ..MatchOptions::default() };
    let fine = align(&one.cloud(keyframes), &other.surfaces(keyframes), best.pose, &prior, &matching);
    if (fine.mean.translation() - best.pose.translation()).norm() > 0.4 {
        return None;
    }
    let (agreement, overlap) = agreement(one, other, fine.mean);
    let floor = Vector3::new(options.floor.0, options.floor.0, options.floor.1).map(|sigma| sigma * sigma);
    let covariance = Covariance::new(fine.covariance.matrix() + Matrix3::from_diagonal(&floor)).ok()?;
    let relative = UncertainPose { mean: fine.mean, covariance };
    Some(Match { query, reference, relative, score: best.score, agreement, overlap, is_clear, is_expected })
}

/// Of the walls of each submap that lie where the other one has seen something, which part the other one has
/// too; and how many metres of wall both have.
fn agreement(one: &Submap, other: &Submap, placed: Pose) -> (f64, f64) {
    let onto = |pose: Pose, walls: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
        let rotation = pose.rotation();
        walls.iter().map(|wall| pose.translation() + rotation * wall).collect()
    };
    let there = one.field.meets(onto(placed, &other.walls).into_iter());
    let back = other.field.meets(onto(placed.inverse(), &one.walls).into_iter());
    let (seen, near) = (there.0 + back.0, there.1 + back.1);
    // Every second cell of a wall is kept.
    let overlap = there.1.min(back.1) as f64 * 2.0 * CELL;
    (near as f64 / seen.max(1) as f64, overlap)
}
