//! (B.6)–(B.8) against numeric derivatives, and the two conventions for errors against each other.

use hssh_metrics::{
    Covariance, Edge, Information, LinearizationPoint, LinearizedEdge, Method, Options, Pose, PoseId,
    odometry_poses, solve, wrap_angle,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3, matrix};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::{awkward_poses, distance, generic_covariance, numeric_jacobian, random_graph, vector};

fn pose(vector: Vector3<f64>) -> Pose {
    Pose { x: vector.x, y: vector.y, theta: vector.z }
}

fn edge(relative_pose: Pose) -> Edge {
    Edge { from: PoseId(0), to: PoseId(1), relative_pose, information: Information::identity() }
}

#[test]
fn s_and_e_are_the_derivatives_of_4_1() {
    for tau in awkward_poses() {
        for start in awkward_poses() {
            let measured_end = start.compose(tau); // (B.4)
            let end = measured_end.compose(Pose::new(0.3, -0.2, 0.1));
            for (point, at_end) in
                [(LinearizationPoint::Measurement, measured_end), (LinearizationPoint::Estimate, end)]
            {
                let linearized = LinearizedEdge::new(&edge(tau), start, end, point);
                let by_start = numeric_jacobian(|s| vector(pose(s).between(at_end)), vector(start));
                let by_end = numeric_jacobian(|e| vector(start.between(pose(e))), vector(at_end));
                let scale = by_start.amax().max(1.0);
                assert!((linearized.by_start - by_start).amax() < 1e-7 * scale);
                assert!((linearized.by_end - by_end).amax() < 1e-7 * scale);
            }
        }
    }
}

#[test]
fn a_perfect_edge_has_no_residual_even_after_many_turns() {
    for tau in awkward_poses() {
        for start in awkward_poses() {
            let mut end = start.compose(tau);
            end.theta += 3.0 * std::f64::consts::TAU;
            let linearized = LinearizedEdge::new(&edge(tau), start, end, LinearizationPoint::Measurement);
            assert!(linearized.residual.amax() < 1e-10);
            assert!(edge(tau).error(start, end).amax() < 1e-10);
        }
    }
}

/// Ω_thesis = R(θ) Ω R(θ)ᵀ: the thesis's quadratic form in the start frame equals g2o's in the end frame.
#[test]
fn the_two_conventions_give_the_same_chi2() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for tau in awkward_poses() {
        let covariance = generic_covariance(&mut random);
        let edge = Edge::observed(PoseId(0), PoseId(1), tau, &covariance);
        let start = Pose::new(0.4, 7.0, -2.2);
        let end = start.compose(tau).compose(Pose::new(0.2, -0.7, 0.4));
        let predicted = start.between(end);
        let difference =
            Vector3::new(predicted.x - tau.x, predicted.y - tau.y, wrap_angle(predicted.theta - tau.theta));
        let inverse: Matrix3<f64> = covariance.matrix().try_inverse().unwrap();
        let thesis = difference.dot(&(inverse * difference));
        assert!((edge.chi2(start, end) - thesis).abs() < 1e-9 * thesis);
        assert!((edge.start_frame_information().matrix() - inverse).amax() < 1e-9 * inverse.amax());
    }
}

/// By hand: after a measured left turn, an error along the start's x axis is weighted with σ_x, although it
/// lies along the end's y axis.
#[test]
fn observed_covariances_belong_to_the_start_frame() {
    let covariance = Covariance::from_standard_deviations(0.5, 0.1, 0.2).unwrap();
    let tau = Pose::new(2.0, 1.0, std::f64::consts::FRAC_PI_2);
    let edge = Edge::observed(PoseId(0), PoseId(1), tau, &covariance);
    assert!((edge.chi2(Pose::IDENTITY, Pose { x: 3.0, ..tau }) - 4.0).abs() < 1e-12);
    assert!((edge.chi2(Pose::IDENTITY, Pose { y: 2.0, ..tau }) - 100.0).abs() < 1e-10);
    assert!(
        (edge.error(Pose::IDENTITY, Pose { x: 3.0, ..tau }) - Vector3::new(0.0, -1.0, 0.0)).amax() < 1e-15
    );
    let swapped = covariance.rotated(-std::f64::consts::FRAC_PI_2).information();
    assert!((edge.information.matrix() - swapped.matrix()).amax() < 1e-10);
}

/// (B.9) at the linearization point itself is χ².
#[test]
fn residuals_weigh_up_to_chi2() {
    let graph = random_graph(5, 12, 6, 0.3);
    let weigh = |edge: &Edge| {
        let (start, end) = (graph.pose(edge.from), graph.pose(edge.to));
        let residual = LinearizedEdge::new(edge, start, end, LinearizationPoint::Measurement).residual;
        residual.dot(&(edge.start_frame_information().matrix() * residual))
    };
    let sum: f64 = graph.edges().iter().map(weigh).sum();
    assert!((sum - graph.chi2()).abs() < 1e-10 * sum);
}

/// (B.11), (B.12) and (B.15) to the letter: dense, with absolute poses, S and E written out.
#[test]
fn linearizing_once_solves_the_equations_of_appendix_b() {
    let mut graph = random_graph(13, 14, 7, 0.1);
    graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
    let size = 3 * graph.poses().len();
    let (mut a, mut b) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size));
    let mut linear_edges = Vec::new();
    for edge in graph.edges() {
        let (start, end) = (graph.pose(edge.from), graph.pose(edge.to));
        let tau = edge.relative_pose;
        let mut l_e = vector(start.compose(tau)); // (B.4)
        l_e.z = end.theta - wrap_angle(end.theta - l_e.z);
        let (sin, cos) = start.theta.sin_cos();
        let s = matrix![-cos, -sin, tau.y; sin, -cos, -tau.x; 0.0, 0.0, -1.0]; // (B.7)
        let e = matrix![cos, sin, 0.0; -sin, cos, 0.0; 0.0, 0.0, 1.0]; // (B.8)
        let weight = *edge.start_frame_information().matrix();
        let constant = s * vector(start) + e * l_e;
        for (row, j) in [(edge.from, s), (edge.to, e)] {
            for (column, k) in [(edge.from, s), (edge.to, e)] {
                let mut block = a.fixed_view_mut::<3, 3>(3 * row.index(), 3 * column.index());
                block += j.transpose() * weight * k; // (B.11)
            }
            let mut block = b.fixed_rows_mut::<3>(3 * row.index());
            block += j.transpose() * weight * constant; // (B.12)
        }
        linear_edges.push((edge.from, edge.to, s, e, weight, constant));
    }
    let fixed = vector(graph.pose(PoseId(0)));
    let free = a.view((3, 3), (size - 3, size - 3)).into_owned();
    let known = b.rows(3, size - 3) - a.view((3, 0), (size - 3, 3)) * fixed;
    let solved = free.clone().lu().solve(&known).unwrap(); // (B.15)
    let pose = |id: PoseId| match id.index() {
        0 => fixed,
        index => solved.fixed_rows::<3>(3 * index - 3).into_owned(),
    };
    let mut linearized_chi2 = 0.0;
    for (from, to, s, e, weight, constant) in linear_edges {
        let error = s * pose(from) + e * pose(to) - constant;
        linearized_chi2 += error.dot(&(weight * error)); // (B.9)
    }

    let solution = solve(&graph, &Options { method: Method::LinearizeOnce, ..Options::default() }).unwrap();
    for id in graph.pose_ids() {
        let expected = pose(id);
        assert!(distance(solution.poses[id.index()], Pose::new(expected.x, expected.y, expected.z)) < 1e-9);
    }
    assert!((solution.linearized_chi2 - linearized_chi2).abs() < 1e-8 * (1.0 + linearized_chi2));
    assert!((solution.log_determinant - free.determinant().ln()).abs() < 1e-8);
}
