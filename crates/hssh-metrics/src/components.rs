//! Connected components of a pose graph, and whether each of them is held by an anchor.

use crate::graph::{PoseGraph, PoseId};

/// Disjoint sets of poses, each represented by its first pose.
pub(crate) struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    pub(crate) fn singletons(count: usize) -> Self {
        DisjointSets { parent: (0..count as u32).collect() }
    }

    pub(crate) fn representative(&mut self, mut element: u32) -> u32 {
        while self.parent[element as usize] != element {
            let grandparent = self.parent[self.parent[element as usize] as usize];
            self.parent[element as usize] = grandparent; // path halving
            element = grandparent;
        }
        element
    }

    /// Joins two sets; false if they were one already.
    pub(crate) fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.representative(a), self.representative(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }
}

impl PoseGraph {
    /// The connected components, each with its poses in ascending order, by their first pose.
    #[must_use]
    pub fn components(&self) -> Vec<Vec<PoseId>> {
        let mut sets = DisjointSets::singletons(self.poses().len());
        for edge in self.edges() {
            sets.join(edge.from.0, edge.to.0);
        }
        let mut component_of = vec![None; self.poses().len()];
        let mut components: Vec<Vec<PoseId>> = Vec::new();
        for pose in self.pose_ids() {
            let representative = sets.representative(pose.0) as usize;
            let component = *component_of[representative].get_or_insert_with(|| {
                components.push(Vec::new());
                components.len() - 1
            });
            components[component].push(pose);
        }
        components
    }

    /// The components that float: no pose of theirs is anchored.
    #[must_use]
    pub fn unanchored_components(&self) -> Vec<Vec<PoseId>> {
        let mut components = self.components();
        components.retain(|component| !component.iter().any(|&pose| self.is_anchored(pose)));
        components
    }
}
