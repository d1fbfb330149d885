//! What is in a file of a pose graph: the graph, the file's numbers for its poses, and what was not read.

use crate::graph::{PoseGraph, PoseId};

/// A pose graph with the numbers by which its file names the poses.
#[derive(Clone, PartialEq, Debug)]
pub struct GraphFile {
    /// The graph. Poses stand in ascending order of their labels; `FIX` records anchor, nothing else does.
    pub graph: PoseGraph,
    /// The number that the file gives to each pose, by [`PoseId`].
    pub labels: Vec<u64>,
    /// The poses that edges mention but no vertex record places: they are at the origin, so compute
    /// poses to start from ([`chordal_poses`](crate::chordal_poses)) before solving.
    pub unplaced: Vec<PoseId>,
    /// The lines that say something this library does not know, in order.
    pub skipped: Vec<SkippedLine>,
}

/// A line that was not read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SkippedLine {
    /// Its number, from 1.
    pub line: usize,
    /// Its record type: the first word.
    pub record: String,
}

impl From<PoseGraph> for GraphFile {
    /// Labels the poses by their ids.
    fn from(graph: PoseGraph) -> Self {
        let labels = graph.pose_ids().map(|pose| u64::from(pose.0)).collect();
        GraphFile { graph, labels, unplaced: Vec::new(), skipped: Vec::new() }
    }
}
