//! What is in a file of a pose graph: the graph, the file's numbers for its poses, and what was not read.

use std::collections::BTreeSet;

use crate::graph::{Edge, PoseGraph, PoseId};

/// A pose graph with the numbers by which its file names the poses.
#[derive(Clone, PartialEq, Debug)]
pub struct GraphFile {
    /// The graph. Poses stand in ascending order of their labels; `FIX` records anchor, and so does the frame of the
    /// world, if the file has priors.
    pub graph: PoseGraph,
    /// The number that the file gives to each pose, by [`PoseId`]; the world has none.
    pub labels: Vec<u64>,
    /// The poses that edges mention but no vertex record places: they are at the origin, so compute
    /// poses to start from ([`chordal_poses`](crate::chordal_poses)) before solving.
    pub unplaced: Vec<PoseId>,
    /// The frame in which priors are given, if there are any: the last pose of the graph, anchored at the origin. An
    /// edge from it is a prior.
    pub world: Option<PoseId>,
    /// The poses that are landmarks, in ascending order: points, of which the heading means nothing. It is tied to that
    /// of the pose that saw the landmark first, which costs nothing and takes nothing away.
    pub landmarks: Vec<PoseId>,
    /// The indices of the edges that the file itself holds for doubtful: switchable constraints, and mixtures with a null
    /// hypothesis. [`screen_closures`](crate::screen_closures) decides which to believe, without further variables.
    pub doubtful: BTreeSet<usize>,
    /// Edges with an information matrix of zeros: they say nothing and are not in the graph.
    pub empty_edges: usize,
    /// The records that say something this library does not know, each type once, in the order of the file.
    pub skipped: Vec<SkippedRecords>,
    /// The first edge that turns by more than a full circle, as no angle in radians needs to: its line, and the turn.
    pub large_turn: Option<(usize, f64)>,
}

/// Lines of one type that were not read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SkippedRecords {
    /// The number of the first, from 1.
    pub line: usize,
    /// Their record type: the first word, shortened if it is none.
    pub record: String,
    /// How many there are.
    pub count: usize,
}

impl SkippedRecords {
    /// Whether the graph is another one without them: whatever is neither a vertex (which says nothing by itself) nor a
    /// parameter nor the scan of a laser may be a measurement.
    #[must_use]
    pub fn matters(&self) -> bool {
        const HARMLESS: [&str; 6] = ["VERTEX", "PARAMS_", "ROBOTLASER", "RAWLASER", "FLASER", "POSE2D_NODE"];
        !HARMLESS.iter().any(|harmless| self.record.starts_with(harmless))
    }

    /// Whether they are of a graph in space, which no solver in the plane can use.
    #[must_use]
    pub fn is_spatial(&self) -> bool {
        self.record.contains("SE3") || self.record.ends_with('3') || self.record.contains("XYZ")
    }
}

impl GraphFile {
    /// The file's number for a pose; the world has none.
    #[must_use]
    pub fn label(&self, pose: PoseId) -> Option<u64> {
        self.labels.get(pose.index()).copied()
    }

    /// Whether an edge is a prior: a measurement of a pose in the frame of the world.
    #[must_use]
    pub fn is_prior(&self, edge: &Edge) -> bool {
        self.world == Some(edge.from)
    }

    /// Whether a pose is a landmark.
    #[must_use]
    pub fn is_landmark(&self, pose: PoseId) -> bool {
        self.landmarks.binary_search(&pose).is_ok()
    }
}

impl From<PoseGraph> for GraphFile {
    /// Labels the poses by their ids.
    fn from(graph: PoseGraph) -> Self {
        GraphFile {
            labels: graph.pose_ids().map(|pose| u64::from(pose.0)).collect(),
            graph,
            unplaced: Vec::new(),
            world: None,
            landmarks: Vec::new(),
            doubtful: BTreeSet::new(),
            empty_edges: 0,
            skipped: Vec::new(),
            large_turn: None,
        }
    }
}
