//! Chains of matches: one match may be chance, several in a row that tell the same are not.

use hssh_metrics::Pose;

use super::matching::Match;

/// How far the poses that two matches tell may be apart: metres, metres for each metre of travel between them, and
/// radians.
const CONSISTENT: (f64, f64, f64) = (0.3, 0.03, 0.06);

/// The pose of the query's middle that a match tells, `pose` giving the estimates of the middles.
pub(super) fn told(found: &Match, pose: impl Fn(usize) -> Pose) -> Pose {
    pose(found.reference).compose(found.relative.mean)
}

/// Whether two matches of submaps `travel` metres apart tell the same.
pub(super) fn agree(one: &Match, other: &Match, travel: f64, pose: impl Fn(usize) -> Pose) -> bool {
    let between = pose(one.query).between(pose(other.query));
    let off = told(one, &pose).compose(between).between(told(other, &pose));
    off.translation().norm() < CONSISTENT.0 + CONSISTENT.1 * travel.abs() && off.theta.abs() < CONSISTENT.2
}
