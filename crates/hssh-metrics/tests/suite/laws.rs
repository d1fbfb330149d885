//! SE(2) is a group, its exponential is the matrix exponential, and its derivatives are derivatives.

use hssh_metrics::{Pose, wrap_angle};
use nalgebra::{Matrix3, Vector3, matrix};

use crate::{AWKWARD_ANGLES, awkward_poses, distance, numeric_jacobian, vector};

/// The oracle: poses as homogeneous matrices.
fn homogeneous(pose: Pose) -> Matrix3<f64> {
    let (s, c) = pose.theta.sin_cos();
    matrix![c, -s, pose.x; s, c, pose.y; 0.0, 0.0, 1.0]
}

fn pose(vector: Vector3<f64>) -> Pose {
    Pose { x: vector.x, y: vector.y, theta: vector.z }
}

#[test]
fn operations_are_those_of_homogeneous_matrices() {
    for a in awkward_poses() {
        let inverse = homogeneous(a).try_inverse().unwrap();
        assert!((homogeneous(a.inverse()) - inverse).amax() < 1e-11);
        for b in awkward_poses() {
            assert!((homogeneous(a.compose(b)) - homogeneous(a) * homogeneous(b)).amax() < 1e-11);
            assert!((homogeneous(a.between(b)) - inverse * homogeneous(b)).amax() < 1e-11);
        }
    }
}

#[test]
fn group_laws_hold() {
    for a in awkward_poses() {
        assert!(distance(a.compose(Pose::IDENTITY), a) == 0.0);
        assert!(distance(Pose::IDENTITY.compose(a), a) == 0.0);
        assert!(distance(a.compose(a.inverse()), Pose::IDENTITY) < 1e-11);
        assert!(distance(a.inverse().inverse(), a) < 1e-11);
        for b in awkward_poses() {
            assert!(distance(a.compose(a.between(b)), b) < 1e-11);
            assert!(distance(a.compose(b).inverse(), b.inverse().compose(a.inverse())) < 1e-11);
            for c in awkward_poses() {
                assert!(distance(a.compose(b).compose(c), a.compose(b.compose(c))) < 2e-11);
            }
        }
    }
}

#[test]
fn angles_stay_wrapped() {
    let wrapped = |pose: Pose| -std::f64::consts::PI < pose.theta && pose.theta <= std::f64::consts::PI;
    for a in awkward_poses() {
        assert!(wrapped(a) && wrapped(a.inverse()));
        assert!(awkward_poses().into_iter().all(|b| wrapped(a.compose(b)) && wrapped(a.between(b))));
    }
}

#[test]
fn exp_is_the_matrix_exponential_and_log_undoes_it() {
    for theta in AWKWARD_ANGLES {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.3, -2.0), (-5.0, 1e-6)] {
            let twist = Vector3::new(x, y, theta);
            let generator = matrix![0.0, -theta, x; theta, 0.0, y; 0.0, 0.0, 0.0];
            let reached = Pose::exp(twist);
            assert!((homogeneous(reached) - generator.exp()).amax() < 1e-14 * 10.0, "{twist}");
            let logarithm = reached.log();
            assert!((logarithm - Vector3::new(x, y, wrap_angle(theta))).amax() < 1e-14 * 10.0, "{twist}");
        }
    }
    for a in awkward_poses() {
        assert!(distance(Pose::exp(a.log()), a) < 1e-11);
    }
}

#[test]
fn adjoint_carries_twists_through_a_pose() {
    let twist = Vector3::new(0.3, -0.2, 0.4);
    for a in awkward_poses() {
        let conjugated = a.compose(Pose::exp(twist)).compose(a.inverse());
        assert!(distance(conjugated, Pose::exp(a.adjoint() * twist)) < 1e-10);
    }
}

#[test]
fn jacobians_are_derivatives() {
    let near = |analytic: Matrix3<f64>, numeric: Matrix3<f64>| {
        assert!((analytic - numeric).amax() < 1e-7 * analytic.amax().max(1.0), "{analytic}{numeric}");
    };
    for a in awkward_poses() {
        let at = vector(a);
        near(a.inverse_jacobian(), numeric_jacobian(|v| vector(pose(v).inverse()), at));
        for b in awkward_poses() {
            let (by_a, by_b) = a.compose_jacobians(b);
            near(by_a, numeric_jacobian(|v| vector(pose(v).compose(b)), at));
            near(by_b, numeric_jacobian(|v| vector(a.compose(pose(v))), vector(b)));
            let (by_a, by_b) = a.between_jacobians(b);
            near(by_a, numeric_jacobian(|v| vector(pose(v).between(b)), at));
            near(by_b, numeric_jacobian(|v| vector(a.between(pose(v))), vector(b)));
        }
    }
}
