//! The tree of hypotheses: each node a small difference to its parent, and cursors that visit them.

use hssh_topology::{Extension, Hypothesis, MapOlp, Observation, Position};

use crate::experience::Experience;

/// A hypothesis of a [`Tree`], numbered in order of creation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct NodeId(pub u32);

impl NodeId {
    /// The root: one place with the first star.
    pub const ROOT: NodeId = NodeId(0);

    fn index(self) -> usize {
        self.0 as usize
    }
}

/// What became of a node when the next observation was applied to it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// It was not applied yet.
    Open,
    /// p-c: one child with the same map.
    Predicted,
    /// p-nc: the map is refuted.
    Refuted,
    /// e: one child per consistent extension; none if the axioms removed them all.
    Expanded,
}

/// How a node came from its parent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Derived {
    /// It is the root.
    Root,
    /// By p-c: it shares its parent's map.
    Shared,
    /// By e: its map extends its parent's map.
    Extended(Extension),
}

/// 16 bytes: a node is its parent, its map, and the gateway by which the robot arrived.
#[derive(Clone, Copy, Debug)]
struct Node {
    parent: NodeId,
    map: MapNumber,
    arrival: MapOlp,
    depth: u32,
}

/// A map of the tree; the root's is number 0. Maps form a tree of their own.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct MapNumber(u32);

/// 16 bytes: a map is its parent and the link that was added to it by the travel number `travel`.
#[derive(Clone, Copy, Debug)]
struct Growth {
    parent: MapNumber,
    travel: u32,
    exit: MapOlp,
    /// The gateway that closes a loop, or none for a new place.
    closure: MapOlp,
}

/// Stands for "no gateway" where a gateway is stored.
const NO_GATEWAY: MapOlp = MapOlp::new(u32::MAX);

impl Growth {
    fn extension(self) -> Extension {
        if self.closure == NO_GATEWAY { Extension::NewPlace } else { Extension::Closure(self.closure) }
    }
}

/// A successor that is not in the tree yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Child {
    pub(crate) parent: NodeId,
    /// The gateway by which the robot arrives.
    pub(crate) arrival: MapOlp,
    /// How the map grows from which exit; nothing if the child shares its parent's map.
    pub(crate) growth: Option<(MapOlp, Extension)>,
}

/// All hypotheses made so far.
#[derive(Clone, Debug)]
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
        let (parent, map) = (NodeId::ROOT, MapNumber(0));
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

    /// What became of a node.
    #[must_use]
    pub fn outcome(&self, node: NodeId) -> Outcome {
        self.outcomes[node.index()]
    }

    /// How a node came from its parent.
    #[must_use]
    pub fn derived(&self, node: NodeId) -> Derived {
        let Some(parent) = self.parent(node) else { return Derived::Root };
        let map = self.nodes[node.index()].map;
        if map == self.nodes[parent.index()].map {
            Derived::Shared
        } else {
            Derived::Extended(self.maps[map.0 as usize].extension())
        }
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

    pub(crate) fn set_outcome(&mut self, node: NodeId, outcome: Outcome) {
        self.outcomes[node.index()] = outcome;
    }

    pub(crate) fn push(&mut self, child: Child) -> NodeId {
        let parent = self.nodes[child.parent.index()];
        let map = child.growth.map_or(parent.map, |(exit, extension)| {
            let closure = match extension {
                Extension::NewPlace => NO_GATEWAY,
                Extension::Closure(gateway) => gateway,
            };
            self.maps.push(Growth { parent: parent.map, travel: parent.depth, exit, closure });
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

/// A hypothesis that can be moved from node to node of a tree: it goes up and down the tree of maps
/// by retracting and applying differences.
#[derive(Clone, Debug)]
pub struct Cursor {
    hypothesis: Hypothesis,
    at: MapNumber,
    way_down: Vec<MapNumber>,
}

impl Cursor {
    /// A cursor at the root.
    #[must_use]
    pub fn new(experience: &Experience) -> Self {
        let hypothesis = Hypothesis::root(&experience.catalog, experience.start);
        Cursor { hypothesis, at: MapNumber(0), way_down: Vec::new() }
    }

    /// Moves to a node; the hypothesis there. Whatever was done to the hypothesis after the last
    /// move must have been taken back.
    pub fn go_to(&mut self, node: NodeId, tree: &Tree, experience: &Experience) -> &mut Hypothesis {
        let Node { map, arrival, depth, .. } = tree.nodes[node.index()];
        self.go_to_map(map, tree, experience);
        match experience.observations.get((depth as usize).wrapping_sub(1)) {
            Some(observation) => self.hypothesis.arrive(arrival, observation.entry),
            None => {
                self.hypothesis.position = Hypothesis::root(&experience.catalog, experience.start).position
            }
        }
        &mut self.hypothesis
    }

    /// Moves to a node; where the robot was there, after each travel that it explains, the start first.
    #[must_use]
    pub fn visits(&mut self, node: NodeId, tree: &Tree, experience: &Experience) -> Vec<Position> {
        let hypothesis = self.go_to(node, tree, experience);
        let start = Hypothesis::root(&experience.catalog, experience.start).position;
        let branch = tree.branch(node);
        let arrivals = branch.iter().filter_map(|&node| tree.arrival(node));
        let came = arrivals.zip(&experience.observations);
        let visits = came.map(|(arrival, observation)| hypothesis.position_at(arrival, observation.entry));
        std::iter::once(start).chain(visits).collect()
    }

    /// The hypothesis at the node it was moved to last.
    #[must_use]
    pub fn into_hypothesis(self) -> Hypothesis {
        self.hypothesis
    }

    /// A parent has a lower number than its children, so that the deeper of two maps in the sense
    /// of numbers is never an ancestor of the other.
    fn go_to_map(&mut self, target: MapNumber, tree: &Tree, experience: &Experience) {
        let mut common = target;
        self.way_down.clear();
        while self.at != common {
            if common > self.at {
                self.way_down.push(common);
                common = tree.maps[common.0 as usize].parent;
            } else {
                let growth = tree.maps[self.at.0 as usize];
                self.hypothesis.retract(growth.extension());
                self.at = growth.parent;
            }
        }
        while let Some(map) = self.way_down.pop() {
            let growth = tree.maps[map.0 as usize];
            let observation: Observation = experience.observations[growth.travel as usize];
            self.hypothesis.extend(growth.exit, growth.extension(), observation, &experience.catalog);
        }
        self.at = target;
    }
}
