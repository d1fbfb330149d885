//! What hssh-metrics promises, checked from outside.

// In tests a failed unwrap is the failed assertion, in their helpers too.
#![allow(clippy::unwrap_used)]

mod bayes_network;
mod laws;
mod likelihood;
mod linearization;
mod optima;
mod robust;
mod solving;
mod text;
mod uncertainty;

use hssh_metrics::{Covariance, Edge, Pose, PoseGraph, PoseId};
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Angles of both signs, near zero, near half turns, and around a right angle.
const AWKWARD_ANGLES: [f64; 15] = [
    0.0,
    1e-300,
    -1e-9,
    1e-5,
    -1e-5,
    0.3,
    -0.3,
    1.5,
    -std::f64::consts::FRAC_PI_2,
    2.0,
    -2.0,
    std::f64::consts::PI - 1e-8,
    1e-8 - std::f64::consts::PI,
    std::f64::consts::PI,
    -3.0,
];

/// Poses with every awkward angle, at the origin, nearby, and far away.
fn awkward_poses() -> Vec<Pose> {
    let positions = [(0.0, 0.0), (1.0, -2.0), (-1e-9, 1e-3), (100.0, 3.0)];
    let pose = |(x, y)| AWKWARD_ANGLES.iter().map(move |&theta| Pose::new(x, y, theta));
    positions.into_iter().flat_map(pose).collect()
}

fn vector(pose: Pose) -> Vector3<f64> {
    Vector3::new(pose.x, pose.y, pose.theta)
}

/// The distance of two poses, angles compared around the circle.
fn distance(a: Pose, b: Pose) -> f64 {
    let turn = (a.theta - b.theta).sin().abs() + (1.0 - (a.theta - b.theta).cos());
    (a.x - b.x).abs() + (a.y - b.y).abs() + turn
}

/// A covariance with nothing special about it.
fn generic_covariance(random: &mut ChaCha8Rng) -> Covariance {
    let root = Matrix3::from_fn(|_, _| random.random_range(-0.2..0.2));
    Covariance::new(root * root.transpose() + Matrix3::identity() * 0.01).unwrap()
}

/// A connected graph: a chain of generic relative poses with closures, each measured with noise of about
/// `noise`; pose 0 is anchored, and the poses are the true ones.
fn random_graph(seed: u64, poses: u32, closures: u32, noise: f64) -> PoseGraph {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut graph = PoseGraph::new();
    let mut here = Pose::new(3.0, -1.0, 2.5);
    for _ in 0..poses {
        graph.add_pose(here);
        let turn = random.random_range(-1.0..1.0) * std::f64::consts::PI;
        here = here.compose(Pose::new(random.random_range(0.5..2.0), random.random_range(-0.5..0.5), turn));
    }
    graph.anchor(PoseId(0)).unwrap();
    let chain = (1..poses).map(|end| (end - 1, end)).collect::<Vec<_>>();
    let closures: Vec<_> = (0..closures)
        .map(|_| {
            let from = random.random_range(0..poses - 1);
            (random.random_range(from + 1..poses), from)
        })
        .collect();
    for (from, to) in chain.into_iter().chain(closures) {
        let (from, to) = (PoseId(from), PoseId(to));
        let error = Pose::exp(Vector3::from_fn(|_, _| noise * random.random_range(-1.0..1.0)));
        let relative_pose = graph.pose(from).between(graph.pose(to)).compose(error);
        let covariance = generic_covariance(&mut random);
        graph.add_edge(Edge::observed(from, to, relative_pose, &covariance)).unwrap();
    }
    graph
}

/// The derivative of a function of three numbers by central differences.
fn numeric_jacobian(f: impl Fn(Vector3<f64>) -> Vector3<f64>, at: Vector3<f64>) -> Matrix3<f64> {
    let mut jacobian = Matrix3::zeros();
    for axis in 0..3 {
        let step = 1e-6 * at[axis].abs().max(1.0);
        let mut offset = Vector3::zeros();
        offset[axis] = step;
        let mut difference = f(at + offset) - f(at - offset);
        difference.z = hssh_metrics::wrap_angle(difference.z);
        jacobian.set_column(axis, &(difference / (2.0 * step)));
    }
    jacobian
}
