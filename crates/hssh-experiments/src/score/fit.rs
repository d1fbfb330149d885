//! How far a trajectory is from another one, wherever the two begin.

use hssh_metrics::Pose;
use nalgebra::Vector2;

/// The frame in which `poses` lie best on `others`: least squares of their positions.
pub(crate) fn best_fit(poses: &[Pose], others: &[Pose]) -> Pose {
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

/// How far `poses`, placed where they fit best, are from `others`: root mean square in metres.
pub(crate) fn root_mean_square(poses: &[Pose], others: &[Pose]) -> f64 {
    let frame = best_fit(poses, others);
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
        assert!(best_fit(&path, &moved).between(frame).translation().norm() < 1e-9);
        assert!(root_mean_square(&path, &moved) < 1e-9);
    }

    /// A straight line that is stretched about its middle: the ends are off by 1 m each, the middle is not.
    #[test]
    fn what_is_too_long_is_off_at_its_ends() {
        let line = |step: f64| [-step, 0.0, step].map(|x| Pose::new(x, 0.0, 0.0));
        let off = root_mean_square(&line(3.0), &line(2.0));
        assert!((off - (2.0_f64 / 3.0).sqrt()).abs() < 1e-9, "{off}");
    }
}
