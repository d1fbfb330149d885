//! How far poses are from those that somebody's mapper corrected.

use hssh_local::{LaserLog, Track};
use hssh_metrics::Pose;
use nalgebra::Vector2;

/// Over these stretches of travel, in metres, errors are measured.
const STRETCHES: [f64; 3] = [1.0, 5.0, 20.0];

/// Errors of the tracked and the raw motion over stretches of the way, and how honest the covariance is.
pub(super) fn table(log: &LaserLog, track: &Track) -> String {
    let lines = STRETCHES.map(|stretch| line(log, track, stretch));
    lines.join("\n")
}

fn line(log: &LaserLog, track: &Track, stretch: f64) -> String {
    let (mut ours, mut raw, mut consistency) = (Vec::new(), Vec::new(), Vec::new());
    let mut from = 0;
    for to in 1..track.scans.len() {
        if track.scans[to].travelled - track.scans[from].travelled < stretch {
            continue;
        }
        let (start, end) = (&log.scans[from], &log.scans[to]);
        let truth = start.corrected.between(end.corrected);
        raw.push(truth.between(start.odometry.between(end.odometry)));
        if let Ok(Some(motion)) = track.motion(from, to) {
            let error = truth.between(motion.mean);
            let off = nalgebra::vector![motion.mean.x - truth.x, motion.mean.y - truth.y, error.theta];
            ours.push(error);
            consistency.push(off.dot(&(motion.covariance.information().matrix() * off)));
        }
        from = to;
    }
    let middle = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let size = |errors: &[Pose]| {
        let metres = middle(errors.iter().map(|error| error.translation().norm()).collect());
        let degrees = middle(errors.iter().map(|error| error.theta.abs().to_degrees()).collect());
        format!("{metres:.3} m {degrees:.2}°")
    };
    format!(
        "  median error over {stretch:>2} m: matched {}, raw {}; median χ² {:.1} (2.4 is expected)",
        size(&ours),
        size(&raw),
        middle(consistency)
    )
}

/// The frame in which `poses` lie best on `others`: least squares of their positions.
pub(super) fn best_fit(poses: &[Pose], others: &[Pose]) -> Pose {
    let mean = |poses: &[Pose]| {
        poses.iter().map(|pose| pose.translation()).sum::<Vector2<f64>>() / poses.len().max(1) as f64
    };
    let (center, other_center) = (mean(poses), mean(others));
    let (mut sin, mut cos) = (0.0, 0.0);
    for (pose, other) in poses.iter().zip(others) {
        let (a, b) = (pose.translation() - center, other.translation() - other_center);
        sin += a.x * b.y - a.y * b.x;
        cos += a.dot(&b);
    }
    let turn = Pose::new(0.0, 0.0, sin.atan2(cos));
    let origin = other_center - turn.rotation() * center;
    Pose::new(origin.x, origin.y, turn.theta)
}

/// How far `poses`, placed by `frame`, are from `others`: root mean square in metres.
pub(super) fn root_mean_square(poses: &[Pose], others: &[Pose], frame: Pose) -> f64 {
    let squares = poses
        .iter()
        .zip(others)
        .map(|(pose, other)| (frame.compose(*pose).translation() - other.translation()).norm_squared());
    (squares.sum::<f64>() / poses.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_path_fits_where_it_was_moved() {
        let path: Vec<Pose> = (0..7).map(|k| Pose::new(f64::from(k), f64::from(k * k % 5), 0.0)).collect();
        let frame = Pose::new(-3.0, 8.0, 2.5);
        let moved: Vec<Pose> = path.iter().map(|pose| frame.compose(*pose)).collect();
        let found = best_fit(&path, &moved);
        assert!(found.between(frame).translation().norm() < 1e-9);
        assert!(root_mean_square(&path, &moved, found) < 1e-9);
    }
}
