//! How the frames of two visits to one place are turned against each other.

use hssh_topology::Isomorphism;

use crate::place::LocalStar;

/// By how many radians the frame of `seen` is turned against that of `first`: the mean difference of the
/// bearings of corresponding ends.
pub(crate) fn turn(seen: &LocalStar, first: &LocalStar, phi: Isomorphism) -> f64 {
    let differences =
        seen.star.olps().map(|olp| first.bearings[phi.apply(olp).index()] - seen.bearings[olp.index()]);
    let (sin, cos) = differences.fold((0.0, 0.0), |(sin, cos), turn| (sin + turn.sin(), cos + turn.cos()));
    sin.atan2(cos)
}
