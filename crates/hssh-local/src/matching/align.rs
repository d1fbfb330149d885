//! The fine alignment: Gauss–Newton from hits to the lines of the surfaces nearest to them, with what
//! odometry believes as a prior, so that it decides where surfaces say nothing.

use hssh_metrics::{Covariance, Pose, UncertainPose, wrap_angle};
use nalgebra::{Matrix3, Vector2, Vector3};

use super::cloud::{Cloud, SurfacePoint};
use super::options::MatchOptions;

/// Hits farther from every surface than this are something new: metres, first and last iteration.
const CORRESPONDENCE: (f64, f64) = (0.5, 0.2);
const ITERATIONS: usize = 12;
/// A step smaller than this ends the iteration: metres, radians.
const DONE: (f64, f64) = (1e-4, 1e-5);
/// A surface that faces more than about 40° away from the hit's own is another one.
const FACING: f64 = 0.75;

/// The pose that fits both the surfaces and the odometry best, with its covariance: of (x, y, θ) in the
/// frame of the cloud. `start` is where to begin, `predicted` what odometry believes.
pub(crate) fn align(
    cloud: &Cloud,
    surfaces: &[SurfacePoint],
    start: Pose,
    predicted: &UncertainPose,
    options: &MatchOptions,
) -> UncertainPose {
    let prior = *predicted.covariance.information().matrix();
    let mut pose = start;
    let mut information = prior;
    for iteration in 0..ITERATIONS {
        let share = iteration as f64 / (ITERATIONS - 1) as f64;
        let reach = CORRESPONDENCE.0 + (CORRESPONDENCE.1 - CORRESPONDENCE.0) * share;
        let off = Vector3::new(
            pose.x - predicted.mean.x,
            pose.y - predicted.mean.y,
            wrap_angle(pose.theta - predicted.mean.theta),
        );
        let (hessian, gradient) = normal_equations(cloud, surfaces, pose, reach, options);
        information = prior + hessian;
        let Some(cholesky) = information.cholesky() else { break };
        let step = cholesky.solve(&-(prior * off + gradient));
        pose = Pose::new(pose.x + step.x, pose.y + step.y, pose.theta + step.z);
        let is_small = step.xy().norm() < DONE.0 && step.z.abs() < DONE.1;
        if is_small && iteration > ITERATIONS / 2 {
            break;
        }
    }
    UncertainPose { mean: pose, covariance: with_floor(&information, predicted, options) }
}

/// The Hessian and gradient of half the weighted squared distances from hits to lines.
fn normal_equations(
    cloud: &Cloud,
    surfaces: &[SurfacePoint],
    pose: Pose,
    reach: f64,
    options: &MatchOptions,
) -> (Matrix3<f64>, Vector3<f64>) {
    let rotation = pose.rotation();
    let weight = 1.0 / (options.hit_noise.powi(2) * options.hits_per_observation);
    let mut hessian = Matrix3::zeros();
    let mut gradient = Vector3::zeros();
    for surface in surfaces {
        let arm = rotation * surface.position;
        let hit = pose.translation() + arm;
        let Some((line, normal)) = facing(cloud, surface, hit, rotation, reach) else { continue };
        let distance = normal.dot(&(hit - line));
        let jacobian = Vector3::new(normal.x, normal.y, normal.y * arm.x - normal.x * arm.y);
        // Cauchy's weight: hits off their line by several standard deviations count little.
        let robust = weight / (1.0 + (distance / (2.0 * options.hit_noise)).powi(2));
        hessian += robust * jacobian * jacobian.transpose();
        gradient += robust * distance * jacobian;
    }
    (hessian, gradient)
}

/// The nearest surface that faces the way the hit's own surface does.
fn facing(
    cloud: &Cloud,
    surface: &SurfacePoint,
    hit: Vector2<f64>,
    rotation: nalgebra::Matrix2<f64>,
    reach: f64,
) -> Option<(Vector2<f64>, Vector2<f64>)> {
    let nearest = cloud.nearest(hit, reach)?;
    let normal = nearest.normal?;
    let agrees = surface.normal.is_none_or(|own| (rotation * own).dot(&normal).abs() > FACING);
    agrees.then_some((nearest.position, normal))
}

/// The covariance of an information matrix, widened by the floor.
fn with_floor(information: &Matrix3<f64>, predicted: &UncertainPose, options: &MatchOptions) -> Covariance {
    let floor = Vector3::new(options.floor.0, options.floor.0, options.floor.1).map(|sigma| sigma * sigma);
    let inverse = information.cholesky().map(|cholesky| cholesky.inverse());
    let widened = inverse.map(|inverse| {
        let covariance = inverse + Matrix3::from_diagonal(&floor);
        0.5 * (covariance + covariance.transpose())
    });
    widened.and_then(|matrix| Covariance::new(matrix).ok()).unwrap_or(predicted.covariance)
}
