//! Which gateways of a place continue one another, and which local paths end there.

use std::f64::consts::PI;

use hssh_metrics::wrap_angle;

use super::PlaceParameters;
use crate::gateway::Gateway;

/// For each gateway the one that continues it across the place, if there is one: pairs that point away
/// from one another along one line, the straightest first.
pub(super) fn continuations(gateways: &[Gateway], parameters: &PlaceParameters) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for first in 0..gateways.len() {
        for second in first + 1..gateways.len() {
            if let Some(cost) = crookedness(&gateways[first], &gateways[second], parameters) {
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

/// How far two gateways are from being the two ends of a straight path: 0 if they are, at most 2;
/// `None` if they are no such pair.
fn crookedness(first: &Gateway, second: &Gateway, parameters: &PlaceParameters) -> Option<f64> {
    let turn = wrap_angle(first.bearing - second.bearing - PI).abs() / parameters.straight;
    let offset = (passes_by(first, second) + passes_by(second, first)) / 2.0;
    let mean_width = (first.width + second.width) / 2.0;
    let shift = offset / (parameters.aligned * mean_width).max(f64::MIN_POSITIVE);
    (turn <= 1.0 && shift <= 1.0).then_some(turn + shift)
}

/// By how many metres the line through a gateway along its bearing misses another gateway.
fn passes_by(gateway: &Gateway, other: &Gateway) -> f64 {
    let [dx, dy] = [other.position[0] - gateway.position[0], other.position[1] - gateway.position[1]];
    (gateway.bearing.cos() * dy - gateway.bearing.sin() * dx).abs()
}
