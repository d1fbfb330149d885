//! How probable the measurements are under a pose graph: the thesis's maximum (4.9) and the integral (4.6).

use std::f64::consts::TAU;

use crate::graph::{Edge, PoseGraph};
use crate::solution::Solution;

/// ln of (4.9): the density of all measurements at the most likely poses, with its constants
/// Σ −½ ln((2π)³ |C_i|).
///
/// The constants depend on the measurements only. Between graphs with the same measurements, the
/// difference is that of −χ²/2, which is all that (4.18) keeps.
#[must_use]
pub fn metrical_log_likelihood(graph: &PoseGraph, chi2: f64) -> f64 {
    log_normalization(graph) - chi2 / 2.0
}

/// Σ −½ ln((2π)³ |C_i|) over the edges; of those that do not measure every direction, over the directions that they do.
fn log_normalization(graph: &PoseGraph) -> f64 {
    let edge_normalization =
        |edge: &Edge| 0.5 * (edge.information.log_determinant() - edge.information.rank() as f64 * TAU.ln());
    graph.edges().iter().map(edge_normalization).sum()
}

/// A pose may be anywhere in some area, looking anywhere, with equal probability.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UniformPrior {
    area: f64,
}

/// An area that is none.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error("an area of {0} m² is no area: it must be positive and finite")]
pub struct PriorError(f64);

impl UniformPrior {
    /// The uniform density over an area of so many square metres and all 2π radians.
    ///
    /// # Errors
    /// If the area is not positive and finite.
    pub fn over_area(square_metres: f64) -> Result<Self, PriorError> {
        if square_metres > 0.0 && square_metres.is_finite() {
            Ok(UniformPrior { area: square_metres })
        } else {
            Err(PriorError(square_metres))
        }
    }

    /// The area: m².
    #[must_use]
    pub fn area(self) -> f64 {
        self.area
    }

    /// ln (1/V), V = area × 2π: the log-density of every single pose.
    #[must_use]
    pub fn log_density(self) -> f64 {
        -(self.area.ln() + TAU.ln())
    }
}

/// ln of the integral (4.6), the density of all measurements whatever the poses, by Laplace's method: exact
/// for linear-Gaussian measurements, and to second order around the solution otherwise.
///
/// With n free poses it is V⁻ⁿ (2π)^(3n/2) |A|^(−1/2) exp(−χ²/2) ∏ (2π)^(−3/2) |C_i|^(−1/2).
#[must_use]
pub fn laplace_log_evidence(graph: &PoseGraph, solution: &Solution, prior: UniformPrior) -> f64 {
    let free = graph.free_poses() as f64;
    free * prior.log_density() + 1.5 * free * TAU.ln() - 0.5 * solution.log_determinant
        + metrical_log_likelihood(graph, solution.chi2)
}
