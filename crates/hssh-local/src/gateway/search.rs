//! Looks for gateways along the medial axis: for the one on a way out of a place, and for all
//! constrictions of a map.

use super::{Gateway, GatewayParameters, gateway_at};
use crate::distance::DistanceField;
use crate::skeleton::{AxisPoint, Skeleton, SkeletonEdge, distances};

/// The gateway on a way out: `way` starts at the place, `clearance` is that of its center and `start`
/// how far along the way a gateway may be at the earliest. Also its position in the way.
pub(crate) fn gateway_on(
    way: &[AxisPoint],
    clearance: f64,
    start: f64,
    field: &DistanceField,
    parameters: &GatewayParameters,
) -> (usize, Gateway) {
    let along = distances(way);
    let total = along[along.len() - 1];
    let first = along.partition_point(|&at| at < start.min(total / 2.0)).min(way.len() - 1);
    let reach = start.max(parameters.reach * clearance) + parameters.reach_beyond;
    let mut end = along.partition_point(|&at| at <= reach).max(first + 1);
    while end < way.len() && way[end].clearance < way[end - 1].clearance {
        end += 1;
    }
    let least = way[first..end].iter().map(|point| point.clearance).fold(f64::INFINITY, f64::min);
    let limit = least * (1.0 + parameters.as_narrow);
    let at = (first..end).find(|&at| way[at].clearance <= limit).unwrap_or(first);
    (at, gateway_at(&way[at], bearing(way, &along, at, parameters), field))
}

/// The direction of the way from one of its points on, in radians.
fn bearing(way: &[AxisPoint], along: &[f64], at: usize, parameters: &GatewayParameters) -> f64 {
    let aim = parameters.aim.max(2.0 * way[at].clearance);
    let ahead = along.partition_point(|&here| here < along[at] + aim).min(way.len() - 1);
    let behind = if along[ahead] - along[at] < aim / 2.0 {
        along.partition_point(|&here| here < along[ahead] - aim / 2.0)
    } else {
        at
    };
    let [from, to] = [way[behind].point, way[ahead].point];
    (to[1] - from[1]).atan2(to[0] - from[0])
}

/// All constrictions along the axis: local minima of the clearance that are clearly narrower than the
/// widest points before and after, each within reach. Their bearings point along the edge.
pub(crate) fn constrictions(
    skeleton: &Skeleton,
    field: &DistanceField,
    parameters: &GatewayParameters,
) -> Vec<Gateway> {
    skeleton.edges.iter().flat_map(|edge| constrictions_of(edge, field, parameters)).collect()
}

fn constrictions_of(
    edge: &SkeletonEdge,
    field: &DistanceField,
    parameters: &GatewayParameters,
) -> Vec<Gateway> {
    let points = &edge.points;
    let along = distances(points);
    let reach = |at: usize| parameters.reach_beyond + parameters.reach * points[at].clearance;
    let widest =
        |from: usize, to: usize| points[from..=to].iter().map(|point| point.clearance).fold(0.0, f64::max);
    let mut found = Vec::new();
    let mut blocked_until = f64::NEG_INFINITY;
    for at in 1..points.len().saturating_sub(1) {
        let here = points[at].clearance;
        let first = along.partition_point(|&place| place < along[at] - reach(at));
        let last = along.partition_point(|&place| place <= along[at] + reach(at)) - 1;
        let is_least = points[first..=last].iter().all(|other| here <= other.clearance);
        let limit = here / parameters.constriction;
        if along[at] > blocked_until && is_least && widest(first, at) >= limit && widest(at, last) >= limit {
            found.push(gateway_at(
                points_at(points, &along, at),
                bearing(points, &along, at, parameters),
                field,
            ));
            blocked_until = along[at] + reach(at);
        }
    }
    found
}

/// The middle of the equally narrow points that begin at `at`.
fn points_at<'a>(points: &'a [AxisPoint], along: &[f64], at: usize) -> &'a AxisPoint {
    let level = points[at..].iter().take_while(|point| point.clearance <= points[at].clearance).count();
    let middle = (along[at] + along[at + level - 1]) / 2.0;
    &points[along.partition_point(|&here| here < middle).clamp(at, at + level - 1)]
}
