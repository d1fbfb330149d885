//! Solving a pose graph, by the method that is asked for (appendix B.2).

use crate::descent::{gauss_newton, levenberg_marquardt, linearize_once, safeguarded};
use crate::graph::PoseGraph;
use crate::solution::{Method, Options, Solution, SolveError};

/// Minimizes χ² over the free poses, starting from the poses that the graph holds.
///
/// # Errors
/// If a component of the graph has no anchored pose, if an estimate is not finite, or if the numbers are
/// so extreme that the linear system cannot be solved.
pub fn solve(graph: &PoseGraph, options: &Options) -> Result<Solution, SolveError> {
    match options.method {
        Method::LinearizeOnce => linearize_once(graph),
        Method::GaussNewton => gauss_newton(graph, options),
        Method::LevenbergMarquardt => levenberg_marquardt(graph, options),
        Method::Safeguarded => safeguarded(graph, options),
    }
}
