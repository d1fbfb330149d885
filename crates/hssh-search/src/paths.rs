//! Nodes of one tree told to whoever has another one: by the choices that lead to them, each written as far as it differs from the one before.

use std::collections::HashMap;

use hssh_topology::{Derivation, MapOlp};
use serde::{Deserialize, Serialize};

use crate::cursor::Cursor;
use crate::experience::Experience;
use crate::tree::{Child, NodeId, Tree};

/// A choice, with the gateways that the robot left and came by: who has them replays no step.
pub(crate) type Choice = (Derivation, MapOlp, MapOlp);

/// Nodes, by the way from the root to each.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Paths(Vec<Path>);

/// As many choices as it shares with the one before, and the rest.
#[derive(Serialize, Deserialize)]
struct Path(u32, Vec<Choice>);

impl Paths {
    /// The ways to nodes of a tree.
    pub(crate) fn to(nodes: impl Iterator<Item = NodeId>, tree: &Tree) -> Self {
        let mut last: Vec<NodeId> = Vec::new();
        Paths(nodes.map(|node| Path::to(node, tree, &mut last)).collect())
    }
}

impl Path {
    /// The way to a node; `last` is the way to the node before, which it becomes.
    fn to(node: NodeId, tree: &Tree, last: &mut Vec<NodeId>) -> Self {
        let depth = tree.depth(node);
        let is_shared = |(_, node): &(usize, NodeId)| {
            let depth = tree.depth(*node);
            depth == 0 || last.get(depth - 1) == Some(node)
        };
        let ways_up = std::iter::successors(Some(node), |&node| tree.parent(node)).enumerate();
        let mut new: Vec<NodeId> =
            ways_up.take_while(|place| !is_shared(place)).map(|(_, node)| node).collect();
        new.reverse();
        last.truncate(depth - new.len());
        let shared = last.len() as u32;
        let choice = |&node: &NodeId| tree.choice(node);
        let choices = new.iter().filter_map(choice).collect();
        last.extend(new);
        Path(shared, choices)
    }
}

/// Beyond so many nodes a [`Prefixes`] begins anew.
const MOST: usize = 1 << 17;

/// No more fronts have cursors of their own.
const MOST_CURSORS: usize = 16;

/// The part of a tree that was heard of, and where in it cursors stand.
#[derive(Debug)]
pub(crate) struct Prefixes {
    pub(crate) tree: Tree,
    /// By front: where its turns were.
    cursors: Vec<Cursor>,
    known: HashMap<(NodeId, Derivation), NodeId>,
}

impl Prefixes {
    pub(crate) fn new(experience: &Experience) -> Self {
        Prefixes { tree: Tree::new(), cursors: vec![Cursor::new(experience)], known: HashMap::new() }
    }

    /// The tree, and the cursor of a front.
    pub(crate) fn at(&mut self, front: usize, experience: &Experience) -> (&Tree, &mut Cursor) {
        let front = front % MOST_CURSORS;
        while self.cursors.len() <= front {
            self.cursors.push(Cursor::new(experience));
        }
        (&self.tree, &mut self.cursors[front])
    }

    /// The nodes that ways lead to, of at most so many travels. `None` if a way is none.
    pub(crate) fn find(&mut self, paths: &Paths, experience: &Experience) -> Option<Vec<NodeId>> {
        if self.tree.len() > MOST {
            *self = Prefixes::new(experience);
        }
        let mut way = vec![NodeId::ROOT];
        let mut nodes = Vec::with_capacity(paths.0.len());
        for Path(shared, choices) in &paths.0 {
            let shared = *shared as usize;
            if shared >= way.len() || shared + choices.len() > experience.observations.len() {
                return None;
            }
            way.truncate(shared + 1);
            for &(derivation, exit, arrival) in choices {
                let parent = way[way.len() - 1];
                let tree = &mut self.tree;
                let known = self.known.entry((parent, derivation));
                way.push(*known.or_insert_with(|| tree.push(Child { parent, derivation, exit, arrival })));
            }
            nodes.push(way[way.len() - 1]);
        }
        Some(nodes)
    }
}
