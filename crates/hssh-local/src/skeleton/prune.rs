//! Leaves out the branches of a medial axis that lead nowhere.

use std::collections::BTreeSet;

use super::graph::{
    AxisPoint, EdgeEnd, Skeleton, SkeletonEdge, SkeletonEdgeId, SkeletonNodeId, distances, length,
};
use super::lobe::Remains;
use super::options::SkeletonOptions;

/// The lengths over which the slope of the clearance is measured, in metres.
const SLOPE_WINDOW: [f64; 2] = [0.4, 1.0];

/// Takes out branches, the shallowest first, that reach less than the shallowest branch allowed beyond the
/// free disc at their junction: those with a tip, then those that lead into loops and back; two edges that
/// remain at a former junction become one. The ends of branches that run into a corner of a room are cut
/// off first. At last, pieces of the axis go that are shorter as a whole.
pub(super) fn prune(skeleton: Skeleton, options: &SkeletonOptions) -> Skeleton {
    let mut pruner = Pruner {
        nodes: skeleton.nodes.iter().map(|node| node.ends.clone()).collect(),
        lengths: skeleton.edges.iter().map(|edge| length(&edge.points)).collect(),
        edges: skeleton.edges.iter().cloned().map(Some).collect(),
        skeleton,
    };
    pruner.join_all();
    for _ in 0..2 {
        pruner.trim_all((options.opening_angle / 2.0).cos());
        while let Some(branch) = pruner.shallowest_branch(options.shallowest_branch) {
            pruner.take_out(branch);
        }
    }
    pruner.take_out(pruner.small_pieces(options.shallowest_branch));
    pruner.rest()
}

struct Pruner {
    skeleton: Skeleton,
    /// The ends of edges at each node.
    nodes: Vec<Vec<EdgeEnd>>,
    /// The edges that are left.
    edges: Vec<Option<SkeletonEdge>>,
    /// Their lengths in metres.
    lengths: Vec<f64>,
}

impl Pruner {
    /// The edges of the shallowest branch that is shallower than allowed.
    fn shallowest_branch(&self, shallowest: f64) -> Option<BTreeSet<SkeletonEdgeId>> {
        let with_tip = self.edges.iter().enumerate().filter_map(|(index, edge)| {
            let depth = self.depth(edge.as_ref()?, self.lengths[index])?;
            (depth < shallowest).then(|| (depth, BTreeSet::from([SkeletonEdgeId(index as u32)])))
        });
        let with_tip = with_tip.min_by(|a, b| a.0.total_cmp(&b.0));
        let lobe = || self.shallow_lobes(shallowest).min_by(|a, b| a.0.total_cmp(&b.0));
        with_tip.or_else(lobe).map(|(_, edges)| edges)
    }

    /// Lobes with loops that are shallower than allowed, with how far they reach beyond the free disc at
    /// their junction.
    fn shallow_lobes(&self, shallowest: f64) -> impl Iterator<Item = (f64, BTreeSet<SkeletonEdgeId>)> {
        let remains = Remains { nodes: &self.nodes, edges: &self.edges, lengths: &self.lengths };
        let junctions = (0..self.nodes.len()).filter(|&node| self.nodes[node].len() > 2);
        let ends = junctions.flat_map(|node| self.nodes[node].iter().map(move |&end| (node, end)));
        ends.filter_map(move |(node, end)| {
            let room = self.skeleton.nodes[node].at.clearance;
            let lobe = remains.lobe(end, shallowest + room)?;
            (lobe.edges.len() > 1).then_some((lobe.reach - room, lobe.edges))
        })
    }

    /// The edges of all pieces of the axis that are shorter than allowed.
    fn small_pieces(&self, shortest: f64) -> BTreeSet<SkeletonEdgeId> {
        let mut small = BTreeSet::new();
        let mut is_seen = vec![false; self.nodes.len()];
        for start in 0..self.nodes.len() {
            let (mut piece, mut waiting) = (BTreeSet::new(), vec![SkeletonNodeId(start as u32)]);
            while let Some(node) = waiting.pop() {
                if !std::mem::replace(&mut is_seen[node.index()], true) {
                    let edges = self.nodes[node.index()].iter().map(|end| end.edge);
                    piece.extend(edges.clone());
                    let edges = edges.filter_map(|edge| self.edges[edge.index()].as_ref());
                    waiting.extend(edges.flat_map(|edge| edge.nodes));
                }
            }
            if piece.iter().map(|edge| self.lengths[edge.index()]).sum::<f64>() < shortest {
                small.extend(piece);
            }
        }
        small
    }

    /// Cuts off the ends of branches along which the clearance grows inwards by at least `slope`: they
    /// lie between obstacles at less than the opening angle, whose half has that cosine.
    fn trim_all(&mut self, slope: f64) {
        for (edge, length_left) in self.edges.iter_mut().zip(&mut self.lengths) {
            let Some(edge) = edge else { continue };
            for is_last in [false, true] {
                let node = edge.nodes[usize::from(is_last)];
                if self.nodes[node.index()].len() == 1 {
                    trim_start(is_last, &mut edge.points, slope);
                    let tip = if is_last { edge.points.len() - 1 } else { 0 };
                    self.skeleton.nodes[node.index()].at = edge.points[tip];
                    *length_left = length(&edge.points);
                }
            }
        }
    }

    /// How far a branch with a tip reaches beyond the free disc at its junction, in metres, 0 if its tip is
    /// still in that disc; `None` if the edge is no such branch.
    fn depth(&self, edge: &SkeletonEdge, length: f64) -> Option<f64> {
        let degrees = edge.nodes.map(|node| self.nodes[node.index()].len());
        let [first, last] = [edge.points.first()?, edge.points.last()?];
        let (tip, junction) = match degrees {
            [1, many] if many > 2 => (first, last),
            [many, 1] if many > 2 => (last, first),
            _ => return None,
        };
        let is_inside = length <= junction.clearance;
        Some(if is_inside { 0.0 } else { length + tip.clearance - junction.clearance })
    }

    /// Takes out edges, and joins what remains where they were.
    fn take_out(&mut self, edges: BTreeSet<SkeletonEdgeId>) {
        let mut touched = BTreeSet::new();
        for id in edges {
            let Some(edge) = self.edges[id.index()].take() else { continue };
            for node in edge.nodes {
                self.nodes[node.index()].retain(|end| end.edge != id);
                touched.insert(node);
            }
        }
        touched.into_iter().for_each(|node| self.join_at(node));
    }

    fn join_all(&mut self) {
        for node in 0..self.nodes.len() {
            self.join_at(SkeletonNodeId(node as u32));
        }
    }

    /// Makes one edge of two different ones that meet at a node and nothing else does.
    fn join_at(&mut self, node: SkeletonNodeId) {
        let [first, second] = self.nodes[node.index()][..] else { return };
        if first.edge == second.edge {
            return;
        }
        let (Some(before), Some(after)) =
            (self.edges[first.edge.index()].take(), self.edges[second.edge.index()].take())
        else {
            return;
        };
        let nodes = [before.nodes[usize::from(!first.is_last)], after.nodes[usize::from(!second.is_last)]];
        let mut points = reversed_if(!first.is_last, before.points);
        points.extend(reversed_if(second.is_last, after.points).into_iter().skip(1));
        for (node, is_last) in nodes.into_iter().zip([false, true]) {
            let old = if is_last { second } else { first };
            let ends = &mut self.nodes[node.index()];
            let far = EdgeEnd { edge: old.edge, is_last: !old.is_last };
            if let Some(end) = ends.iter_mut().find(|end| **end == far) {
                *end = EdgeEnd { edge: first.edge, is_last };
            }
        }
        self.nodes[node.index()].clear();
        self.lengths[first.edge.index()] += self.lengths[second.edge.index()];
        self.edges[first.edge.index()] = Some(SkeletonEdge { nodes, points });
    }

    /// What is left, numbered anew in the old order.
    fn rest(self) -> Skeleton {
        let had_edges = |node: usize| !self.skeleton.nodes[node].ends.is_empty();
        let mut rest = Skeleton::default();
        let mut number = vec![None; self.nodes.len()];
        for (index, ends) in self.nodes.iter().enumerate() {
            if !ends.is_empty() || !had_edges(index) {
                number[index] = Some(SkeletonNodeId(rest.nodes.len() as u32));
                let mut node = self.skeleton.nodes[index].clone();
                node.ends.clear();
                rest.nodes.push(node);
            }
        }
        for edge in self.edges.into_iter().flatten() {
            let [Some(first), Some(last)] = edge.nodes.map(|node| number[node.index()]) else { continue };
            let id = SkeletonEdgeId(rest.edges.len() as u32);
            rest.nodes[first.index()].ends.push(EdgeEnd { edge: id, is_last: false });
            rest.nodes[last.index()].ends.push(EdgeEnd { edge: id, is_last: true });
            rest.edges.push(SkeletonEdge { nodes: [first, last], ..edge });
        }
        rest
    }
}

/// Cuts off the beginning of a line, or its end, as long as the clearance grows inwards.
fn trim_start(at_last: bool, points: &mut Vec<AxisPoint>, slope: f64) {
    let mut line = reversed_if(at_last, std::mem::take(points));
    let along = distances(&line);
    let grows = |at: usize| {
        let window = SLOPE_WINDOW.map(|length| along.partition_point(|&here| here < along[at] + length));
        (window[0]..window[1])
            .any(|inner| line[inner].clearance - line[at].clearance >= slope * (along[inner] - along[at]))
    };
    let kept = (0..line.len()).find(|&at| !grows(at)).unwrap_or(0);
    line.drain(..kept);
    *points = reversed_if(at_last, line);
}

fn reversed_if(reversed: bool, mut points: Vec<AxisPoint>) -> Vec<AxisPoint> {
    if reversed {
        points.reverse();
    }
    points
}
