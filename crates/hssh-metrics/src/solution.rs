//! What to ask of a solver, what comes back, and what has no solution.

use serde::{Deserialize, Serialize};

use crate::graph::{PoseGraph, PoseId};
use crate::pose::Pose;

/// How to minimize χ².
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Method {
    /// One linear system at l_e = l_s ⊕ τ°: the thesis, appendix B.
    LinearizeOnce,
    /// Full steps, taken whether or not χ² falls.
    GaussNewton,
    /// Full steps as long as χ² falls; when one does not, steps damped in proportion to diag(A).
    LevenbergMarquardt,
    /// Gauss–Newton, which crosses curved valleys that damped steps only creep along; where it does not
    /// converge, or converges above a χ² that it met, Levenberg–Marquardt from the best poses met.
    #[default]
    Safeguarded,
}

/// What the solver may do.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How to minimize.
    pub method: Method,
    /// The most linear systems to solve.
    pub max_iterations: usize,
    /// Converged when the linear model promises a fall of χ² by less than this times (1 + χ²).
    pub tolerance: f64,
    /// Asked before every linear system whether somebody wants it to stop: it ends with the poses reached then.
    pub interrupted: fn() -> bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { method: Method::default(), max_iterations: 100, tolerance: 1e-9, interrupted: || false }
    }
}

/// Why the solver stopped.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StopReason {
    /// No step promises to lower χ² any more.
    Converged,
    /// One linear system was asked for, and solved.
    LinearizedOnce,
    /// The allowed number of linear systems has been solved.
    MaxIterations,
    /// No step, however damped, lowers χ², although the linear model promises it: as a rule because a
    /// measurement is contradicted by half a turn, where its error jumps from π to −π.
    Stalled,
    /// A Gauss–Newton step led to numbers that are not finite; the poses are those before it.
    Diverged,
    /// Somebody asked it to stop; the poses are those reached.
    Interrupted,
}

/// A solved pose graph.
#[derive(Clone, PartialEq, Debug)]
pub struct Solution {
    /// The poses, by [`PoseId`]; anchored ones are where they were.
    pub poses: Vec<Pose>,
    /// χ² of the graph at the start.
    pub initial_chi2: f64,
    /// χ² of the graph at [`Solution::poses`], without linearization.
    pub chi2: f64,
    /// The minimum of the last linearized χ², (B.9): what the thesis compares. At convergence it is χ².
    pub linearized_chi2: f64,
    /// ln |A| of the free poses, A of (B.11), undamped, at the last linearization.
    pub log_determinant: f64,
    /// How many linear systems were solved.
    pub iterations: usize,
    /// Why the solver stopped.
    pub stop: StopReason,
}

impl Solution {
    /// Whether the poses are at a minimum of χ², which may be a local one.
    #[must_use]
    pub fn is_converged(&self) -> bool {
        self.stop == StopReason::Converged
    }
}

/// Why a pose graph cannot be solved.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, thiserror::Error)]
pub enum SolveError {
    /// A part of the graph could be anywhere.
    #[error(
        "the component of pose {} ({poses} poses) has no anchored pose, so it could be anywhere: anchor one of them, \
         or call `anchor_components`", .first.0
    )]
    Unanchored {
        /// The first pose of the component.
        first: PoseId,
        /// How many poses it has.
        poses: usize,
    },
    /// An estimate is NaN or infinite.
    #[error("the estimate of pose {} is not finite: {estimate:?}", .pose.0)]
    NotFinite {
        /// The pose.
        pose: PoseId,
        /// Its estimate.
        estimate: Pose,
    },
    /// χ² at the start is too large for a floating-point number.
    #[error("χ² of the initial poses overflows; measurements or poses are out of all proportion")]
    Overflow,
    /// The matrix A cannot be factorized; `floating_poses` tells which poses too few measurements hold.
    #[error(
        "the normal equations are singular to working precision: the information matrices of the graph's edges \
         differ by too many orders of magnitude, or there are too few measurements"
    )]
    Singular,
}

/// Refuses what has no solution.
pub(crate) fn check(graph: &PoseGraph) -> Result<(), SolveError> {
    for pose in graph.pose_ids() {
        let estimate = graph.pose(pose);
        if !estimate.is_finite() {
            return Err(SolveError::NotFinite { pose, estimate });
        }
    }
    match graph.unanchored_components().first() {
        Some(component) => Err(SolveError::Unanchored { first: component[0], poses: component.len() }),
        None => Ok(()),
    }
}
