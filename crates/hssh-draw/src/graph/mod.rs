//! Pose graphs as pictures: the trajectory, the loops that close it, and how sure each pose is.

mod ellipse;
mod figure;

pub(crate) use ellipse::ellipse_95;
pub use figure::draw_pose_graph;

use hssh_metrics::PoseId;
use nalgebra::Matrix2;

/// What an edge of a pose graph is to the picture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum EdgeKind {
    /// Part of the trajectory.
    Odometry,
    /// It closes a loop.
    Closure,
    /// It was found wrong and plays no part.
    Refused,
}

/// What is drawn besides the poses themselves.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PoseGraphOptions {
    /// A line above the picture.
    pub title: Option<String>,
    /// What each edge is, in the order of the graph's edges; missing ones are odometry.
    pub kinds: Vec<EdgeKind>,
    /// Covariances of the positions of some poses, m², along the axes of the graph: drawn as ellipses that hold the
    /// true position with a probability of 95 %.
    pub covariances: Vec<(PoseId, Matrix2<f64>)>,
}
