//! Solvers: exact where the problem is linear, stationary elsewhere, and never silent about what has no answer.

use hssh_metrics::{
    Edge, GraphError, Information, Kernel, Method, Options, Pose, PoseGraph, PoseId, SolveError, StopReason,
    chordal_poses, odometry_poses, relax, screen_closures, solve, solve_robustly,
};
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{distance, generic_covariance, random_graph};

const METHODS: [Method; 4] =
    [Method::LinearizeOnce, Method::GaussNewton, Method::LevenbergMarquardt, Method::Safeguarded];
const ITERATED: [Method; 3] = [Method::GaussNewton, Method::LevenbergMarquardt, Method::Safeguarded];

fn sweeps(max_iterations: usize, tolerance: f64) -> Options {
    Options { max_iterations, tolerance, ..Options::default() }
}

fn with(method: Method) -> Options {
    Options { method, ..Options::default() }
}

fn edge(from: u32, to: u32, relative_pose: Pose) -> Edge {
    Edge { from: PoseId(from), to: PoseId(to), relative_pose, information: Information::identity() }
}

/// Anchored poses that look along the x axis, one free pose seen from all of them: π_e = weighted mean.
#[test]
fn a_linear_problem_is_solved_exactly_in_one_step() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut graph = PoseGraph::new();
    let free = graph.add_pose(Pose::new(10.0, 10.0, -1.0));
    let (mut weights, mut weighted) = (Matrix3::zeros(), Vector3::zeros());
    for i in 0..5 {
        let observer = graph.add_pose(Pose::new(f64::from(i), 0.5 * f64::from(i), 0.0));
        graph.anchor(observer).unwrap();
        let wanted = Vector3::new(2.0 + 0.1 * f64::from(i), 3.0, 0.2 * f64::from(i));
        let measured = Pose::new(wanted.x - f64::from(i), wanted.y - 0.5 * f64::from(i), wanted.z);
        let covariance = generic_covariance(&mut random);
        graph.add_edge(Edge::observed(observer, free, measured, &covariance)).unwrap();
        let weight = covariance.matrix().try_inverse().unwrap();
        weights += weight;
        weighted += weight * wanted;
    }
    let mean = weights.try_inverse().unwrap() * weighted;
    for method in METHODS {
        let solution = solve(&graph, &with(method)).unwrap();
        assert!(distance(solution.poses[free.index()], Pose::new(mean.x, mean.y, mean.z)) < 1e-12);
        assert!((solution.log_determinant - weights.determinant().ln()).abs() < 1e-10);
        assert!((solution.chi2 - solution.linearized_chi2).abs() < 1e-9);
    }
}

#[test]
fn without_noise_every_method_finds_the_truth_from_edges_alone() {
    for (seed, poses) in [(1, 5), (2, 16), (3, 60), (4, 200)] {
        let truth = random_graph(seed, poses, poses / 3, 0.0);
        for start in [odometry_poses(&truth).unwrap(), chordal_poses(&truth).unwrap()] {
            for method in METHODS {
                let mut graph = truth.clone();
                graph.set_poses(start.clone()).unwrap();
                let solution = solve(&graph, &with(method)).unwrap();
                assert!(solution.chi2 < 1e-15, "{method:?} {}", solution.chi2);
                let worst = solution
                    .poses
                    .iter()
                    .zip(truth.poses())
                    .map(|(a, b)| distance(*a, *b))
                    .fold(0.0, f64::max);
                assert!(worst < 1e-8, "{worst}");
            }
        }
    }
}

/// No coordinate of any pose can be moved to lower χ²: checked with the error function alone.
#[test]
fn solutions_are_stationary() {
    for (seed, poses, noise) in [(1, 8, 0.05), (2, 40, 0.05), (3, 120, 0.02)] {
        let mut graph = random_graph(seed, poses, poses / 2, noise);
        graph.set_poses(chordal_poses(&graph).unwrap()).unwrap();
        for method in ITERATED {
            let solution = solve(&graph, &with(method)).unwrap();
            assert!(solution.is_converged());
            assert!((solution.chi2 - graph.chi2_at(&solution.poses)).abs() < 1e-9);
            for pose in 1..poses as usize {
                for axis in 0..3 {
                    let moved = |step: f64| {
                        let mut poses = solution.poses.clone();
                        match axis {
                            0 => poses[pose].x += step,
                            1 => poses[pose].y += step,
                            _ => poses[pose].theta += step,
                        }
                        graph.chi2_at(&poses)
                    };
                    assert!(moved(1e-4) > solution.chi2 && moved(-1e-4) > solution.chi2);
                }
            }
        }
    }
}

/// Moving the whole world changes neither χ² nor ln |A|: only the anchor knows where it is.
#[test]
fn the_answer_does_not_depend_on_the_frame() {
    let graph = random_graph(9, 70, 30, 0.05);
    let reference = solve(&graph, &Options::default()).unwrap();
    for frame in [Pose::new(100.0, -50.0, 3.1), Pose::new(0.0, 0.0, -1.6), Pose::new(-3.0, 8.0, 0.0)] {
        let mut moved = graph.clone();
        moved.set_poses(graph.poses().iter().map(|&pose| frame.compose(pose)).collect()).unwrap();
        let solution = solve(&moved, &Options::default()).unwrap();
        assert!((solution.chi2 - reference.chi2).abs() < 1e-9 * reference.chi2);
        assert!((solution.log_determinant - reference.log_determinant).abs() < 1e-6);
        for (there, here) in solution.poses.iter().zip(&reference.poses) {
            assert!(distance(*there, frame.compose(*here)) < 1e-6);
        }
    }
}

/// A corridor loop walked four times round: headings pass ±π again and again.
#[test]
fn loops_close_however_often_they_turn() {
    let mut graph = PoseGraph::new();
    let side = Pose::new(5.0, 0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..4 {
        graph.add_pose(Pose::IDENTITY);
    }
    graph.anchor(PoseId(0)).unwrap();
    for _ in 0..4 {
        for start in 0..4 {
            let measured = side.compose(Pose::new(0.01, 0.0, 0.002));
            graph.add_edge(edge(start, (start + 1) % 4, measured)).unwrap();
        }
    }
    graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
    for method in METHODS {
        let solution = solve(&graph, &with(method)).unwrap();
        assert!(solution.chi2 < 16.0 * 0.02 * 0.02, "{method:?}: {}", solution.chi2);
    }
}

#[test]
fn floating_components_are_refused_and_anchoring_them_helps() {
    let mut graph = random_graph(1, 6, 2, 0.1);
    let island = graph.add_pose(Pose::new(50.0, 50.0, 0.0));
    let friend = graph.add_pose(Pose::new(51.0, 50.0, 0.0));
    graph.add_edge(edge(friend.0, island.0, Pose::new(1.0, 0.0, 3.0))).unwrap();
    let expected = SolveError::Unanchored { first: island, poses: 2 };
    for method in METHODS {
        assert_eq!(solve(&graph, &with(method)), Err(expected));
    }
    assert_eq!(odometry_poses(&graph), Err(expected));
    assert_eq!(chordal_poses(&graph), Err(expected));
    assert_eq!(relax(&graph, &sweeps(10, 1e-9)), Err(expected));
    assert_eq!(graph.anchor_components(), [island]);
    assert!(solve(&graph, &Options::default()).unwrap().is_converged());
    assert_eq!(graph.components().len(), 2);
}

#[test]
fn graphs_without_unknowns_are_solved_already() {
    let mut graph = PoseGraph::new();
    for method in METHODS {
        assert_eq!(solve(&graph, &with(method)).unwrap().chi2, 0.0);
    }
    graph.add_pose(Pose::IDENTITY);
    graph.add_pose(Pose::new(1.0, 0.0, 0.0));
    graph.add_edge(edge(0, 1, Pose::new(2.0, 0.0, 0.0))).unwrap();
    graph.anchor(PoseId(0)).unwrap();
    graph.anchor(PoseId(1)).unwrap();
    for method in METHODS {
        let solution = solve(&graph, &with(method)).unwrap();
        assert_eq!((solution.chi2, solution.log_determinant), (1.0, 0.0));
    }
    assert_eq!(chordal_poses(&graph).unwrap(), graph.poses());
    assert_eq!(odometry_poses(&graph).unwrap(), graph.poses());
}

#[test]
fn bad_edges_and_poses_are_refused() {
    let mut graph = random_graph(1, 4, 0, 0.0);
    assert_eq!(
        graph.add_edge(edge(0, 4, Pose::IDENTITY)),
        Err(GraphError::NoSuchPose { pose: PoseId(4), poses: 4 })
    );
    assert_eq!(graph.add_edge(edge(2, 2, Pose::IDENTITY)), Err(GraphError::Loop(PoseId(2))));
    for bad in [f64::NAN, f64::INFINITY] {
        let refused = graph.add_edge(edge(0, 1, Pose { x: bad, ..Pose::IDENTITY }));
        assert!(matches!(refused, Err(GraphError::NotFinite { .. })));
        let mut graph = graph.clone();
        graph.set_pose(PoseId(2), Pose { theta: bad, ..Pose::IDENTITY }).unwrap();
        assert!(matches!(
            solve(&graph, &Options::default()),
            Err(SolveError::NotFinite { pose: PoseId(2), .. })
        ));
    }
    assert_eq!(graph.anchor(PoseId(9)), Err(GraphError::NoSuchPose { pose: PoseId(9), poses: 4 }));
    assert_eq!(graph.set_poses(Vec::new()), Err(GraphError::PoseCount { given: 0, poses: 4 }));
}

#[test]
fn contradictions_and_extremes_end_with_a_defined_answer() {
    let contradictory = [Pose::new(1.0, 0.0, 0.0), Pose::new(-1.0, 0.0, std::f64::consts::PI)];
    let extreme = [Pose::new(1e150, 0.0, 0.0), Pose::new(-1e150, 1e150, 1.0)];
    let hopeless = [Pose::new(1e200, 0.0, 0.0), Pose::new(-1e200, 0.0, 1.0)];
    for measurements in [contradictory, extreme, hopeless] {
        let mut graph = PoseGraph::new();
        for _ in 0..3 {
            graph.add_pose(Pose::IDENTITY);
        }
        graph.anchor(PoseId(0)).unwrap();
        for measured in measurements {
            graph.add_edge(edge(0, 1, measured)).unwrap();
            graph.add_edge(edge(2, 1, measured)).unwrap();
        }
        for method in METHODS {
            match solve(&graph, &with(method)) {
                Ok(solution) => {
                    assert!(solution.chi2.is_finite() && solution.poses.iter().all(|pose| pose.is_finite()));
                }
                Err(error) => assert!(matches!(error, SolveError::Overflow | SolveError::Singular)),
            }
        }
    }
}

#[test]
fn limits_are_kept_and_reported() {
    let mut graph = random_graph(4, 30, 20, 0.2);
    graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
    for method in ITERATED {
        let none = solve(&graph, &Options { max_iterations: 0, ..with(method) }).unwrap();
        assert_eq!((none.stop, none.iterations), (StopReason::MaxIterations, 0));
        assert_eq!(none.poses, graph.poses());
        let one = solve(&graph, &Options { max_iterations: 1, ..with(method) }).unwrap();
        assert_eq!((one.stop, one.iterations), (StopReason::MaxIterations, 1));
    }
}

/// Even from poses that have nothing to do with the measurements, where Gauss–Newton alone may end higher.
#[test]
fn the_guarded_methods_never_end_above_their_start() {
    let mut random = ChaCha8Rng::seed_from_u64(99);
    for seed in 0..30 {
        let mut graph = random_graph(seed, 15, 10, 0.3);
        for pose in 1..15 {
            let anywhere = Pose::exp(Vector3::from_fn(|_, _| random.random_range(-3.0..3.0)));
            graph.set_pose(PoseId(pose), anywhere).unwrap();
        }
        for method in [Method::LevenbergMarquardt, Method::Safeguarded] {
            for max_iterations in [1, 3, 100] {
                let options = Options { method, max_iterations, ..Options::default() };
                let solution = solve(&graph, &options).unwrap();
                assert!(solution.chi2 <= solution.initial_chi2, "{method:?}");
                assert!(
                    (solution.chi2 - graph.chi2_at(&solution.poses)).abs() < 1e-9 * (1.0 + solution.chi2)
                );
            }
        }
    }
}

/// χ² at the optimum never falls when measurements are added: what makes it a bound for searches.
#[test]
fn chi2_grows_with_the_graph() {
    let full = random_graph(21, 40, 25, 0.03);
    let mut graph = PoseGraph::new();
    for &pose in full.poses() {
        graph.add_pose(pose);
    }
    graph.anchor(PoseId(0)).unwrap();
    let mut before = 0.0;
    for (index, &edge) in full.edges().iter().enumerate() {
        graph.add_edge(edge).unwrap();
        if index >= 39 {
            let solution = solve(&graph, &Options::default()).unwrap();
            assert!(solution.chi2 >= before - 1e-9);
            before = solution.chi2;
        }
    }
}

/// Relaxation shares no linear algebra with the solvers, and ends where they end.
#[test]
fn relaxation_agrees_with_solving() {
    for (seed, poses) in [(1, 6), (2, 25), (3, 50)] {
        let mut graph = random_graph(seed, poses, poses / 2, 0.05);
        graph.set_poses(chordal_poses(&graph).unwrap()).unwrap();
        let solution = solve(&graph, &Options::default()).unwrap();
        let relaxation = relax(&graph, &sweeps(100_000, 1e-13)).unwrap();
        assert!(relaxation.converged);
        assert!(relaxation.chi2 >= solution.chi2 - 1e-9);
        assert!(relaxation.chi2 - solution.chi2 < 1e-6, "{} {}", relaxation.chi2, solution.chi2);
        for (relaxed, solved) in relaxation.poses.iter().zip(&solution.poses) {
            assert!(distance(*relaxed, *solved) < 1e-3);
        }
        let few = relax(&graph, &sweeps(2, 0.0)).unwrap();
        assert!((few.sweeps, few.converged) == (2, false) && few.chi2 <= graph.chi2());
    }
}

/// Whoever asks it to stop gets the poses reached: those of the start, if it is asked at once.
#[test]
fn interrupted() {
    let mut graph = random_graph(3, 20, 8, 0.1);
    let start = odometry_poses(&graph).unwrap();
    graph.set_poses(start.clone()).unwrap();
    for method in [Method::GaussNewton, Method::LevenbergMarquardt, Method::Safeguarded] {
        let options = Options { interrupted: || true, ..with(method) };
        let solution = solve(&graph, &options).unwrap();
        assert_eq!((solution.stop, &solution.poses), (StopReason::Interrupted, &start));
        assert!(!solution.is_converged());
    }
    let options = Options { interrupted: || true, ..Options::default() };
    assert_eq!(relax(&graph, &options).unwrap().sweeps, 0);
    let robust = solve_robustly(&graph, |_| Some(Kernel::Huber(1.0)), &options).unwrap();
    assert_eq!((robust.rounds, robust.converged), (1, false));
    assert_eq!(screen_closures(&graph, |_| true, 11.34, &options).unwrap().rounds, 1);
}
