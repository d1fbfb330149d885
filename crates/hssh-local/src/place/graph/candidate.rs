//! Where places may be: junctions of the medial axis, its tips at walls, and its corners.

use super::bend::bends;
use crate::place::PlaceOptions;
use crate::skeleton::{AxisPoint, Skeleton, SkeletonEdgeId, SkeletonNodeId, Tip, distance, length};

/// What may be a place, before it is known how its gateways lie.
pub(super) struct Candidate {
    /// The point of the axis with most room.
    pub(super) center: AxisPoint,
    /// Whether the axis stops here.
    pub(super) is_tip: bool,
}

/// All candidates, and which one each part of the axis belongs to.
pub(super) struct Candidates {
    pub(super) all: Vec<Candidate>,
    /// The candidate at each node; none where the axis stops at unknown space or at the border.
    pub(super) at_node: Vec<Option<usize>>,
    /// The corners on each edge: the position in its points, and the candidate.
    pub(super) on_edge: Vec<Vec<(usize, usize)>>,
    /// Whether an edge lies inside one place.
    pub(super) is_inner: Vec<bool>,
}

impl Candidates {
    pub(super) fn new(skeleton: &Skeleton, options: &PlaceOptions) -> Self {
        let lengths: Vec<f64> = skeleton.edges.iter().map(|edge| length(&edge.points)).collect();
        let group = groups(skeleton, &lengths, options);
        let mut found = Candidates {
            all: Vec::new(),
            at_node: vec![None; skeleton.nodes.len()],
            on_edge: vec![Vec::new(); skeleton.edges.len()],
            is_inner: Vec::new(),
        };
        for first in 0..skeleton.nodes.len() {
            let members = (first..group.len()).filter(|&node| group[node] == first).collect::<Vec<_>>();
            found.add_nodes(skeleton, &members);
        }
        for (index, length) in lengths.iter().enumerate() {
            found.add_edge(skeleton, SkeletonEdgeId(index as u32), *length, options);
        }
        found
    }

    /// Makes one candidate of nodes that belong together.
    fn add_nodes(&mut self, skeleton: &Skeleton, members: &[usize]) {
        let nodes = members.iter().map(|&node| &skeleton.nodes[node]);
        let is_open = |tip: Option<Tip>| matches!(tip, Some(Tip::Frontier | Tip::Border));
        let Some(widest) = nodes.reduce(|a, b| if b.at.clearance > a.at.clearance { b } else { a }) else {
            return;
        };
        if widest.ends.is_empty() || is_open(widest.tip) {
            return;
        }
        members.iter().for_each(|&node| self.at_node[node] = Some(self.all.len()));
        self.all.push(Candidate { center: widest.at, is_tip: widest.tip.is_some() });
    }

    /// Makes candidates of the corners of an edge, and sees whether the edge lies inside one place: it
    /// then leads from there to there and is too short to go around more than something in its middle.
    fn add_edge(&mut self, skeleton: &Skeleton, id: SkeletonEdgeId, length: f64, options: &PlaceOptions) {
        let edge = skeleton.edge(id);
        let [from, to] = edge.nodes.map(|node| self.at_node[node.index()]);
        let room = |place: Option<usize>| place.map_or(0.0, |place| self.all[place].center.clearance);
        let is_inner = from.is_some() && from == to && length <= 4.0 * options.one_place * room(from);
        self.is_inner.push(is_inner);
        if is_inner {
            return;
        }
        let is_apart = |at: &usize| {
            let from_start = distance(edge.points[*at].point, edge.points[0].point);
            let from_end = distance(edge.points[*at].point, edge.points[edge.points.len() - 1].point);
            from_start > options.one_place * room(from) && from_end > options.one_place * room(to)
        };
        let corners: Vec<usize> = bends(&edge.points, options.corner).into_iter().filter(is_apart).collect();
        for at in corners {
            self.on_edge[id.index()].push((at, self.all.len()));
            self.all.push(Candidate { center: edge.points[at], is_tip: false });
        }
    }
}

/// For each node the first node of its group: junctions that lie in the free disc of one another.
fn groups(skeleton: &Skeleton, lengths: &[f64], options: &PlaceOptions) -> Vec<usize> {
    let mut group: Vec<usize> = (0..skeleton.nodes.len()).collect();
    for (edge, &length) in skeleton.edges.iter().zip(lengths) {
        let is_junction = |node: SkeletonNodeId| skeleton.node(node).tip.is_none();
        let room = edge.nodes.map(|node| skeleton.node(node).at.clearance).into_iter().fold(0.0, f64::max);
        if !edge.nodes.into_iter().all(is_junction) || length > options.one_place * room {
            continue;
        }
        let [a, b] = edge.nodes.map(|node| group[node.index()]);
        let (first, second) = (a.min(b), a.max(b));
        group.iter_mut().filter(|member| **member == second).for_each(|member| *member = first);
    }
    group
}
