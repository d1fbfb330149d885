//! The fine alignment: Gauss–Newton from hits to the lines of the surfaces nearest to them, or to posts where little else is in sight, with
//! what odometry believes as a prior, so that it decides where neither says anything.

use hssh_metrics::{Covariance, Pose, UncertainPose, wrap_angle};
use nalgebra::{Matrix2x3, Matrix3, Vector2, Vector3};

use super::cloud::{Cloud, SurfacePoint};
use super::options::MatchOptions;

/// Hits farther from every surface than this are something new: metres, first and last iteration.
const CORRESPONDENCE: (f64, f64) = (0.5, 0.2);
const ITERATIONS: usize = 12;
/// A step smaller than this ends the iteration: metres, radians.
const DONE: (f64, f64) = (1e-4, 1e-5);
/// A surface that faces more than about 40° away from the hit's own is another one.
const FACING: f64 = 0.75;
/// Where fewer surfaces are in sight than this, posts and trunks are matched, too: what stands alone…
const FEW: usize = 40;
/// …and is not seen at the same spot from everywhere, in metres, standard deviation.
const POST: f64 = 0.15;

/// The pose that fits both the surfaces and the odometry best, with its covariance: of (x, y, θ) in the
/// frame of the cloud. `start` is where to begin, `predicted` what odometry believes. Hits that were matched with the same surfaces before
/// tell but a part that is `new`, at most 1: their errors repeat themselves, and do not add up.
pub(crate) fn align(
    cloud: &Cloud,
    surfaces: &[SurfacePoint],
    start: Pose,
    predicted: &UncertainPose,
    new: f64,
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
        information = prior + hessian / new;
        let Some(cholesky) = (prior + hessian).cholesky() else { break };
        let step = cholesky.solve(&-(prior * off + gradient));
        pose = Pose::new(pose.x + step.x, pose.y + step.y, pose.theta + step.z);
        let is_small = step.xy().norm() < DONE.0 && step.z.abs() < DONE.1;
        if is_small && iteration > ITERATIONS / 2 {
            break;
        }
    }
    UncertainPose { mean: pose, covariance: with_floor(&information, predicted, new, options) }
}

/// The Hessian and gradient of half the weighted squared distances from hits to lines, and to posts.
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
    let has_few = surfaces.len() < FEW;
    for surface in surfaces {
        let arm = rotation * surface.position;
        let hit = pose.translation() + arm;
        let Some((line, normal)) = facing(cloud, surface, hit, rotation, reach) else {
            if let Some(post) = cloud.nearest_post(hit, reach).filter(|_| has_few && surface.normal.is_none())
            {
                let off = hit - post.position;
                let jacobian = Matrix2x3::new(1.0, 0.0, -arm.y, 0.0, 1.0, arm.x);
                let weight = weight * (options.hit_noise / POST).powi(2);
                let robust = weight / (1.0 + off.norm_squared() / (2.0 * POST).powi(2));
                hessian += robust * jacobian.transpose() * jacobian;
                gradient += robust * jacobian.transpose() * off;
            }
            continue;
        };
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
    let own = surface.normal.map(|own| rotation * own);
    let nearest = cloud.nearest(hit, own, reach)?;
    let normal = nearest.normal?;
    let agrees = own.is_none_or(|own| own.dot(&normal) > FACING);
    agrees.then_some((nearest.position, normal))
}

/// The covariance of an information matrix, widened by the floor.
fn with_floor(
    information: &Matrix3<f64>,
    predicted: &UncertainPose,
    new: f64,
    options: &MatchOptions,
) -> Covariance {
    let floor =
        Vector3::new(options.floor.0, options.floor.0, options.floor.1).map(|sigma| new * sigma * sigma);
    let inverse = information.cholesky().map(|cholesky| cholesky.inverse());
    let widened = inverse.map(|inverse| {
        let covariance = inverse + Matrix3::from_diagonal(&floor);
        0.5 * (covariance + covariance.transpose())
    });
    widened.and_then(|matrix| Covariance::new(matrix).ok()).unwrap_or(predicted.covariance)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In a room all is shown; what of it was shown before does not add to the uncertainty. Along a single wall nothing is, and odometry's
    /// stays.
    #[test]
    fn who_sees_the_same_again_errs_as_before() {
        let point = |x: f64, y: f64, normal: [f64; 2]| SurfacePoint {
            position: Vector2::new(x, y),
            normal: Some(normal.into()),
        };
        let wall: Vec<SurfacePoint> =
            (-30..=30).map(|k| point(0.1 * f64::from(k), 2.0, [0.0, 1.0])).collect();
        let other = (-30..=30).map(|k| point(2.0, 0.1 * f64::from(k), [1.0, 0.0]));
        let room: Vec<SurfacePoint> = wall.iter().copied().chain(other).collect();
        let odometry = UncertainPose {
            mean: Pose::IDENTITY,
            covariance: Covariance::from_standard_deviations(1.0, 1.0, 1.0).unwrap(),
        };
        let options = MatchOptions { floor: (0.0, 0.0), ..MatchOptions::default() };
        let variances = |surfaces: &[SurfacePoint], new: f64| {
            let mut cloud = Cloud::default();
            cloud.insert(Pose::IDENTITY, surfaces, 0.04);
            let found = align(&cloud, surfaces, Pose::IDENTITY, &odometry, new, &options);
            found.covariance.matrix().diagonal()
        };
        let (whole, part) = (variances(&room, 1.0), variances(&room, 0.1));
        assert!((part.component_div(&whole).add_scalar(-0.1)).amax() < 0.01, "{whole} {part}");
        let (whole, part) = (variances(&wall, 1.0), variances(&wall, 0.1));
        assert!((whole.x - 1.0).abs() < 1e-6 && (part.x - 1.0).abs() < 1e-6, "{whole} {part}");
        assert!((part.y / whole.y - 0.1).abs() < 0.01, "{whole} {part}");
    }
}
