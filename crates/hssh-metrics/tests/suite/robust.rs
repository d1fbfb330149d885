//! Robust solving: kernels are what they say, and wrong closures are found.

use hssh_metrics::{
    Covariance, Edge, Kernel, Options, Pose, PoseGraph, PoseId, chordal_poses, odometry_poses,
    screen_closures, solve, solve_robustly,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{distance, generic_covariance, random_graph};

const KERNELS: [Kernel; 3] = [Kernel::Huber(1.5), Kernel::Cauchy(1.5), Kernel::DynamicCovarianceScaling(2.0)];

fn is_closure(edge: &Edge) -> bool {
    edge.from.0 + 1 != edge.to.0
}

/// The same graph with some closures that claim an arbitrary position and a wrong heading.
fn with_wrong_closures(graph: &PoseGraph, count: usize) -> PoseGraph {
    let mut random = ChaCha8Rng::seed_from_u64(77);
    let mut graph = graph.clone();
    let poses = graph.poses().len() as u32;
    for _ in 0..count {
        let from = random.random_range(0..poses / 2);
        let to = random.random_range(poses / 2 + 2..poses);
        let truth = graph.pose(PoseId(from)).between(graph.pose(PoseId(to)));
        let turn = random.random_range(-1.0..1.0);
        let claim =
            Pose::new(random.random_range(-9.0..9.0), random.random_range(-9.0..9.0), truth.theta + turn);
        let covariance = generic_covariance(&mut random);
        graph.add_edge(Edge::observed(PoseId(from), PoseId(to), claim, &covariance)).unwrap();
    }
    graph
}

#[test]
fn weights_are_the_derivatives_of_costs() {
    for kernel in KERNELS {
        for chi2 in [0.0, 1e-6, 0.5, 2.0, 3.9, 4.1, 30.0, 1e6] {
            let step = 1e-5 * (1.0 + chi2);
            let low = f64::max(chi2 - step, 0.0);
            let numeric = (kernel.cost(chi2 + step) - kernel.cost(low)) / (chi2 + step - low);
            assert!((kernel.weight(chi2) - numeric).abs() < 1e-4, "{kernel:?} at {chi2}");
            assert!(kernel.cost(chi2) <= chi2);
        }
        assert_eq!((kernel.cost(0.0), kernel.weight(0.0)), (0.0, 1.0));
    }
}

#[test]
fn robust_solutions_are_stationary_and_cheaper_than_plain_ones() {
    let mut graph = with_wrong_closures(&random_graph(71, 30, 15, 0.02), 3);
    graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
    let plain = solve(&graph, &Options::default()).unwrap();
    for kernel in KERNELS {
        let options = Options { tolerance: 1e-12, max_iterations: 2000, ..Options::default() };
        let robust = solve_robustly(&graph, |edge| is_closure(edge).then_some(kernel), &options).unwrap();
        assert!(robust.converged, "{kernel:?}");
        let cost = |poses: &[Pose]| -> f64 {
            let cost = |edge: &Edge| {
                let chi2 = edge.chi2(poses[edge.from.index()], poses[edge.to.index()]);
                if is_closure(edge) { kernel.cost(chi2) } else { chi2 }
            };
            graph.edges().iter().map(cost).sum()
        };
        assert!((cost(&robust.poses) - robust.cost).abs() < 1e-8);
        assert!(robust.cost < cost(&plain.poses));
        for pose in 1..30 {
            for (x, y, theta) in [(1e-3, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, 0.0, 1e-3)] {
                for sign in [-1.0, 1.0] {
                    let mut moved = robust.poses.clone();
                    moved[pose].x += sign * x;
                    moved[pose].y += sign * y;
                    moved[pose].theta += sign * theta;
                    assert!(cost(&moved) > robust.cost, "{kernel:?}");
                }
            }
        }
    }
}

#[test]
fn kernels_leave_a_graph_alone_that_has_no_outliers() {
    let graph = random_graph(81, 20, 8, 0.001);
    let plain = solve(&graph, &Options::default()).unwrap();
    for kernel in [Kernel::Huber(3.0), Kernel::DynamicCovarianceScaling(3.0)] {
        let robust = solve_robustly(&graph, |_| Some(kernel), &Options::default()).unwrap();
        assert!((robust.cost - plain.chi2).abs() < 1e-8);
        assert!(robust.weights.iter().all(|&weight| weight == 1.0));
    }
}

#[test]
fn wrong_closures_are_found_and_the_map_is_as_if_they_were_not_there() {
    for seed in [1, 2, 3] {
        let clean = random_graph(seed, 60, 25, 0.05);
        let mut graph = with_wrong_closures(&clean, 8);
        graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
        let screening = screen_closures(&graph, is_closure, 11.34, &Options::default()).unwrap();
        let right = clean.edges().len();
        let expected: Vec<bool> = (0..graph.edges().len()).map(|edge| edge < right).collect();
        assert_eq!(screening.accepted, expected);
        let mut without = clean.clone();
        without.set_poses(chordal_poses(&clean).unwrap()).unwrap();
        let without = solve(&without, &Options::default()).unwrap();
        assert!((screening.solution.chi2 - without.chi2).abs() < 1e-6);
        for (a, b) in screening.solution.poses.iter().zip(&without.poses) {
            assert!(distance(*a, *b) < 1e-4);
        }
    }
}

#[test]
fn a_graph_without_suspects_or_doubts_is_only_solved() {
    let graph = random_graph(91, 12, 4, 0.01);
    let plain = solve(&graph, &Options::default()).unwrap();
    for suspicious in [false, true] {
        let screening = screen_closures(&graph, |_| suspicious, 1e6, &Options::default()).unwrap();
        assert!(screening.accepted.iter().all(|&accepted| accepted));
        assert!((screening.solution.chi2 - plain.chi2).abs() < 1e-8);
    }
}

#[test]
fn thresholds_that_are_none_refuse_all_that_is_not_perfect() {
    let graph = random_graph(91, 12, 4, 0.01);
    for threshold in [0.0, -1.0, f64::NAN] {
        let screening = screen_closures(&graph, is_closure, threshold, &Options::default()).unwrap();
        assert_eq!(screening.accepted.iter().filter(|&&accepted| accepted).count(), 11);
        assert!(screening.solution.chi2 < 1e-9);
    }
}

/// Laps around a ring, whose heading drifts far between closures, with half as many wrong closures as right ones: no wrong one is
/// believed, and hardly a right one refused.
#[test]
fn where_a_long_chain_drifts_right_closures_are_believed_again() {
    const RING: usize = 80;
    const LAPS: usize = 12;
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut noise = |deviation: f64| deviation * random.sample::<f64, _>(rand_distr::StandardNormal);
    let covariance = Covariance::from_standard_deviations(0.05, 0.05, 0.01).unwrap();
    let turn = std::f64::consts::TAU / RING as f64;
    let mut graph = PoseGraph::new();
    for _ in 0..RING * LAPS {
        graph.add_pose(Pose::IDENTITY);
    }
    let id = |index: usize| PoseId(index as u32);
    let mut measure = |graph: &mut PoseGraph, from: usize, to: usize, pose: Pose| {
        let pose = Pose::new(pose.x + noise(0.05), pose.y + noise(0.05), pose.theta + noise(0.01));
        graph.add_edge(Edge::observed(id(from), id(to), pose, &covariance)).unwrap();
    };
    for index in 1..RING * LAPS {
        measure(&mut graph, index - 1, index, Pose::new(1.0, 0.0, turn));
    }
    let right = 60;
    for closure in 0..right {
        let later = RING + closure * (RING * (LAPS - 1) - 1) / right;
        measure(&mut graph, later - RING, later, Pose::IDENTITY);
    }
    for wrong in 0..right / 2 {
        let (from, to) = (wrong * 13 % 400, 450 + wrong * 17 % 500);
        measure(&mut graph, from, to, Pose::new(0.3, -0.2, 0.1 * wrong as f64));
    }
    graph.anchor(id(0)).unwrap();
    let start = odometry_poses(&graph).unwrap();
    graph.set_poses(start).unwrap();
    let screening = screen_closures(&graph, is_closure, 11.34, &Options::default()).unwrap();
    let closures = &screening.accepted[RING * LAPS - 1..];
    let believed = |part: &[bool]| part.iter().filter(|&&accepted| accepted).count();
    assert_eq!(believed(&closures[right..]), 0, "wrong ones");
    assert!(believed(&closures[..right]) >= right - 3, "{} of {right}", believed(&closures[..right]));
}
