//! Pose graphs: poses, the relative poses measured between them, and the poses that are held fixed.

use nalgebra::{Matrix3, Vector3, vector};
use serde::{Deserialize, Serialize};

use crate::pose::Pose;
use crate::uncertainty::{Covariance, Information};

/// Which pose of a graph: they are counted from 0 in the order they were added.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PoseId(pub u32);

impl PoseId {
    /// The pose as an index into [`PoseGraph::poses`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A measured relative pose: `to` as seen from the frame of `from`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Edge {
    /// The start pose π_s.
    pub from: PoseId,
    /// The end pose π_e.
    pub to: PoseId,
    /// The measurement τ°.
    pub relative_pose: Pose,
    /// The information Ω of [`Edge::error`], whose x and y lie along the axes of the *measured end
    /// pose*: g2o's convention. See [`Edge::observed`] for the thesis's.
    pub information: Information,
}

impl Edge {
    /// An edge from τ° and the covariance C° of its three numbers, as the thesis gives them: x and y of
    /// the covariance lie along the axes of the *start* pose.
    ///
    /// The two conventions agree with `Ω_thesis = R(θ) Ω Rᵀ(θ)`, θ being the measured turn.
    #[must_use]
    pub fn observed(from: PoseId, to: PoseId, relative_pose: Pose, covariance: &Covariance) -> Self {
        let information = covariance.information().rotated(-relative_pose.theta);
        Edge { from, to, relative_pose, information }
    }

    /// C°⁻¹, the information of the three numbers of τ°: x and y along the axes of the start pose.
    #[must_use]
    pub fn start_frame_information(&self) -> Information {
        self.information.rotated(self.relative_pose.theta)
    }

    /// e = ⊖τ° ⊕ (⊖π_s ⊕ π_e), zero where the two poses agree with the measurement; metres, metres, radians
    /// in (−π, π].
    #[must_use]
    pub fn error(&self, start: Pose, end: Pose) -> Vector3<f64> {
        let difference = self.relative_pose.between(start.between(end));
        vector![difference.x, difference.y, difference.theta]
    }

    /// The edge's part of χ²: eᵀ Ω e.
    #[must_use]
    pub fn chi2(&self, start: Pose, end: Pose) -> f64 {
        quadratic_form(self.information.matrix(), &self.error(start, end))
    }
}

/// eᵀ Ω e.
pub(crate) fn quadratic_form(information: &Matrix3<f64>, error: &Vector3<f64>) -> f64 {
    error.dot(&(information * error))
}

/// Poses with the relative poses measured between them (the Bayes network of section 4.2).
///
/// The poses it holds are the present estimate, from which a solver starts. In each connected component at
/// least one pose must be anchored before the graph can be solved.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PoseGraph {
    poses: Vec<Pose>,
    anchored: Vec<bool>,
    edges: Vec<Edge>,
}

/// Why an edge or a pose does not fit into a graph.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum GraphError {
    /// A pose index past the end.
    #[error("pose {} does not exist: the graph has {poses} poses, counted from 0", .pose.0)]
    NoSuchPose {
        /// The index asked for.
        pose: PoseId,
        /// How many there are.
        poses: usize,
    },
    /// An edge from a pose to itself.
    #[error(
        "an edge leads from pose {} to itself: it says nothing about where the pose is, leave it out", .0.0
    )]
    Loop(PoseId),
    /// NaN or infinite numbers in a measurement.
    #[error("the relative pose measured from pose {} to pose {} is not finite: {relative_pose:?}", .from.0, .to.0)]
    NotFinite {
        /// The start pose.
        from: PoseId,
        /// The end pose.
        to: PoseId,
        /// The measurement.
        relative_pose: Pose,
    },
    /// Another number of poses than the graph has.
    #[error("{given} poses were given for a graph of {poses}")]
    PoseCount {
        /// How many were given.
        given: usize,
        /// How many there are.
        poses: usize,
    },
}

impl PoseGraph {
    /// A graph without poses.
    #[must_use]
    pub fn new() -> Self {
        PoseGraph::default()
    }

    /// Adds a free pose with its present estimate.
    pub fn add_pose(&mut self, estimate: Pose) -> PoseId {
        self.poses.push(estimate);
        self.anchored.push(false);
        PoseId(self.poses.len() as u32 - 1)
    }

    /// Adds a measured relative pose.
    ///
    /// # Errors
    /// If one of its poses does not exist, if both are the same, or if the measurement is not finite.
    pub fn add_edge(&mut self, edge: Edge) -> Result<(), GraphError> {
        self.existing(edge.from)?;
        self.existing(edge.to)?;
        if edge.from == edge.to {
            return Err(GraphError::Loop(edge.from));
        }
        if !edge.relative_pose.is_finite() {
            let Edge { from, to, relative_pose, .. } = edge;
            return Err(GraphError::NotFinite { from, to, relative_pose });
        }
        self.edges.push(edge);
        Ok(())
    }

    /// Holds a pose fixed where it is.
    ///
    /// # Errors
    /// If it does not exist.
    pub fn anchor(&mut self, pose: PoseId) -> Result<(), GraphError> {
        self.existing(pose)?;
        self.anchored[pose.index()] = true;
        Ok(())
    }

    /// Anchors the first pose of every connected component that has no anchor, and returns those poses.
    pub fn anchor_components(&mut self) -> Vec<PoseId> {
        let first: Vec<PoseId> = self.unanchored_components().iter().map(|component| component[0]).collect();
        for pose in &first {
            self.anchored[pose.index()] = true;
        }
        first
    }

    /// Replaces the estimate of a pose.
    ///
    /// # Errors
    /// If it does not exist.
    pub fn set_pose(&mut self, pose: PoseId, estimate: Pose) -> Result<(), GraphError> {
        self.existing(pose)?;
        self.poses[pose.index()] = estimate;
        Ok(())
    }

    /// Replaces the estimates of all poses.
    ///
    /// # Errors
    /// If there are more or fewer than the graph has.
    pub fn set_poses(&mut self, estimates: Vec<Pose>) -> Result<(), GraphError> {
        if estimates.len() != self.poses.len() {
            return Err(GraphError::PoseCount { given: estimates.len(), poses: self.poses.len() });
        }
        self.poses = estimates;
        Ok(())
    }

    fn existing(&self, pose: PoseId) -> Result<(), GraphError> {
        let poses = self.poses.len();
        if pose.index() < poses { Ok(()) } else { Err(GraphError::NoSuchPose { pose, poses }) }
    }

    /// The present estimates, by [`PoseId`].
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// The present estimate of one pose.
    ///
    /// # Panics
    /// If it does not exist.
    #[must_use]
    pub fn pose(&self, pose: PoseId) -> Pose {
        self.poses[pose.index()]
    }

    /// The measured relative poses, in the order they were added.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Whether a pose is held fixed.
    ///
    /// # Panics
    /// If it does not exist.
    #[must_use]
    pub fn is_anchored(&self, pose: PoseId) -> bool {
        self.anchored[pose.index()]
    }

    /// All poses, in order.
    pub fn pose_ids(&self) -> impl ExactSizeIterator<Item = PoseId> + use<> {
        (0..self.poses.len() as u32).map(PoseId)
    }

    /// How many poses are not anchored.
    #[must_use]
    pub fn free_poses(&self) -> usize {
        self.anchored.iter().filter(|&&anchored| !anchored).count()
    }

    /// χ² = Σ eᵀ Ω e of the present estimates, g2o's convention without a factor ½.
    #[must_use]
    pub fn chi2(&self) -> f64 {
        self.chi2_at(&self.poses)
    }

    /// χ² of other poses.
    ///
    /// # Panics
    /// If there are fewer than the graph has.
    #[must_use]
    pub fn chi2_at(&self, poses: &[Pose]) -> f64 {
        self.edges.iter().map(|edge| edge.chi2(poses[edge.from.index()], poses[edge.to.index()])).sum()
    }
}
