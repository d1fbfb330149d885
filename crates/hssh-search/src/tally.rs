//! What is counted while a tree grows.

use hssh_topology::{Outcome, Removals};
use serde::{Deserialize, Serialize};

use crate::leaf::{Appraise, Grown, Leaf};
use crate::report::LevelCounts;
use crate::tree::Tree;

/// What is counted while a tree grows.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Tally {
    pub(crate) levels: Vec<LevelCounts>,
    pub(crate) removals: Removals,
    /// Nodes that the recursive step was applied to.
    pub(crate) expanded: u64,
}

impl Tally {
    /// The root and its map.
    pub(crate) fn new() -> Self {
        let root = LevelCounts { nodes: 1, maps: 1, refuted: 0 };
        Tally { levels: vec![root], removals: Removals::default(), expanded: 0 }
    }

    /// A leaf was expanded; its successors are about to be added to the tree.
    pub(crate) fn enter<A: Appraise>(&mut self, leaf: &Leaf<A>, grown: &Grown<A>, tree: &mut Tree) {
        tree.set_outcome(leaf.node, grown.outcome);
        self.removals += grown.removals;
        self.expanded += 1;
        self.levels[leaf.depth()].refuted += u64::from(grown.outcome == Outcome::Refuted);
        if grown.successors.is_empty() {
            return;
        }
        self.make_level(leaf.depth() + 1);
        let level = &mut self.levels[leaf.depth() + 1];
        level.nodes += grown.successors.len() as u64;
        if grown.outcome == Outcome::Expanded {
            level.maps += grown.successors.len() as u64;
        }
    }

    /// Makes room for the nodes that explain so many travels.
    pub(crate) fn make_level(&mut self, depth: usize) {
        if self.levels.len() <= depth {
            self.levels.resize(depth + 1, LevelCounts::default());
        }
    }
}
