//! Constrictions: where the medial axis of a map passes a narrow point, doors above all.

use super::gateway::{bearing, gateway_at};
use super::{Gateway, GatewayOptions};
use crate::distance::DistanceField;
use crate::skeleton::{AxisPoint, Skeleton, SkeletonEdge, distances};

/// All constrictions along the axis: local minima of the clearance that are clearly narrower than the
/// widest points before and after, each within reach. Their bearings point along the edge.
pub(super) fn constrictions(
    skeleton: &Skeleton,
    field: &DistanceField,
    options: &GatewayOptions,
) -> Vec<Gateway> {
    skeleton.edges.iter().flat_map(|edge| constrictions_of(edge, field, options)).collect()
}

fn constrictions_of(edge: &SkeletonEdge, field: &DistanceField, options: &GatewayOptions) -> Vec<Gateway> {
    let points = &edge.points;
    let along = distances(points);
    let reach = |at: usize| options.reach_beyond + options.reach * points[at].clearance;
    let widest =
        |from: usize, to: usize| points[from..=to].iter().map(|point| point.clearance).fold(0.0, f64::max);
    let mut found = Vec::new();
    let mut blocked_until = f64::NEG_INFINITY;
    for at in 1..points.len().saturating_sub(1) {
        let here = points[at].clearance;
        let first = along.partition_point(|&place| place < along[at] - reach(at));
        let last = along.partition_point(|&place| place <= along[at] + reach(at)) - 1;
        let is_least = points[first..=last].iter().all(|other| here <= other.clearance);
        let limit = here / options.constriction;
        if along[at] > blocked_until && is_least && widest(first, at) >= limit && widest(at, last) >= limit {
            found.push(gateway_at(
                points_at(points, &along, at),
                bearing(points, &along, at, options),
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
