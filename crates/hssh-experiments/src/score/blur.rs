//! How crisp walls are where the robot came back: needs no truth but where that was.

use std::collections::BTreeMap;

use hssh_local::{LaserLog, Scan};
use hssh_metrics::{Pose, wrap_angle};
use nalgebra::Vector2;

/// Scans are compared that look the same way, up to so many radians.
const FACING: f64 = 0.5;
/// About so many pairs of scans are compared.
const MOST_PAIRS: usize = 200;
/// A hit farther from all others counts as so far, in metres.
const REACH: f64 = 0.5;
/// Of ranges between these, in metres.
const RANGES: (f64, f64) = (0.1, 30.0);
/// Where all beams come back, those longer than this part of the longest are not counted.
const LONG: f64 = 0.95;

type Hits = Vec<Vector2<f64>>;

/// The mean distance from every second hit of a scan to the nearest one of an earlier scan taken close to it, in metres, with scans
/// placed by `poses`; `close` are the pairs of scans, the earlier one first. `None` if no pair looks the same way.
pub(super) fn blur(log: &LaserLog, truth: &[Pose], close: &[(usize, usize)], poses: &[Pose]) -> Option<f64> {
    let faces =
        |&&(one, other): &&(usize, usize)| wrap_angle(truth[one].theta - truth[other].theta).abs() < FACING;
    let facing: Vec<(usize, usize)> = close.iter().filter(faces).copied().collect();
    let (mut sum, mut count) = (0.0, 0_usize);
    for &(earlier, later) in facing.iter().step_by((facing.len() / MOST_PAIRS).max(1)) {
        let mut buckets: BTreeMap<(i64, i64), Hits> = BTreeMap::new();
        for hit in placed(&log.scans[earlier].scan, poses[earlier]) {
            buckets.entry(bucket(hit)).or_default().push(hit);
        }
        for hit in placed(&log.scans[later].scan, poses[later]).into_iter().step_by(2) {
            let (column, row) = bucket(hit);
            let around = (-1..=1).flat_map(|u| (-1..=1).map(move |v| (column + u, row + v)));
            let near = around.filter_map(|bucket| buckets.get(&bucket)).flatten();
            sum += near.map(|other| (hit - other).norm()).fold(REACH, f64::min);
            count += 1;
        }
    }
    (count > 0).then(|| sum / count as f64)
}

fn bucket(point: Vector2<f64>) -> (i64, i64) {
    ((point.x / REACH).floor() as i64, (point.y / REACH).floor() as i64)
}

fn placed(scan: &Scan, pose: Pose) -> Hits {
    let returned = scan.ranges.iter().copied().filter(|range| range.is_finite());
    let far = if scan.ranges.iter().all(|range| range.is_finite()) {
        RANGES.1.min(LONG * returned.fold(0.0, f64::max))
    } else {
        RANGES.1
    };
    let beams =
        (0..scan.ranges.len()).filter(|&beam| scan.ranges[beam] > RANGES.0 && scan.ranges[beam] < far);
    beams
        .map(|beam| pose.translation() + pose.rotation() * scan.direction(beam) * scan.ranges[beam])
        .collect()
}
