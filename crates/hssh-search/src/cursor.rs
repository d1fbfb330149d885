//! A hypothesis that moves from node to node of a tree by taking back and applying differences.

use hssh_topology::{Hypothesis, Position};

use crate::experience::Experience;
use crate::legs::Legs;
use crate::measured::Measured;
use crate::tree::{MapNumber, NodeId, Tree};
use crate::visited::Visited;

/// A hypothesis that can be moved from node to node of a tree: it goes up and down the tree of maps
/// by taking back and applying differences, so that no map is ever copied.
#[derive(Clone, Debug)]
pub struct Cursor {
    hypothesis: Hypothesis,
    at: MapNumber,
    way_down: Vec<MapNumber>,
    /// Where it was last asked for visits.
    visited: Visited,
    /// The first travels of that branch.
    legs: Legs,
}

impl Cursor {
    /// A cursor at the root.
    #[must_use]
    pub fn new(experience: &Experience) -> Self {
        let (visited, legs) = (Visited::default(), Legs::default());
        Cursor { hypothesis: experience.root(), at: MapNumber::ROOT, way_down: Vec::new(), visited, legs }
    }

    /// Moves to a node; the hypothesis there. Whatever was done to the hypothesis after the last
    /// move must have been taken back.
    pub fn go_to(&mut self, node: NodeId, tree: &Tree, experience: &Experience) -> &mut Hypothesis {
        self.go_to_map(tree.map(node), tree, experience);
        let arrival = tree.arrival(node).zip(tree.depth(node).checked_sub(1));
        self.hypothesis.position = match arrival {
            Some((arrival, travel)) => {
                self.hypothesis.position_at(arrival, experience.observations[travel].entry)
            }
            None => experience.root_position(),
        };
        &mut self.hypothesis
    }

    /// Moves to a node; where the robot was there, after each travel that it explains, the start first.
    #[must_use]
    pub fn visits(&mut self, node: NodeId, tree: &Tree, experience: &Experience) -> Vec<Position> {
        self.visited(node, tree, experience).positions().to_vec()
    }

    /// The same, carried along.
    pub(crate) fn visited(&mut self, node: NodeId, tree: &Tree, experience: &Experience) -> &Visited {
        self.go_to(node, tree, experience);
        let shared = self.visited.go_to(node, tree, &self.hypothesis, experience);
        self.legs.keep(shared.saturating_sub(1));
        &self.visited
    }

    /// The same with all travels that the node explains, as they were measured.
    pub(crate) fn travelled(
        &mut self,
        node: NodeId,
        tree: &Tree,
        experience: &Experience,
        measured: &Measured,
    ) -> (&Visited, &Legs) {
        self.visited(node, tree, experience);
        self.legs.follow(measured.frames.trail(&self.visited), measured);
        (&self.visited, &self.legs)
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
                common = tree.growth(common).parent;
            } else {
                let growth = tree.growth(self.at);
                self.hypothesis.shrink(growth.derivation());
                self.at = growth.parent;
            }
        }
        while let Some(map) = self.way_down.pop() {
            let growth = tree.growth(map);
            let star = experience.observations[growth.travel as usize].star;
            self.hypothesis.grow(
                growth.exit,
                growth.derivation(),
                star,
                growth.arrival(&self.hypothesis.map, experience),
                &experience.catalog,
            );
        }
        self.at = target;
    }
}
