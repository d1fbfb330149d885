//! Sections: the parts of the medial axis between neighboring candidates.

use super::candidate::Candidates;
use crate::skeleton::{AxisPoint, Skeleton, SkeletonEdgeId};

/// A part of an edge between two candidates, or between one and an open tip.
pub(super) struct Section {
    pub(super) edge: SkeletonEdgeId,
    /// The positions of its first and last point in the points of the edge.
    pub(super) range: [usize; 2],
    /// The candidate at its first and at its last point; none at an open tip.
    pub(super) ends: [Option<usize>; 2],
}

/// A way out of a candidate: a section seen from one of its ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Way {
    pub(super) section: usize,
    /// Whether the way starts at the section's last point.
    pub(super) is_backward: bool,
}

impl Way {
    /// The same section seen from its other end.
    pub(super) fn reversed(self) -> Self {
        Way { is_backward: !self.is_backward, ..self }
    }

    /// The points from where the way starts to where it ends.
    pub(super) fn points(self, sections: &[Section], skeleton: &Skeleton) -> Vec<AxisPoint> {
        let Section { edge, range: [first, last], .. } = sections[self.section];
        let mut points = skeleton.edge(edge).points[first..=last].to_vec();
        if self.is_backward {
            points.reverse();
        }
        points
    }

    /// The candidate where the way ends.
    pub(super) fn destination(self, sections: &[Section]) -> Option<usize> {
        sections[self.section].ends[usize::from(!self.is_backward)]
    }
}

/// All sections, edge by edge.
pub(super) fn sections(skeleton: &Skeleton, candidates: &Candidates) -> Vec<Section> {
    let mut sections = Vec::new();
    for (index, edge) in skeleton.edges.iter().enumerate() {
        if candidates.is_inner[index] {
            continue;
        }
        let [start, end] = edge.nodes.map(|node| candidates.at_node[node.index()]);
        let mut stops = vec![(0, start)];
        stops.extend(candidates.on_edge[index].iter().map(|&(at, corner)| (at, Some(corner))));
        stops.push((edge.points.len() - 1, end));
        for pair in stops.windows(2) {
            let [(first, from), (last, to)] = [pair[0], pair[1]];
            sections.push(Section {
                edge: SkeletonEdgeId(index as u32),
                range: [first, last],
                ends: [from, to],
            });
        }
    }
    sections
}

/// The ways out of each candidate, in the order of the sections.
pub(super) fn ways(sections: &[Section], candidates: usize) -> Vec<Vec<Way>> {
    let mut ways = vec![Vec::new(); candidates];
    for (section, Section { ends, .. }) in sections.iter().enumerate() {
        for (end, is_backward) in ends.iter().zip([false, true]) {
            if let Some(candidate) = *end {
                ways[candidate].push(Way { section, is_backward });
            }
        }
    }
    ways
}
