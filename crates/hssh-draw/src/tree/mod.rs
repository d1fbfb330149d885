//! Search trees as pictures: how hypotheses follow from each other (Figure 2.5).

mod arrangement;
mod dot;
mod dots;
mod figure;
mod legend;
mod mark;
mod thumbnail;

pub use dot::tree_to_dot;
pub use figure::draw_tree;

use hssh_search::{Cursor, Experience, NodeId, Tree};
use hssh_topology::{Derivation, Outcome, PlaceId, TopologicalMap};

use crate::drawing::{Bearings, DrawingError};

/// The thesis's abbreviation for how a node follows from its parent.
fn abbreviation(derivation: Derivation) -> &'static str {
    match derivation {
        Derivation::Predicted => "p-c",
        Derivation::NewPlace | Derivation::Closure(_) => "e",
    }
}

/// What became of a node when the next observation came.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It has children, or there was no next observation yet.
    Alive,
    /// p-nc: the map predicted something else.
    Refuted,
    /// The axioms removed all its successors.
    Removed,
}

/// One hypothesis of a search tree.
#[derive(Clone, Debug)]
pub struct TreeNode {
    /// The index of the parent, which comes before, and how the node follows from it; `None` for the root.
    pub parent: Option<(usize, Derivation)>,
    /// What became of it.
    pub fate: Fate,
    /// Whether it is one of the preferred hypotheses: it gets a frame.
    pub is_optimal: bool,
    /// Its map and current place. They are drawn if every node has them and the tree is small.
    pub picture: Option<(TopologicalMap, PlaceId)>,
}

/// A search tree: the root first, every node after its parent.
#[derive(Clone, Debug, Default)]
pub struct SearchTree {
    /// The nodes; children stand in the picture from left to right as they stand here.
    pub nodes: Vec<TreeNode>,
    /// The number of observations: nodes that explain them all form the final level.
    pub observations: usize,
}

/// What a tree is drawn with.
#[derive(Clone, PartialEq, Debug)]
pub struct TreeOptions {
    /// A line above the tree.
    pub title: Option<String>,
    /// Bearings of the stars, for the little maps.
    pub bearings: Bearings,
    /// Up to that many nodes, each is a little map if the tree has them; above, a dot.
    pub most_maps: usize,
    /// Above that many nodes the tree is refused.
    pub most_nodes: usize,
}

impl Default for TreeOptions {
    fn default() -> Self {
        TreeOptions { title: None, bearings: Bearings::none(), most_maps: 60, most_nodes: 5000 }
    }
}

/// Why a tree cannot be drawn.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum TreeError {
    /// No nodes at all.
    #[error("the search tree is empty: it needs at least a root")]
    Empty,
    /// More nodes than a picture can show.
    #[error(
        "the search tree has {nodes} nodes, and above {limit} nobody can read a picture of it: draw a prefix of the \
         exploration, or raise the limit `most_nodes`"
    )]
    TooLarge {
        /// How many there are.
        nodes: usize,
        /// How many are drawn at most.
        limit: usize,
    },
    /// A root that is not the first node, or a parent that does not come before its child.
    #[error(
        "node {node} of the search tree has {parent} as its parent: the first node must be the only root, and every parent must come before its children"
    )]
    Parent {
        /// The node.
        node: usize,
        /// What it has as its parent.
        parent: String,
    },
    /// A map has no drawing.
    #[error("node {node} of the search tree: {problem}")]
    Drawing {
        /// The node.
        node: usize,
        /// Why not.
        problem: DrawingError,
    },
}

impl SearchTree {
    /// The tree of a search, with `optimal` framed. Maps are taken along up to `most_maps` nodes.
    #[must_use]
    pub fn of(tree: &Tree, experience: &Experience, optimal: &[NodeId], most_maps: usize) -> Self {
        let mut cursor = Cursor::new(experience);
        let has_child = children_exist(tree);
        let node = |id: NodeId| {
            let picture = (tree.len() <= most_maps).then(|| {
                let hypothesis = cursor.go_to(id, tree, experience);
                (hypothesis.map.clone(), hypothesis.position.place)
            });
            let fate = match tree.outcome(id) {
                Outcome::Refuted => Fate::Refuted,
                Outcome::Expanded if !has_child[id.index()] => Fate::Removed,
                Outcome::Open | Outcome::Predicted | Outcome::Expanded => Fate::Alive,
            };
            let parent = tree.parent(id).map(NodeId::index).zip(tree.derivation(id));
            TreeNode { parent, fate, is_optimal: optimal.contains(&id), picture }
        };
        SearchTree { nodes: tree.nodes().map(node).collect(), observations: experience.observations.len() }
    }

    /// Refuses what cannot be drawn.
    fn check(&self, options: &TreeOptions) -> Result<(), TreeError> {
        let (nodes, limit) = (self.nodes.len(), options.most_nodes);
        if nodes == 0 {
            return Err(TreeError::Empty);
        }
        if nodes > limit {
            return Err(TreeError::TooLarge { nodes, limit });
        }
        for (index, node) in self.nodes.iter().enumerate() {
            let fits = match node.parent {
                None => index == 0,
                Some((parent, _)) => parent < index,
            };
            if !fits {
                let parent = node.parent.map_or("nothing".to_owned(), |(parent, _)| format!("node {parent}"));
                return Err(TreeError::Parent { node: index, parent });
            }
        }
        Ok(())
    }
}

/// For each node whether it has a child.
fn children_exist(tree: &Tree) -> Vec<bool> {
    let mut has_child = vec![false; tree.len()];
    for parent in tree.nodes().filter_map(|node| tree.parent(node)) {
        has_child[parent.index()] = true;
    }
    has_child
}
