//! Corners: where a line of the axis turns.

use hssh_metrics::wrap_angle;

use crate::skeleton::{AxisPoint, distances};

/// The shortest arm of the angle that is measured at a point, in metres.
const SHORTEST_ARM: f64 = 1.0;

/// The positions in a line of points where it turns by at least `corner` radians, in order. The turn is
/// measured over arms of about the way's width; the sharpest within their length counts.
pub(super) fn bends(points: &[AxisPoint], corner: f64) -> Vec<usize> {
    let along = distances(points);
    let turns: Vec<f64> = (0..points.len()).map(|at| turn(points, &along, at)).collect();
    let mut sharpest: Vec<usize> = (0..points.len()).filter(|&at| turns[at] >= corner).collect();
    sharpest.sort_by(|&a, &b| turns[b].total_cmp(&turns[a]).then(a.cmp(&b)));
    let mut bends: Vec<usize> = Vec::new();
    for at in sharpest {
        if bends.iter().all(|&bend| (along[bend] - along[at]).abs() > 1.5 * arm(&points[bend])) {
            bends.push(at);
        }
    }
    bends.sort_unstable();
    bends
}

fn arm(point: &AxisPoint) -> f64 {
    (2.0 * point.clearance).max(SHORTEST_ARM)
}

/// By how much the line turns at a point, in radians; 0 too close to its ends.
fn turn(points: &[AxisPoint], along: &[f64], at: usize) -> f64 {
    let arm = arm(&points[at]);
    let available = along[at].min(along[along.len() - 1] - along[at]);
    if available < 0.75 * arm {
        return 0.0;
    }
    let arm = arm.min(available);
    let before = points[along.partition_point(|&here| here < along[at] - arm)].point;
    let after = points[along.partition_point(|&here| here < along[at] + arm).min(points.len() - 1)].point;
    let here = points[at].point;
    let direction = |from: [f64; 2], to: [f64; 2]| (to[1] - from[1]).atan2(to[0] - from[0]);
    wrap_angle(direction(here, after) - direction(before, here)).abs()
}
