//! Raw odometry from place to place, with the covariance of a drift that grows on the way.

use hssh_causal::Odometry;
use hssh_metrics::Pose;
use nalgebra::{Matrix3, Vector3};

use super::turned;

/// How raw odometry errs: variances grow in proportion to the distance and to the angle turned.
pub(super) struct Noise {
    /// Of the distance, m/√m.
    pub(super) distance: f64,
    /// Of the heading, rad/√m.
    pub(super) heading: f64,
    /// Of the heading, rad/√rad.
    pub(super) turn: f64,
    /// Of where the robot stands at a place, m along each axis.
    pub(super) position_fix: f64,
    /// Of the heading read from the walls at a place, rad.
    pub(super) heading_fix: f64,
}

impl Noise {
    /// The first three maximize the likelihood of the 14 travels' errors, given the other two: the
    /// root mean square of how far off centre the scans were taken and how far off the walls were.
    pub(super) fn of_this_robot() -> Self {
        Noise { distance: 0.066, heading: 0.007, turn: 0.025, position_fix: 0.25, heading_fix: 0.02 }
    }
}

/// A pose and the covariance of its (x, y, θ), which may be singular.
type Uncertain = (Pose, Matrix3<f64>);

/// The pose of the arrival place's frame in the departure place's frame. The robot takes itself to
/// stand at either frame's origin with the headings given, and moved along `raw` in between.
pub(super) fn place_to_place(from_heading: f64, raw: &[Pose], to_heading: f64, noise: &Noise) -> Odometry {
    let fix = Matrix3::from_diagonal(
        &Vector3::new(noise.position_fix, noise.position_fix, noise.heading_fix).map(|sigma| sigma * sigma),
    );
    let at_departure = (turned(from_heading), fix);
    let steps = raw.windows(2).map(|pair| pair[0].between(pair[1]));
    let at_arrival =
        steps.fold(at_departure, |sofar, step| compound(sofar, (step, step_covariance(step, noise))));
    let to_frame = (turned(to_heading).inverse(), inverse_covariance(turned(to_heading), fix));
    let (mean, covariance) = compound(at_arrival, to_frame);
    Odometry {
        x: rounded(mean.x, 1e4),
        y: rounded(mean.y, 1e4),
        theta: rounded(mean.theta, 1e5),
        covariance: std::array::from_fn(|row| {
            std::array::from_fn(|column| rounded(covariance[(row, column)], 1e6))
        }),
    }
}

/// One relative pose after another, independent of it, to first order.
fn compound((mean, covariance): Uncertain, (step, noise): Uncertain) -> Uncertain {
    let (by_mean, by_step) = mean.compose_jacobians(step);
    let sum = by_mean * covariance * by_mean.transpose() + by_step * noise * by_step.transpose();
    (mean.compose(step), (sum + sum.transpose()) / 2.0)
}

fn inverse_covariance(pose: Pose, covariance: Matrix3<f64>) -> Matrix3<f64> {
    let jacobian = pose.inverse_jacobian();
    jacobian * covariance * jacobian.transpose()
}

/// One step's noise: along the motion by its length, in heading by its length and its turn.
fn step_covariance(step: Pose, noise: &Noise) -> Matrix3<f64> {
    let length = step.x.hypot(step.y);
    let along = if length > 0.0 { Vector3::new(step.x, step.y, 0.0) / length } else { Vector3::zeros() };
    let heading = noise.heading.powi(2) * length + noise.turn.powi(2) * step.theta.abs();
    along * along.transpose() * noise.distance.powi(2) * length
        + Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, heading))
}

fn rounded(value: f64, digits: f64) -> f64 {
    (value * digits).round() / digits
}
