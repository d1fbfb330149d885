//! Links as springs: they pull two places to where each sees the other.

use hssh_metrics::Pose;

use crate::svg::{Point, toward};

/// A link as the relaxation sees it: two different places, and the directions of its ends in their frames.
pub(super) struct Spring {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) leaving: f64,
    pub(super) entering: f64,
}

/// The sum of squares of how far places are from where their links want them.
pub(super) fn misfit(poses: &[Pose], springs: &[Spring]) -> f64 {
    let misfits = springs.iter().map(|spring| {
        let (leaving, entering) = misfits(spring, poses);
        leaving.norm_squared() + entering.norm_squared()
    });
    misfits.sum()
}

/// Where the far place is, seen from where the near end wants it; and the same the other way.
pub(super) fn misfits(spring: &Spring, poses: &[Pose]) -> (Point, Point) {
    let (from, to) = (&poses[spring.from], &poses[spring.to]);
    let gap = position(to) - position(from);
    (gap - toward(from.theta + spring.leaving), -gap - toward(to.theta + spring.entering))
}

pub(super) fn position(pose: &Pose) -> Point {
    pose.translation()
}
