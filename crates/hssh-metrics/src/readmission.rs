//! Suspects that were refused although believing them costs less: they are believed again, as long as the truncated sum falls.

use crate::graph::{Edge, PoseGraph};
use crate::marginals::Marginals;
use crate::pose::Pose;
use crate::robust::{edge_chi2, reweighted};
use crate::solution::{Options, Solution, SolveError};
use crate::solve::solve;

/// Rounds after which those that are still refused stay so.
const MOST_ROUNDS: usize = 40;

/// Which edges are believed, and the poses that follow.
pub(crate) struct Belief {
    pub(crate) accepted: Vec<bool>,
    pub(crate) solution: Solution,
}

/// Where a long chain has drifted, a right closure fits as badly as a wrong one, and is refused with it. But the chain can
/// bend there: what believing a suspect would add to χ² of the whole is known without solving again, from the
/// covariance of its ends. Where that is less than the threshold, which a refused suspect costs, believing it lowers
/// Σ min(χ², threshold). The cheaper half of such suspects is tried together, and kept if the sum falls.
///
/// Returns how many times the graph was solved.
pub(crate) fn readmit(
    graph: &PoseGraph,
    suspects: &[bool],
    threshold: f64,
    belief: &mut Belief,
    options: &Options,
) -> Result<usize, SolveError> {
    let mut hopeless = vec![false; suspects.len()];
    let mut cost = truncated_sum(graph, &belief.solution.poses, suspects, threshold);
    for round in 0..MOST_ROUNDS {
        let tried = cheaper_half(graph, belief, &hopeless, threshold)?;
        if tried.is_empty() || (options.interrupted)() {
            return Ok(round);
        }
        let mut accepted = belief.accepted.clone();
        tried.iter().for_each(|&edge| accepted[edge] = true);
        let mut solution = solve_believed(graph, &belief.solution.poses, &accepted, options)?;
        let fits = |poses: &[Pose]| -> Vec<bool> {
            let chi2 = edge_chi2(graph, poses).zip(suspects);
            chi2.map(|(chi2, &suspect)| !suspect || chi2 <= threshold).collect()
        };
        let now = truncated_sum(graph, &solution.poses, suspects, threshold);
        if now < cost {
            accepted = fits(&solution.poses);
            solution = solve_believed(graph, &solution.poses, &accepted, options)?;
            cost = truncated_sum(graph, &solution.poses, suspects, threshold).min(now);
            *belief = Belief { accepted, solution };
        }
        // What was tried and does not fit is not tried again.
        tried.iter().for_each(|&edge| hopeless[edge] |= !belief.accepted[edge]);
    }
    Ok(MOST_ROUNDS)
}

/// The refused edges that would add less than the threshold to χ²; of several the cheaper half.
fn cheaper_half(
    graph: &PoseGraph,
    belief: &Belief,
    hopeless: &[bool],
    threshold: f64,
) -> Result<Vec<usize>, SolveError> {
    let open = |&index: &usize| !belief.accepted[index] && !hopeless[index];
    let refused: Vec<usize> = (0..graph.edges().len()).filter(open).collect();
    if refused.is_empty() {
        return Ok(refused);
    }
    let marginals = Marginals::new(&believed(graph, &belief.solution.poses, &belief.accepted))?;
    let rise = |edge: &Edge| {
        let covariance = edge.information.covariance()?;
        let constraint = marginals.new_constraint(edge.from, edge.to, edge.relative_pose, &covariance);
        constraint.ok().map(|constraint| constraint.chi2_rise)
    };
    let mut cheap: Vec<(f64, usize)> = refused
        .into_iter()
        .filter_map(|index| Some((rise(&graph.edges()[index])?, index)))
        .filter(|&(rise, _)| rise < threshold)
        .collect();
    cheap.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    cheap.truncate(cheap.len().div_ceil(2));
    Ok(cheap.into_iter().map(|(_, index)| index).collect())
}

/// Σ min(χ², threshold) over the suspects and Σ χ² over the others.
fn truncated_sum(graph: &PoseGraph, poses: &[Pose], suspects: &[bool], threshold: f64) -> f64 {
    let truncated = |(chi2, &suspect): (f64, &bool)| if suspect { chi2.min(threshold) } else { chi2 };
    edge_chi2(graph, poses).zip(suspects).map(truncated).sum()
}

fn believed(graph: &PoseGraph, poses: &[Pose], accepted: &[bool]) -> PoseGraph {
    let weights: Vec<f64> = accepted.iter().map(|&accepted| f64::from(u8::from(accepted))).collect();
    reweighted(graph, poses, &weights)
}

fn solve_believed(
    graph: &PoseGraph,
    poses: &[Pose],
    accepted: &[bool],
    options: &Options,
) -> Result<Solution, SolveError> {
    solve(&believed(graph, poses, accepted), options)
}
