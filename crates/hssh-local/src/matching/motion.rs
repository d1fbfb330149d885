//! How raw odometry errs.

use hssh_metrics::{Covariance, Pose, UncertainPose};
use nalgebra::{Matrix3, vector};

/// The error of raw odometry, as standard deviations that grow with the root of the way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MotionNoise {
    /// Along the motion: metres per root metre.
    pub distance: f64,
    /// Across the motion: metres per root metre.
    pub sideways: f64,
    /// Of the heading: radians per root metre.
    pub heading: f64,
    /// Of the heading: radians per root radian turned.
    pub turn: f64,
    /// What no step is known better than: metres and radians.
    pub floor: (f64, f64),
}

impl Default for MotionNoise {
    fn default() -> Self {
        MotionNoise { distance: 0.08, sideways: 0.05, heading: 0.06, turn: 0.12, floor: (0.01, 0.005) }
    }
}

impl MotionNoise {
    /// The relative motion from the first to the last of some poses of raw odometry.
    ///
    /// # Panics
    /// If there is no pose.
    #[must_use]
    pub fn motion(&self, trajectory: &[Pose]) -> UncertainPose {
        let (first, last) = (trajectory[0], trajectory[trajectory.len() - 1]);
        let steps = trajectory.windows(2).map(|pair| pair[0].between(pair[1]));
        let (way, turned) = steps.fold((0.0, 0.0), |(way, turned), step| {
            (way + step.translation().norm(), turned + step.theta.abs())
        });
        let mean = first.between(last);
        let along = self.distance.powi(2) * way + self.floor.0.powi(2);
        let across = self.sideways.powi(2) * way + self.floor.0.powi(2);
        let heading = self.heading.powi(2) * way + self.turn.powi(2) * turned + self.floor.1.powi(2);
        let direction = mean.y.atan2(mean.x);
        let covariance = Covariance::new(Matrix3::from_diagonal(&vector![along, across, heading]))
            .expect("the floors keep the variances of finite ways positive");
        UncertainPose { mean, covariance: covariance.rotated(direction) }
    }
}

/// Wheels that slip, or stand while the robot is pushed: now and then odometry is off by far more than its noise.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slip {
    /// A step is suspected if the hits' mean log-likelihood is below this, in nats: 0 is perfect, −3 hits nothing.
    pub suspicion: f64,
    /// How far off the odometry of such a step may be, standard deviations: metres and radians.
    pub spread: (f64, f64),
    /// By how much better a slip has to fit to be believed, in nats.
    pub price: f64,
}

impl Default for Slip {
    fn default() -> Self {
        Slip { suspicion: -0.4, spread: (0.3, 0.1), price: 8.0 }
    }
}

impl Slip {
    /// A motion that may have slipped.
    pub(super) fn widened(&self, motion: &UncertainPose) -> UncertainPose {
        let (across, around) = (self.spread.0.powi(2), self.spread.1.powi(2));
        let wider = motion.covariance.matrix() + Matrix3::from_diagonal(&vector![across, across, around]);
        UncertainPose { mean: motion.mean, covariance: Covariance::new(wider).unwrap_or(motion.covariance) }
    }
}
