//! The graph of a medial axis: junctions and tips joined by edges, which are lines of points.

use crate::grid::Cell;

/// A node of a skeleton: an index into [`Skeleton::nodes`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct SkeletonNodeId(pub u32);

/// An edge of a skeleton: an index into [`Skeleton::edges`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct SkeletonEdgeId(pub u32);

impl SkeletonNodeId {
    /// The node as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl SkeletonEdgeId {
    /// The edge as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A point of the medial axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AxisPoint {
    /// The cell it was found in.
    pub cell: Cell,
    /// Where it is in metres; along edges smoothed over a few cells.
    pub point: [f64; 2],
    /// How far it is from the nearest obstacles, in metres.
    pub clearance: f64,
}

/// One of the two ends of an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct EdgeEnd {
    /// The edge.
    pub edge: SkeletonEdgeId,
    /// Whether it is the edge's last point and not its first.
    pub is_last: bool,
}

impl EdgeEnd {
    /// The other end of the same edge.
    pub(super) fn opposite(self) -> Self {
        EdgeEnd { is_last: !self.is_last, ..self }
    }
}

/// Where a line of the axis stops.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Tip {
    /// Before obstacles: a dead end.
    Wall,
    /// Before cells that were never seen: it may go on.
    Frontier,
    /// At the border of the grid: it may go on.
    Border,
}

/// A junction of the axis, a tip, or one point of a ring that has neither.
#[derive(Clone, PartialEq, Debug)]
pub struct SkeletonNode {
    /// Where it is.
    pub at: AxisPoint,
    /// The ends of edges that meet here: one at a tip, three or more at a junction, two on a ring,
    /// none if free space is so small that its axis is one point.
    pub ends: Vec<EdgeEnd>,
    /// What is before the axis, if it stops here.
    pub tip: Option<Tip>,
}

/// A line of the axis between two nodes.
#[derive(Clone, PartialEq, Debug)]
pub struct SkeletonEdge {
    /// The nodes at its first and last point; the same one if it is a loop.
    pub nodes: [SkeletonNodeId; 2],
    /// Its points in order, those of the nodes included.
    pub points: Vec<AxisPoint>,
}

/// The medial axis of free space as a graph.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Skeleton {
    /// Junctions and tips, in the order of their cells.
    pub nodes: Vec<SkeletonNode>,
    /// The lines between them.
    pub edges: Vec<SkeletonEdge>,
}

impl Skeleton {
    /// An edge.
    #[must_use]
    pub fn edge(&self, edge: SkeletonEdgeId) -> &SkeletonEdge {
        &self.edges[edge.index()]
    }

    /// A node.
    #[must_use]
    pub fn node(&self, node: SkeletonNodeId) -> &SkeletonNode {
        &self.nodes[node.index()]
    }

    /// The points of an edge from one of its ends to the other.
    #[must_use]
    pub fn outward(&self, end: EdgeEnd) -> Vec<AxisPoint> {
        let points = &self.edge(end.edge).points;
        if end.is_last { points.iter().rev().copied().collect() } else { points.clone() }
    }

    /// The node at the end of an edge.
    #[must_use]
    pub fn node_at(&self, end: EdgeEnd) -> SkeletonNodeId {
        self.edge(end.edge).nodes[usize::from(end.is_last)]
    }
}

/// How far along a line each of its points is, in metres.
pub(crate) fn distances(points: &[AxisPoint]) -> Vec<f64> {
    let mut along = vec![0.0];
    for pair in points.windows(2) {
        along.push(along[along.len() - 1] + distance(pair[0].point, pair[1].point));
    }
    along
}

/// The length of a line of points, in metres.
pub(crate) fn length(points: &[AxisPoint]) -> f64 {
    points.windows(2).map(|pair| distance(pair[0].point, pair[1].point)).sum()
}

pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
