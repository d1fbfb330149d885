//! Robust kernels: measurements that may be wrong count the less the worse they fit.

use crate::graph::{Edge, PoseGraph};
use crate::pose::Pose;
use crate::solution::{Options, SolveError};
use crate::solve::solve;

/// A concave function ρ that takes the place of an edge's χ²: ρ(s) ≈ s while s is small.
///
/// The parameter of each is a number of standard deviations; it must be positive.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kernel {
    /// Grows like √s beyond k²: a bad measurement pulls with a constant force. One minimum if the plain
    /// problem has one.
    Huber(f64),
    /// k² ln(1 + s/k²): a bad measurement pulls the less the worse it is.
    Cauchy(f64),
    /// Dynamic covariance scaling with Φ = k²: never exceeds 3 k², so that a very bad measurement is switched off.
    DynamicCovarianceScaling(f64),
}

impl Kernel {
    /// ρ(χ²).
    #[must_use]
    pub fn cost(self, chi2: f64) -> f64 {
        match self {
            Kernel::Huber(k) if chi2 <= k * k => chi2,
            Kernel::Huber(k) => 2.0 * k * chi2.sqrt() - k * k,
            Kernel::Cauchy(k) => k * k * (chi2 / (k * k)).ln_1p(),
            Kernel::DynamicCovarianceScaling(k) if chi2 <= k * k => chi2,
            Kernel::DynamicCovarianceScaling(k) => k * k * (3.0 * chi2 - k * k) / (chi2 + k * k),
        }
    }

    /// ρ′(χ²), in (0, 1]: the factor by which the information counts.
    #[must_use]
    pub fn weight(self, chi2: f64) -> f64 {
        match self {
            Kernel::Huber(k) => (k / chi2.sqrt()).min(1.0),
            Kernel::Cauchy(k) => 1.0 / (1.0 + chi2 / (k * k)),
            Kernel::DynamicCovarianceScaling(k) => (2.0 * k * k / (k * k + chi2)).min(1.0).powi(2),
        }
    }
}

/// A pose graph solved with kernels.
#[derive(Clone, PartialEq, Debug)]
pub struct RobustSolution {
    /// The poses, by [`PoseId`](crate::PoseId).
    pub poses: Vec<Pose>,
    /// Σ ρ(χ²) over the edges, with ρ(s) = s for those without a kernel.
    pub cost: f64,
    /// By which factor the information of each edge counts in the end.
    pub weights: Vec<f64>,
    /// How many times the weights were computed anew.
    pub rounds: usize,
    /// Whether the last round converged and lowered the cost no more.
    pub converged: bool,
}

/// Minimizes Σ ρ(χ²) by iteratively reweighted least squares: each round solves the graph whose
/// information matrices are scaled with ρ′, which never raises the cost.
///
/// `kernel` says which edges may be wrong: closures, as a rule, and not the odometry. `options` hold for the
/// solver in every round and, with its tolerance and number of iterations, for the rounds.
///
/// # Errors
/// As [`solve`].
pub fn solve_robustly(
    graph: &PoseGraph,
    kernel: impl Fn(&Edge) -> Option<Kernel>,
    options: &Options,
) -> Result<RobustSolution, SolveError> {
    let kernels: Vec<Option<Kernel>> = graph.edges().iter().map(kernel).collect();
    let cost_at = |poses: &[Pose]| -> f64 {
        let costs = kernels.iter().zip(edge_chi2(graph, poses));
        costs.map(|(kernel, chi2)| kernel.map_or(chi2, |kernel| kernel.cost(chi2))).sum()
    };
    let weights_at = |poses: &[Pose]| -> Vec<f64> {
        let weights = kernels.iter().zip(edge_chi2(graph, poses));
        weights.map(|(kernel, chi2)| kernel.map_or(1.0, |kernel| kernel.weight(chi2))).collect()
    };
    let mut poses = graph.poses().to_vec();
    let mut cost = cost_at(&poses);
    for round in 1..=options.max_iterations {
        let weights = weights_at(&poses);
        let solution = solve(&reweighted(graph, &poses, &weights), options)?;
        let lower = cost_at(&solution.poses);
        let finished = cost - lower <= options.tolerance * (1.0 + cost);
        let converged = finished && solution.is_converged();
        if lower < cost {
            (poses, cost) = (solution.poses, lower);
        }
        if finished || (options.interrupted)() {
            let weights = weights_at(&poses);
            return Ok(RobustSolution { poses, cost, weights, rounds: round, converged });
        }
    }
    let rounds = options.max_iterations;
    Ok(RobustSolution { weights: weights_at(&poses), poses, cost, rounds, converged: false })
}

/// χ² of every edge.
pub(crate) fn edge_chi2(graph: &PoseGraph, poses: &[Pose]) -> impl Iterator<Item = f64> {
    graph.edges().iter().map(|edge| edge.chi2(poses[edge.from.index()], poses[edge.to.index()]))
}

/// The graph at other poses, with the information of every edge scaled; edges of weight zero are left out.
///
/// With the weights of a [`RobustSolution`] it is the plain problem that has the same minimum; with those of a
/// [`Screening`](crate::Screening), 1 and 0, it is the graph without the refused edges.
///
/// # Panics
/// If there are fewer poses than the graph has.
#[must_use]
pub fn reweighted(graph: &PoseGraph, poses: &[Pose], weights: &[f64]) -> PoseGraph {
    let mut reweighted = PoseGraph::new();
    for pose in graph.pose_ids() {
        reweighted.add_pose(poses[pose.index()]);
        if graph.is_anchored(pose) {
            reweighted.anchor(pose).expect("the pose has just been added");
        }
    }
    for (edge, &weight) in graph.edges().iter().zip(weights).filter(|&(_, &weight)| weight > 0.0) {
        let edge = Edge { information: edge.information.scaled(weight), ..*edge };
        reweighted.add_edge(edge).expect("an edge of a graph fits into one with the same poses");
    }
    reweighted
}
