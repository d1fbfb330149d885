//! Solving wherever the poses at hand are: from the edges alone, and from those poses only if they are better.

use crate::graph::PoseGraph;
use crate::initial::{chordal_poses, odometry_poses};
use crate::solution::{Options, Solution, SolveError};
use crate::solve::solve;

/// Minimizes χ² as [`solve`] does, but from [`chordal_poses`], so that the poses which the graph holds cannot lead
/// into the valley of a local minimum; from dead reckoning if too few headings are measured for chordal poses.
///
/// Only if they fit better than what is found that way, to the solver's tolerance, a second descent starts from
/// them. The result is therefore never worse than either start, and poses that are no better change nothing.
///
/// # Errors
/// As [`solve`].
pub fn solve_from_anywhere(graph: &PoseGraph, options: &Options) -> Result<Solution, SolveError> {
    let mut anew = graph.clone();
    let poses = match chordal_poses(graph) {
        Err(SolveError::Singular) => odometry_poses(graph)?,
        poses => poses?,
    };
    anew.set_poses(poses).expect("there is one pose for each");
    let from_edges = solve(&anew, options)?;
    let margin = options.tolerance * (1.0 + from_edges.chi2);
    if graph.chi2() < from_edges.chi2 - margin {
        let from_poses = solve(graph, options)?;
        if from_poses.chi2 < from_edges.chi2 {
            return Ok(from_poses);
        }
    }
    Ok(from_edges)
}
