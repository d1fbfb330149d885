//! The metrical layout of one hypothesis: the poses of its places, and how well the travels fit them.

use std::sync::Arc;

use hssh_metrics::{Marginals, Options, Pose, PoseGraph, SolveError, chordal_poses, odometry_poses, solve};
use serde::{Deserialize, Serialize};

use crate::legs::Legs;
use crate::measured::PlacedTravel;
use crate::posterior::outlook::trust;
use crate::posterior::poses::Poses;

/// The most likely poses of all places, the first at the origin.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub(crate) struct Layout {
    pub(crate) poses: Poses,
    pub(crate) chi2: f64,
}

impl Layout {
    /// The first place alone.
    pub(crate) fn root() -> Arc<Self> {
        Arc::new(Layout::first())
    }

    /// The same.
    pub(crate) fn first() -> Self {
        Layout { poses: std::iter::once(Pose::IDENTITY).collect(), chi2: 0.0 }
    }

    /// One place more, at the far end of a travel.
    pub(crate) fn with_new_place(&self, travel: &PlacedTravel) -> Self {
        let mut poses = self.poses.clone();
        poses.push(self.poses[travel.from.index()].compose(travel.pose));
        Layout { poses, chi2: self.chi2 }
    }

    /// The distribution of the poses around this layout.
    pub(crate) fn marginals(&self, legs: &Legs) -> Result<Marginals, SolveError> {
        Marginals::new(&legs.graph(self.poses.iter()))
    }

    /// The layout of a hypothesis that closes a loop in one with this layout, whose last travel it is.
    ///
    /// Least squares start from this layout; if they end far above it, or above what the linear estimate promised,
    /// they may have been caught in a local minimum, and start again from the measurements alone: from relaxed headings, and
    /// from dead reckoning.
    pub(crate) fn bent(&self, legs: &Legs, promised: f64) -> Result<Self, SolveError> {
        self.bent_to(&mut legs.graph(self.poses.iter()), legs.constant(), promised)
    }

    /// The same for any graph of travels, with this layout's poses; `constant` is what no layout changes of χ².
    pub(crate) fn bent_to(
        &self,
        graph: &mut PoseGraph,
        constant: f64,
        promised: f64,
    ) -> Result<Self, SolveError> {
        let warm = minimum(graph)?;
        let chi2 = warm.chi2 + constant;
        if chi2 <= 1.0 + 1.5 * promised && chi2 <= self.chi2 + SUSPICIOUS_RISE {
            return Ok(Layout { chi2, ..warm });
        }
        let mut best = warm;
        for start in [chordal_poses(graph)?, odometry_poses(graph)?] {
            graph.set_poses(start).expect("as many as there were");
            let cold = minimum(graph)?;
            if cold.chi2 < best.chi2 {
                best = cold;
            }
        }
        Ok(Layout { chi2: best.chi2 + constant, ..best })
    }
}

/// A rise of χ² by one travel, beyond which a lower minimum is looked for.
const SUSPICIOUS_RISE: f64 = 30.0;

fn minimum(graph: &PoseGraph) -> Result<Layout, SolveError> {
    let solution = solve(graph, &Options::default())?;
    Ok(Layout { poses: solution.poses.into_iter().collect(), chi2: solution.chi2 })
}

/// What a travel between known places adds, by the linear estimate.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Strain {
    /// The rise of χ².
    pub(crate) chi2: f64,
    /// The share of it that can be relied on.
    pub(crate) trust: f64,
    /// ½ ln(|C + H Σ Hᵀ| / |C|).
    pub(crate) vagueness: f64,
}

impl Strain {
    pub(crate) fn of(travel: &PlacedTravel, marginals: &Marginals) -> Result<Self, SolveError> {
        if travel.from == travel.to {
            return Ok(Strain { chi2: travel.chi2_as_loop(), trust: 1.0, vagueness: 0.0 });
        }
        let PlacedTravel { from, to, pose, covariance } = travel;
        let constraint = marginals.new_constraint(*from, *to, *pose, covariance)?;
        let vagueness = 0.5 * constraint.log_determinant_rise.max(0.0);
        Ok(Strain { chi2: constraint.chi2_rise, trust: trust(constraint.heading_variance), vagueness })
    }
}
