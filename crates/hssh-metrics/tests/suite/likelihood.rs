//! Marginals against a numeric Hessian, the price of a closure against solving again, and the evidence
//! against integrals that are known.

use hssh_metrics::{
    Edge, LinearizationPoint, LinearizedEdge, Marginals, Options, Pose, PoseGraph, PoseId, UniformPrior,
    laplace_log_evidence, metrical_log_likelihood, solve,
};
use nalgebra::{DMatrix, DVector, Matrix3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::{generic_covariance, random_graph};

/// The second derivatives of χ²/2 by the free coordinates, by differences of χ² alone.
fn numeric_hessian(graph: &PoseGraph) -> DMatrix<f64> {
    let unknowns = 3 * (graph.poses().len() - 1);
    let step = 1e-3;
    let chi2 = |moves: [(usize, f64); 2]| {
        let mut poses = graph.poses().to_vec();
        for (unknown, by) in moves {
            let pose = &mut poses[1 + unknown / 3];
            match unknown % 3 {
                0 => pose.x += by,
                1 => pose.y += by,
                _ => pose.theta += by,
            }
        }
        graph.chi2_at(&poses)
    };
    DMatrix::from_fn(unknowns, unknowns, |i, j| {
        let mixed = |a: f64, b: f64| chi2([(i, a * step), (j, b * step)]);
        (mixed(1.0, 1.0) - mixed(1.0, -1.0) - mixed(-1.0, 1.0) + mixed(-1.0, -1.0)) / (8.0 * step * step)
    })
}

#[test]
fn marginals_are_the_inverse_of_the_hessian_where_all_measurements_agree() {
    for poses in [6, 24] {
        let graph = random_graph(31, poses, 5, 0.0);
        let marginals = Marginals::new(&graph).unwrap();
        let hessian = numeric_hessian(&graph);
        let log_determinant = 2.0 * hessian.clone().cholesky().unwrap().l().diagonal().map(f64::ln).sum();
        assert!((marginals.log_determinant() - log_determinant).abs() < 1e-2);
        let inverse = hessian.try_inverse().unwrap();
        let expected = |row: u32, column: u32| -> Matrix3<f64> {
            inverse.fixed_view::<3, 3>(3 * (row as usize - 1), 3 * (column as usize - 1)).into()
        };
        let (first, second) = (PoseId(2), PoseId(poses - 1));
        let joint = marginals.joint(first, second);
        let tolerance = 1e-2 * joint.amax();
        assert!((marginals.covariance(first) - expected(first.0, first.0)).amax() < tolerance);
        let cross: Matrix3<f64> = joint.fixed_view::<3, 3>(0, 3).into();
        assert!((cross - expected(first.0, second.0)).amax() < tolerance);
        assert_eq!(marginals.covariance(PoseId(0)), Matrix3::zeros());
    }
}

/// Along a chain nothing but the chain is known: the relative covariance is the compound of its links.
#[test]
fn relative_covariances_of_a_chain_are_compounded() {
    let graph = random_graph(41, 20, 0, 0.0);
    let marginals = Marginals::new(&graph).unwrap();
    let link = |edge: &Edge| hssh_metrics::UncertainPose {
        mean: edge.relative_pose,
        covariance: edge.start_frame_information().covariance().unwrap(),
    };
    let links: Vec<_> = graph.edges()[4..12].iter().map(link).collect();
    let compound = hssh_metrics::UncertainPose::compound(&links).unwrap().unwrap();
    let (mean, covariance) = marginals.relative(PoseId(4), PoseId(12));
    assert!(crate::distance(mean, compound.mean) < 1e-12);
    assert!((covariance - compound.covariance.matrix()).amax() < 1e-9 * covariance.amax());
}

#[test]
fn the_price_of_a_closure_is_what_solving_again_shows() {
    let mut graph = random_graph(51, 30, 10, 0.001);
    let before = solve(&graph, &Options::default()).unwrap();
    graph.set_poses(before.poses.clone()).unwrap();
    let covariance = generic_covariance(&mut ChaCha8Rng::seed_from_u64(1));
    let (from, to) = (PoseId(3), PoseId(25));
    let measured = graph.pose(from).between(graph.pose(to)).compose(Pose::new(0.01, -0.02, 0.01));
    let price = Marginals::new(&graph).unwrap().new_constraint(from, to, measured, &covariance).unwrap();
    graph.add_edge(Edge::observed(from, to, measured, &covariance)).unwrap();
    let after = solve(&graph, &Options::default()).unwrap();
    let rise = after.chi2 - before.chi2;
    assert!((price.chi2_rise - rise).abs() < 0.02 * rise, "{} {rise}", price.chi2_rise);
    let rise = after.log_determinant - before.log_determinant;
    assert!((price.log_determinant_rise - rise).abs() < 0.02 * rise, "{} {rise}", price.log_determinant_rise);
}

/// The rank-3 update against the whole linear system with the closure in it, (B.11), dense and solved by LU.
#[test]
fn the_price_of_a_closure_is_that_of_the_whole_linear_system() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for (seed, poses) in [(71, 8), (72, 30), (73, 100)] {
        let mut graph = random_graph(seed, poses, poses / 3, 0.02);
        let exactly = Options { tolerance: 1e-26, max_iterations: 30, ..Options::default() };
        graph.set_poses(solve(&graph, &exactly).unwrap().poses).unwrap();
        let (plain, tabulated) =
            (Marginals::new(&graph).unwrap(), Marginals::new(&graph).unwrap().tabulated());
        for (from, to) in [(0, poses - 1), (poses - 1, 2), (poses / 2, 1)] {
            let (from, to) = (PoseId(from), PoseId(to));
            let covariance = generic_covariance(&mut random);
            let measured = graph.pose(from).between(graph.pose(to)).compose(Pose::new(0.4, -0.3, 0.2));
            let expected = dense_price(&graph, &Edge::observed(from, to, measured, &covariance));
            for marginals in [&plain, &tabulated] {
                let price = marginals.new_constraint(from, to, measured, &covariance).unwrap();
                for (found, expected) in
                    [(price.chi2_rise, expected.0), (price.log_determinant_rise, expected.1)]
                {
                    assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{found} {expected}");
                }
            }
        }
    }
}

/// By how much the minimum of the linearized χ² and ln |A| rise when an edge is added to a graph at its minimum.
fn dense_price(graph: &PoseGraph, closure: &Edge) -> (f64, f64) {
    let size = 3 * graph.poses().len();
    let system = |edges: &[Edge]| {
        let (mut a, mut b, mut chi2) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size), 0.0);
        for edge in edges {
            let (start, end) = (graph.pose(edge.from), graph.pose(edge.to));
            let linearized = LinearizedEdge::new(edge, start, end, LinearizationPoint::Estimate);
            let mut jacobian = DMatrix::<f64>::zeros(3, size);
            jacobian.fixed_view_mut::<3, 3>(0, 3 * edge.from.index()).copy_from(&linearized.by_start);
            jacobian.fixed_view_mut::<3, 3>(0, 3 * edge.to.index()).copy_from(&linearized.by_end);
            let weight = edge.start_frame_information();
            a += jacobian.transpose() * weight.matrix() * &jacobian;
            b -= jacobian.transpose() * (weight.matrix() * linearized.residual);
            chi2 += linearized.residual.dot(&(weight.matrix() * linearized.residual));
        }
        let (a, b) = (a.view((3, 3), (size - 3, size - 3)).into_owned(), b.rows(3, size - 3).into_owned());
        let step = a.clone().lu().solve(&b).unwrap();
        let log_determinant: f64 = a.lu().u().diagonal().map(|entry| entry.abs().ln()).sum();
        (chi2 - b.dot(&step), log_determinant)
    };
    let edges = graph.edges().to_vec();
    let (before, after) = (system(&edges), system(&[edges, vec![*closure]].concat()));
    (after.0 - before.0, after.1 - before.1)
}

/// Every pose of a tree integrates out to one, whatever the covariances: what is left is the prior.
#[test]
fn the_evidence_of_a_tree_is_its_prior() {
    let prior = UniformPrior::over_area(1000.0).unwrap();
    for seed in 0..5 {
        let graph = random_graph(seed, 25, 0, 0.0);
        let solution = solve(&graph, &Options::default()).unwrap();
        let evidence = laplace_log_evidence(&graph, &solution, prior);
        assert!((evidence - 24.0 * prior.log_density()).abs() < 1e-8);
        assert!((prior.log_density() + (1000.0 * std::f64::consts::TAU).ln()).abs() < 1e-12);
    }
}

/// The evidence is a product over travels: a travel between known places contributes N(τ°; predicted, …).
#[test]
fn the_evidence_is_a_product_over_travels() {
    let prior = UniformPrior::over_area(100.0).unwrap();
    let mut graph = random_graph(61, 15, 0, 0.0);
    let covariance = generic_covariance(&mut ChaCha8Rng::seed_from_u64(2));
    let measured =
        graph.pose(PoseId(14)).between(graph.pose(PoseId(0))).compose(Pose::new(0.004, 0.002, -0.001));
    let marginals = Marginals::new(&graph).unwrap();
    let density = marginals.new_constraint(PoseId(14), PoseId(0), measured, &covariance).unwrap().log_density;
    graph.add_edge(Edge::observed(PoseId(14), PoseId(0), measured, &covariance)).unwrap();
    let solution = solve(&graph, &Options::default()).unwrap();
    let evidence = laplace_log_evidence(&graph, &solution, prior);
    assert!((evidence - (14.0 * prior.log_density() + density)).abs() < 1e-2);
    let peak = -0.5 * (3.0 * std::f64::consts::TAU.ln() + covariance.log_determinant());
    assert!(density <= peak, "no travel beats the peak of its own measurement");
}

/// By hand: one edge with unit covariance, 2 away along x.
#[test]
fn the_log_likelihood_has_its_constants() {
    let mut graph = PoseGraph::new();
    let (start, end) = (graph.add_pose(Pose::IDENTITY), graph.add_pose(Pose::new(3.0, 0.0, 0.0)));
    graph.anchor(start).unwrap();
    graph.anchor(end).unwrap();
    let unit = hssh_metrics::Covariance::from_standard_deviations(1.0, 1.0, 1.0).unwrap();
    graph.add_edge(Edge::observed(start, end, Pose::new(1.0, 0.0, 0.0), &unit)).unwrap();
    let expected = -1.5 * std::f64::consts::TAU.ln() - 2.0;
    assert!((metrical_log_likelihood(&graph, graph.chi2()) - expected).abs() < 1e-12);
}

#[test]
fn areas_that_are_none_are_refused() {
    for area in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(UniformPrior::over_area(area).is_err());
    }
}
