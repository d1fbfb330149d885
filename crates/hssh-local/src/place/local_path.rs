//! Which gateways of a place continue one another, and which local paths end there.

use std::f64::consts::PI;

use hssh_metrics::wrap_angle;

use super::{Gateway, PlaceOptions};

/// For each gateway the one that continues it across the place, if there is one: pairs that point away
/// from one another along one line, the straightest first.
pub(crate) fn continuations(gateways: &[Gateway], options: &PlaceOptions) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for first in 0..gateways.len() {
        for second in first + 1..gateways.len() {
            if let Some(cost) = crookedness(&gateways[first], &gateways[second], options) {
                pairs.push((cost, first, second));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut other = vec![None; gateways.len()];
    for (_, first, second) in pairs {
        if other[first].is_none() && other[second].is_none() {
            (other[first], other[second]) = (Some(second), Some(first));
        }
    }
    other
}

/// Whether two gateways point away from one another, so that one goes on where the other came from.
pub(super) fn is_straight(one: &Gateway, other: &Gateway, options: &PlaceOptions) -> bool {
    turn(one, other) <= options.straight
}

/// By how many radians a way turns that comes in by one gateway and goes out by the other.
fn turn(one: &Gateway, other: &Gateway) -> f64 {
    wrap_angle(one.bearing - other.bearing - PI).abs()
}

/// How far two gateways are from being the two ends of a straight path: 0 if they are, at most 2;
/// `None` if they are no such pair.
pub(crate) fn crookedness(first: &Gateway, second: &Gateway, options: &PlaceOptions) -> Option<f64> {
    let turn = turn(first, second) / options.straight;
    let offset = (passes_by(first, second) + passes_by(second, first)) / 2.0;
    let mean_width = (first.width + second.width) / 2.0;
    let shift = offset / (options.aligned * mean_width).max(f64::MIN_POSITIVE);
    (turn <= 1.0 && shift <= 1.0).then_some(turn + shift)
}

/// By how many metres the line through a gateway along its bearing misses another gateway.
fn passes_by(gateway: &Gateway, other: &Gateway) -> f64 {
    let [dx, dy] = [other.position[0] - gateway.position[0], other.position[1] - gateway.position[1]];
    (gateway.bearing.cos() * dy - gateway.bearing.sin() * dx).abs()
}
