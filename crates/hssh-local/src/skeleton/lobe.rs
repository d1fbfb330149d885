//! Lobes: what hangs on the rest of a medial axis by one edge only, its loops included.

use std::collections::{BTreeMap, BTreeSet};

use super::graph::{EdgeEnd, SkeletonEdge, SkeletonEdgeId, SkeletonNodeId};

/// A part of an axis that one edge, its bridge, connects to the rest.
pub(super) struct Lobe {
    /// All its edges, the bridge included.
    pub(super) edges: BTreeSet<SkeletonEdgeId>,
    /// How far its farthest point is from the rest along the axis, in metres.
    pub(super) reach: f64,
}

/// An axis of which parts are being left out.
pub(super) struct Remains<'a> {
    /// The ends of edges at each node.
    pub(super) nodes: &'a [Vec<EdgeEnd>],
    /// The edges that are left.
    pub(super) edges: &'a [Option<SkeletonEdge>],
    /// Their lengths in metres.
    pub(super) lengths: &'a [f64],
}

impl Remains<'_> {
    /// What lies beyond an edge that is entered at one of its ends, if nothing else leads back from there
    /// and all of it is within `most` metres.
    pub(super) fn lobe(&self, bridge: EdgeEnd, most: f64) -> Option<Lobe> {
        let (root, exit) = (self.node(bridge)?, bridge.opposite());
        // Dijkstra's algorithm; within reach there are so few nodes that the nearest one is looked for.
        let mut waiting = vec![(self.length(bridge.edge), self.node(exit)?)];
        let mut distances: BTreeMap<SkeletonNodeId, f64> = BTreeMap::new();
        while let Some(next) = nearest(&waiting) {
            let (distance, node) = waiting.swap_remove(next);
            if distances.contains_key(&node) {
                continue;
            }
            if node == root || distance > most {
                return None;
            }
            distances.insert(node, distance);
            for &end in self.nodes[node.index()].iter().filter(|&&end| end != exit) {
                waiting.push((distance + self.length(end.edge), self.node(end.opposite())?));
            }
        }
        let ends = distances.keys().flat_map(|node| &self.nodes[node.index()]);
        let edges: BTreeSet<SkeletonEdgeId> = ends.map(|end| end.edge).collect();
        let farthest = |&edge: &SkeletonEdgeId| {
            let nodes = self.edges[edge.index()].as_ref()?.nodes;
            let known = nodes.map(|node| distances.get(&node));
            // The two ways around a loop are equally long where they meet.
            let [Some(one), Some(other)] = known else { return Some(self.length(edge)) };
            Some((one + other + self.length(edge)) / 2.0)
        };
        let reach = edges.iter().filter_map(farthest).fold(0.0, f64::max);
        (reach <= most).then_some(Lobe { edges, reach })
    }

    fn length(&self, edge: SkeletonEdgeId) -> f64 {
        self.lengths[edge.index()]
    }

    fn node(&self, end: EdgeEnd) -> Option<SkeletonNodeId> {
        self.edges[end.edge.index()].as_ref().map(|edge| edge.nodes[usize::from(end.is_last)])
    }
}

fn nearest(waiting: &[(f64, SkeletonNodeId)]) -> Option<usize> {
    (0..waiting.len()).min_by(|&a, &b| waiting[a].0.total_cmp(&waiting[b].0))
}
