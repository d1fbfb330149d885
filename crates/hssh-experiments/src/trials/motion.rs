//! How a robot goes a way, and what its wheels say of it.

use hssh_metrics::Pose;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A robot turns by so many radians at most from scan to scan.
const TURN: f64 = 0.2;

/// Poses along a way, one every `step` metres, with turns on the spot.
pub(super) fn poses(way: &[[f64; 2]], step: f64) -> Vec<Pose> {
    let mut poses: Vec<Pose> = Vec::new();
    for pair in way.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let heading = dy.atan2(dx);
        if let Some(&last) = poses.last() {
            let turn = Pose::new(0.0, 0.0, heading - last.theta).theta;
            let steps = (turn.abs() / TURN).ceil().max(1.0);
            poses.extend(
                (1..=steps as u32)
                    .map(|k| Pose::new(last.x, last.y, last.theta + turn * f64::from(k) / steps)),
            );
        }
        let steps = (dx.hypot(dy) / step).ceil().max(1.0);
        poses.extend((0..=steps as u32).map(|k| {
            let part = f64::from(k) / steps;
            Pose::new(pair[0][0] + part * dx, pair[0][1] + part * dy, heading)
        }));
    }
    poses
}

/// What wheels are like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wheels {
    /// Radians for each metre that the robot believes to go straight on and does not.
    pub(super) bend: f64,
    /// What part of a turn is not noticed.
    pub(super) turn: f64,
    /// Standard deviations for a root metre: metres and radians.
    pub(super) noise: (f64, f64),
    /// Metres between two slips, by which the heading is off at once; infinite for wheels that do not.
    pub(super) slip: f64,
}

/// What wheels say of poses.
pub(super) fn odometry(poses: &[Pose], wheels: &Wheels, random: &mut ChaCha8Rng) -> Vec<Pose> {
    let mut believed = vec![Pose::IDENTITY];
    for pair in poses.windows(2) {
        let step = pair[0].between(pair[1]);
        let length = step.translation().norm();
        let mut noise = |sigma: f64| -> f64 {
            let normal: f64 = StandardNormal.sample(random);
            sigma * normal
        };
        let (ahead, aside) = (noise(wheels.noise.0), noise(0.3 * wheels.noise.0));
        let bent = wheels.bend * length + noise(wheels.noise.1) * (length + step.theta.abs()).sqrt();
        let slipped = if random.random::<f64>() < length / wheels.slip {
            random.random_range(-0.25..0.25)
        } else {
            0.0
        };
        let wrong = Pose::new(
            step.x + ahead * length.sqrt(),
            step.y + aside * length.sqrt(),
            step.theta * (1.0 - wheels.turn) + bent + slipped,
        );
        believed.push(believed[believed.len() - 1].compose(wrong));
    }
    believed
}
