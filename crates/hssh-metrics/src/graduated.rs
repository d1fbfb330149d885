//! Which closures are wrong: truncated least squares by graduated non-convexity.

use crate::graph::{Edge, PoseGraph};
use crate::pose::Pose;
use crate::readmission::{Belief, readmit};
use crate::robust::{edge_chi2, reweighted};
use crate::solution::{Options, Solution, SolveError, check};
use crate::solve::solve;

/// The least threshold: any smaller one refuses every suspect that is not perfect, as this does.
const LEAST_THRESHOLD: f64 = 1e-9;

/// By how much the surrogate comes nearer to truncated least squares in each round.
const GRADUATION: f64 = 1.4;

/// A solved pose graph in which some edges were found wrong.
#[derive(Clone, PartialEq, Debug)]
pub struct Screening {
    /// The graph without the refused edges, solved from the poses of the round before.
    pub solution: Solution,
    /// Whether each edge was accepted, in the order of the graph's edges.
    pub accepted: Vec<bool>,
    /// How many times the graph was solved.
    pub rounds: usize,
}

/// Minimizes Σ min(χ², `threshold`) over the suspects and Σ χ² over the others, and tells the suspects that
/// fit from those that do not.
///
/// The surrogates begin convex and approach the truncated sum (Yang, Antonante, Tzoumas, Carlone 2020),
/// beginning with the weights at the poses that the graph holds: dead reckoning, as a rule. In the end, suspects that were
/// refused are believed again where that lowers the sum, as right ones may where a long chain drifts. The edges that
/// are not suspect have to hold the graph together: an odometry chain does. A `threshold` of 11.34 refuses
/// one correct measurement in a hundred.
///
/// # Errors
/// As [`solve`]; a component without an anchored pose arises too if edges are refused that held it.
pub fn screen_closures(
    graph: &PoseGraph,
    is_suspect: impl Fn(&Edge) -> bool,
    threshold: f64,
    options: &Options,
) -> Result<Screening, SolveError> {
    check(graph)?;
    let suspects: Vec<bool> = graph.edges().iter().map(is_suspect).collect();
    let threshold = threshold.max(LEAST_THRESHOLD);
    let mut poses = graph.poses().to_vec();
    let mut rounds = 0;
    let worst = suspect_chi2(graph, &poses, &suspects).fold(0.0, f64::max);
    let mut convexity = threshold / (2.0 * worst - threshold).max(threshold); // μ
    loop {
        let weight =
            |(chi2, &suspect)| if suspect { surrogate_weight(chi2, threshold, convexity) } else { 1.0 };
        let weights: Vec<f64> = edge_chi2(graph, &poses).zip(&suspects).map(weight).collect();
        let screened = reweighted(graph, &poses, &weights);
        let solution = solve(&screened, options)?;
        rounds += 1;
        let is_decided = weights.iter().all(|&weight| weight == 0.0 || weight == 1.0);
        if is_decided || (options.interrupted)() {
            let accepted = weights.iter().map(|&weight| weight > 0.5).collect();
            let mut belief = Belief { accepted, solution };
            rounds += readmit(graph, &suspects, threshold, &mut belief, options)?;
            let Belief { accepted, solution } = belief;
            return Ok(Screening { solution, accepted, rounds });
        }
        poses = solution.poses;
        convexity *= GRADUATION;
    }
}

fn suspect_chi2(graph: &PoseGraph, poses: &[Pose], suspects: &[bool]) -> impl Iterator<Item = f64> {
    edge_chi2(graph, poses).zip(suspects).filter(|&(_, &suspect)| suspect).map(|(chi2, _)| chi2)
}

/// The weight at which the surrogate with parameter μ pulls: one well below the threshold, zero well above,
/// and a transition between that narrows to nothing as μ grows.
fn surrogate_weight(chi2: f64, threshold: f64, convexity: f64) -> f64 {
    let (below, above) = (convexity / (convexity + 1.0), (convexity + 1.0) / convexity);
    if chi2 <= below * threshold {
        1.0
    } else if chi2 >= above * threshold {
        0.0
    } else {
        ((threshold / chi2 * convexity * (convexity + 1.0)).sqrt() - convexity).clamp(0.0, 1.0)
    }
}
