//! Where a hypothesis takes the robot to have been, carried along from node to node of a tree.

use hssh_topology::{Hypothesis, Position};

use crate::experience::Experience;
use crate::tree::{NodeId, Tree};

/// The branch of a node, and where the robot was at each node of it. It goes to another node by what the two branches do not share.
#[derive(Clone, Debug, Default)]
pub(crate) struct Visited {
    branch: Vec<NodeId>,
    positions: Vec<Position>,
    /// By place: the visit on which it was found. Places are numbered in that order.
    first_visits: Vec<usize>,
}

impl Visited {
    /// Known positions, the start first.
    pub(crate) fn of(positions: &[Position]) -> Self {
        let mut visited = Visited::default();
        positions.iter().for_each(|&position| visited.push(position));
        visited
    }

    /// Goes to a node, of which `hypothesis` has the map; how many visits both branches share.
    pub(crate) fn go_to(
        &mut self,
        node: NodeId,
        tree: &Tree,
        hypothesis: &Hypothesis,
        experience: &Experience,
    ) -> usize {
        let mut way_down = Vec::new();
        let mut common = node;
        while self.branch.get(tree.depth(common)) != Some(&common) {
            way_down.push(common);
            match tree.parent(common) {
                Some(parent) => common = parent,
                None => break,
            }
        }
        let kept = tree.depth(node) + 1 - way_down.len();
        self.branch.truncate(kept);
        self.positions.truncate(kept);
        while self.first_visits.last().is_some_and(|&visit| visit >= kept) {
            self.first_visits.pop();
        }
        while let Some(node) = way_down.pop() {
            let arrival = tree.arrival(node).zip(tree.depth(node).checked_sub(1));
            self.branch.push(node);
            self.push(match arrival {
                Some((arrival, travel)) => {
                    hypothesis.position_at(arrival, experience.observations[travel].entry)
                }
                None => experience.root_position(),
            });
        }
        kept
    }

    fn push(&mut self, position: Position) {
        if position.place.index() == self.first_visits.len() {
            self.first_visits.push(self.positions.len());
        }
        self.positions.push(position);
    }

    /// Where the robot was after each travel, the start first.
    pub(crate) fn positions(&self) -> &[Position] {
        &self.positions
    }

    /// By place: the visit on which it was found.
    pub(crate) fn first_visits(&self) -> &[usize] {
        &self.first_visits
    }
}
