//! From the cells of a medial axis to its graph.

use super::graph::{
    AxisPoint, EdgeEnd, Skeleton, SkeletonEdge, SkeletonEdgeId, SkeletonNode, SkeletonNodeId,
};
use super::mask::Mask;
use crate::distance::DistanceField;

/// Points of edges are averaged over this many cells to either side: it takes the steps of the lattice
/// out of lengths and directions.
const SMOOTHING: usize = 3;

/// A position that belongs to no node.
const NO_NODE: u32 = u32::MAX;

/// The graph of a thin set of cells: cells with one neighbor are tips, groups of cells with three or
/// more are junctions, and lines of cells with two are edges.
pub(super) fn trace(axis: &Mask, field: &DistanceField) -> Skeleton {
    let mut tracer = Tracer {
        axis,
        field,
        node_of: vec![NO_NODE; axis.positions()],
        is_passed: vec![false; axis.positions()],
        graph: Skeleton::default(),
    };
    let members = tracer.find_nodes();
    for (node, positions) in members.iter().enumerate() {
        for &position in positions {
            tracer.follow_all(SkeletonNodeId(node as u32), position);
        }
    }
    tracer.find_rings();
    tracer.graph
}

struct Tracer<'a> {
    axis: &'a Mask,
    field: &'a DistanceField,
    /// The node that a position belongs to.
    node_of: Vec<u32>,
    /// Whether a position already lies on an edge.
    is_passed: Vec<bool>,
    graph: Skeleton,
}

impl Tracer<'_> {
    fn degree(&self, position: usize) -> usize {
        self.axis.neighbors(position).count()
    }

    fn point(&self, position: usize) -> AxisPoint {
        let cell = self.axis.cell(position);
        AxisPoint { cell, point: self.field.lattice().center(cell), clearance: self.field.clearance(cell) }
    }

    fn add_node(&mut self, members: &[usize]) {
        let id = self.graph.nodes.len() as u32;
        let mut at = self.point(members[0]);
        for &position in members {
            self.node_of[position] = id;
            let other = self.point(position);
            if other.clearance > at.clearance {
                at = other;
            }
        }
        self.graph.nodes.push(SkeletonNode { at, ends: Vec::new(), tip: None });
    }

    /// Makes the nodes and returns the positions of each.
    fn find_nodes(&mut self) -> Vec<Vec<usize>> {
        let mut nodes = Vec::new();
        let axis = self.axis;
        for start in axis.members() {
            if self.node_of[start] != NO_NODE || self.degree(start) == 2 {
                continue;
            }
            let mut members = vec![start];
            if self.degree(start) > 2 {
                let mut at = 0;
                while at < members.len() {
                    for near in axis.neighbors(members[at]) {
                        if self.degree(near) > 2 && !members.contains(&near) {
                            members.push(near);
                        }
                    }
                    at += 1;
                }
            }
            self.add_node(&members);
            nodes.push(members);
        }
        nodes
    }

    /// Follows every edge that leaves a node at one of its positions and was not followed yet.
    fn follow_all(&mut self, node: SkeletonNodeId, position: usize) {
        let axis = self.axis;
        for near in axis.neighbors(position) {
            match self.node_of[near] {
                NO_NODE if !self.is_passed[near] => self.follow(node, position, near),
                other if other != NO_NODE && other > node.0 => {
                    self.add_edge([node, SkeletonNodeId(other)], &[]);
                }
                _ => {}
            }
        }
    }

    /// Follows the line that leaves `node` from one position to the next, up to a node.
    fn follow(&mut self, node: SkeletonNodeId, from: usize, first: usize) {
        let (mut before, mut here) = (from, first);
        let mut between = Vec::new();
        loop {
            between.push(here);
            self.is_passed[here] = true;
            let Some(next) = self.axis.neighbors(here).find(|&next| next != before) else { return };
            if self.node_of[next] != NO_NODE {
                let is_inside_node = self.node_of[next] == node.0 && between.len() < 3;
                if !is_inside_node {
                    self.add_edge([node, SkeletonNodeId(self.node_of[next])], &between);
                }
                return;
            }
            (before, here) = (here, next);
        }
    }

    /// Rings without any junction get a node where they are widest.
    fn find_rings(&mut self) {
        let axis = self.axis;
        for start in axis.members() {
            if self.node_of[start] != NO_NODE || self.is_passed[start] {
                continue;
            }
            let mut ring = vec![start];
            let (mut before, mut here) = (usize::MAX, start);
            while let Some(next) =
                axis.neighbors(here).find(|&next| next != before && (next != start || ring.len() > 2))
            {
                if next == start {
                    break;
                }
                ring.push(next);
                (before, here) = (here, next);
            }
            ring.iter().for_each(|&position| self.is_passed[position] = true);
            let clearance = |at: usize| self.point(ring[at]).clearance;
            let widest =
                (1..ring.len()).fold(0, |best, at| if clearance(at) > clearance(best) { at } else { best });
            ring.rotate_left(widest);
            self.add_node(&ring[..1]);
            let node = SkeletonNodeId(self.graph.nodes.len() as u32 - 1);
            self.add_edge([node; 2], &ring[1..]);
        }
    }

    fn add_edge(&mut self, nodes: [SkeletonNodeId; 2], between: &[usize]) {
        let mut points = vec![self.graph.node(nodes[0]).at];
        points.extend(between.iter().map(|&position| self.point(position)));
        points.push(self.graph.node(nodes[1]).at);
        let edge = SkeletonEdgeId(self.graph.edges.len() as u32);
        self.graph.edges.push(SkeletonEdge { nodes, points: smoothed(&points) });
        for (node, is_last) in nodes.into_iter().zip([false, true]) {
            self.graph.nodes[node.index()].ends.push(EdgeEnd { edge, is_last });
        }
    }
}

/// The same line with each point in the middle of those around it; the two ends stay.
fn smoothed(points: &[AxisPoint]) -> Vec<AxisPoint> {
    let average = |(at, here): (usize, &AxisPoint)| {
        let reach = SMOOTHING.min(at).min(points.len() - 1 - at);
        let around = &points[at - reach..=at + reach];
        let mean =
            |axis: usize| around.iter().map(|near| near.point[axis]).sum::<f64>() / around.len() as f64;
        AxisPoint { point: [mean(0), mean(1)], ..*here }
    };
    points.iter().enumerate().map(average).collect()
}
