//! The tree of hypotheses: each node a small difference to its parent.

use hssh_topology::{Derivation, MapOlp, Outcome, TopologicalMap};
use serde::{Deserialize, Serialize};

use crate::branch::Branch;
use crate::experience::Experience;

/// A hypothesis of a [`Tree`]. The number is a handle into this tree; what identifies a hypothesis anywhere is
/// its [`Branch`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct NodeId(u32);

impl NodeId {
    /// The root: one place with the first star.
    pub const ROOT: NodeId = NodeId(0);

    /// The node with that number in order of creation.
    #[must_use]
    pub const fn new(number: u32) -> Self {
        NodeId(number)
    }

    /// The node as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// 16 bytes: a node is its parent, its map, and the gateway by which the robot arrived.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Node {
    parent: NodeId,
    map: MapNumber,
    arrival: MapOlp,
    depth: u32,
}

/// A map of the tree; the root's is number 0. Maps form a tree of their own.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub(crate) struct MapNumber(u32);

impl MapNumber {
    pub(crate) const ROOT: MapNumber = MapNumber(0);
}

/// 16 bytes: a map is its parent and the link that was added to it by the travel number `travel`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Growth {
    pub(crate) parent: MapNumber,
    pub(crate) travel: u32,
    pub(crate) exit: MapOlp,
    /// The gateway that closes a loop, or none for a new place.
    closure: MapOlp,
}

/// Stands for "no gateway" where a gateway is stored.
const NO_GATEWAY: MapOlp = MapOlp::new(u32::MAX);

impl Growth {
    pub(crate) fn derivation(self) -> Derivation {
        if self.closure == NO_GATEWAY { Derivation::NewPlace } else { Derivation::Closure(self.closure) }
    }

    /// The gateway by which the robot came, in the parent's map.
    pub(crate) fn arrival(self, parent: &TopologicalMap, experience: &Experience) -> MapOlp {
        match self.derivation() {
            Derivation::Closure(gateway) => gateway,
            _ => parent.olp_of_next_place(experience.observations[self.travel as usize].entry),
        }
    }
}

/// A successor that is not in the tree yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Child {
    pub(crate) parent: NodeId,
    pub(crate) derivation: Derivation,
    /// The gateway by which the robot leaves, in the parent's map.
    pub(crate) exit: MapOlp,
    /// The gateway by which it arrives.
    pub(crate) arrival: MapOlp,
}

/// All hypotheses made so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tree {
    nodes: Vec<Node>,
    outcomes: Vec<Outcome>,
    maps: Vec<Growth>,
}

impl Default for Tree {
    fn default() -> Self {
        Tree::new()
    }
}

impl Tree {
    /// The tree with nothing but its root.
    #[must_use]
    pub fn new() -> Self {
        let (parent, map) = (NodeId::ROOT, MapNumber::ROOT);
        Tree {
            nodes: vec![Node { parent, map, arrival: NO_GATEWAY, depth: 0 }],
            outcomes: vec![Outcome::Open],
            maps: vec![Growth { parent: map, travel: 0, exit: NO_GATEWAY, closure: NO_GATEWAY }],
        }
    }

    /// How many nodes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never: the root is always there.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// How many maps there are: the root's and one for each child of an expansion.
    #[must_use]
    pub fn map_count(&self) -> usize {
        self.maps.len()
    }

    /// The memory that the nodes take.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let node = size_of::<Node>() + size_of::<Outcome>();
        (self.nodes.len() * node + self.maps.len() * size_of::<Growth>()) as u64
    }

    /// All nodes in order of creation.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = NodeId> + use<> {
        (0..self.nodes.len()).map(|node| NodeId(node as u32))
    }

    /// The parent of a node, `None` for the root.
    #[must_use]
    pub fn parent(&self, node: NodeId) -> Option<NodeId> {
        (node != NodeId::ROOT).then(|| self.nodes[node.index()].parent)
    }

    /// How many travels a node explains.
    #[must_use]
    pub fn depth(&self, node: NodeId) -> usize {
        self.nodes[node.index()].depth as usize
    }

    /// What became of a node when the next observation was applied to it.
    #[must_use]
    pub fn outcome(&self, node: NodeId) -> Outcome {
        self.outcomes[node.index()]
    }

    /// How a node came from its parent; `None` for the root.
    #[must_use]
    pub fn derivation(&self, node: NodeId) -> Option<Derivation> {
        let parent = self.parent(node)?;
        let map = self.nodes[node.index()].map;
        let is_shared = map == self.nodes[parent.index()].map;
        Some(if is_shared { Derivation::Predicted } else { self.growth(map).derivation() })
    }

    /// The gateway by which the robot arrived, in the node's map; `None` at the root.
    #[must_use]
    pub fn arrival(&self, node: NodeId) -> Option<MapOlp> {
        (node != NodeId::ROOT).then(|| self.nodes[node.index()].arrival)
    }

    /// The nodes from the root down to `node`, both included.
    #[must_use]
    pub fn branch(&self, node: NodeId) -> Vec<NodeId> {
        let mut branch: Vec<NodeId> = std::iter::successors(Some(node), |&node| self.parent(node)).collect();
        branch.reverse();
        branch
    }

    /// The choices that lead to a node: what it is, in any tree.
    #[must_use]
    pub fn choices(&self, node: NodeId) -> Branch {
        self.branch(node).into_iter().filter_map(|node| self.derivation(node)).collect()
    }

    /// The choice that led to a node, with the gateways that the robot left and came by, as far as it matters; `None` for the root.
    pub(crate) fn choice(&self, node: NodeId) -> Option<(Derivation, MapOlp, MapOlp)> {
        let derivation = self.derivation(node)?;
        let Node { map, arrival, .. } = self.nodes[node.index()];
        // Only a link that is added has to say where from.
        let is_added = derivation != Derivation::Predicted;
        let exit = if is_added { self.growth(map).exit } else { MapOlp::new(0) };
        Some((derivation, exit, arrival))
    }

    /// Whether a tree that was read is one, of so many travels.
    pub(crate) fn is_sound(&self, travels: usize) -> bool {
        let Tree { nodes, outcomes, maps } = self;
        let is_map = |(number, map): (usize, &Growth)| {
            number == 0 || ((map.parent.0 as usize) < number && (map.travel as usize) < travels)
        };
        let is_node = |(number, node): (usize, &Node)| {
            if number == 0 {
                return node.depth == 0 && node.map == MapNumber::ROOT;
            }
            let Some(parent) = nodes[..number].get(node.parent.index()) else { return false };
            let Some(map) = maps.get(node.map.0 as usize) else { return false };
            let is_grown =
                node.map != MapNumber::ROOT && map.parent == parent.map && map.travel == parent.depth;
            node.depth == parent.depth + 1
                && node.depth as usize <= travels
                && (node.map == parent.map || is_grown)
        };
        !nodes.is_empty()
            && !maps.is_empty()
            && nodes.len() == outcomes.len()
            && maps.iter().enumerate().all(is_map)
            && nodes.iter().enumerate().all(is_node)
    }

    pub(crate) fn map(&self, node: NodeId) -> MapNumber {
        self.nodes[node.index()].map
    }

    pub(crate) fn growth(&self, map: MapNumber) -> Growth {
        self.maps[map.0 as usize]
    }

    pub(crate) fn set_outcome(&mut self, node: NodeId, outcome: Outcome) {
        self.outcomes[node.index()] = outcome;
    }

    pub(crate) fn push(&mut self, child: Child) -> NodeId {
        let parent = self.nodes[child.parent.index()];
        let closure = match child.derivation {
            Derivation::Predicted => None,
            Derivation::NewPlace => Some(NO_GATEWAY),
            Derivation::Closure(gateway) => Some(gateway),
        };
        let map = closure.map_or(parent.map, |closure| {
            let (travel, exit) = (parent.depth, child.exit);
            self.maps.push(Growth { parent: parent.map, travel, exit, closure });
            MapNumber(self.maps.len() as u32 - 1)
        });
        self.nodes.push(Node { parent: child.parent, map, arrival: child.arrival, depth: parent.depth + 1 });
        self.outcomes.push(Outcome::Open);
        NodeId(self.nodes.len() as u32 - 1)
    }

    /// Forgets all nodes from number `nodes` on, and all maps from number `maps` on.
    pub(crate) fn truncate(&mut self, nodes: usize, maps: usize) {
        self.nodes.truncate(nodes);
        self.outcomes.truncate(nodes);
        self.maps.truncate(maps);
    }
}
