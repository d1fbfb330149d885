//! The tree depth-first, by growing one map and taking it back: memory does not grow with the nodes.

use std::ops::ControlFlow;

use hssh_topology::{Axioms, Derivation, Extension, Hypothesis, MapOlp, Observation, Position, Removals};

use crate::experience::Experience;

/// What is done at the nodes of a [`depth_first`] walk. Every method does nothing unless overridden.
pub trait Visitor {
    /// A node that explains the first `depth` travels; `new_map` unless it shares its parent's map.
    /// To break ends the walk: no further node is visited.
    fn node(&mut self, depth: usize, new_map: bool) -> ControlFlow<()> {
        let _ = (depth, new_map);
        ControlFlow::Continue(())
    }

    /// The recursive step is about to be applied to a node.
    fn step(&mut self, hypothesis: &Hypothesis, observation: Observation) {
        let _ = (hypothesis, observation);
    }

    /// The observation after `depth` travels refutes the node (p-nc).
    fn refuted(&mut self, depth: usize) {
        let _ = depth;
    }

    /// The node explains all travels.
    fn last(&mut self, hypothesis: &Hypothesis) {
        let _ = hypothesis;
    }
}

/// What was done at a node to go below it.
enum Frame {
    /// Nothing but to move the robot.
    Followed { before: Position },
    /// The map is extended by each of the extensions of that depth in turn.
    Expanding { before: Position, exit: MapOlp, next: usize },
}

/// Visits every node from `hypothesis` down, which explains the first `depth` travels, in the order
/// of creation of a breadth-first search cut down to one branch. The hypothesis is left as it was. The
/// number of successors that each axiom removed.
pub fn depth_first(
    hypothesis: &mut Hypothesis,
    depth: usize,
    experience: &Experience,
    axioms: &Axioms,
    visitor: &mut impl Visitor,
) -> Removals {
    let Experience { catalog, observations, .. } = experience;
    let mut removals = Removals::default();
    let mut stack: Vec<Frame> = Vec::new();
    let mut ended = false;
    let mut extensions: Vec<Vec<Extension>> = vec![Vec::new(); observations.len().saturating_sub(depth)];

    loop {
        // Apply the next observation to the node that was just entered.
        let level = stack.len();
        match observations.get(depth + level) {
            _ if ended => {}
            None => visitor.last(hypothesis),
            Some(&observation) => {
                visitor.step(hypothesis, observation);
                let before = hypothesis.position;
                let found = &mut extensions[level];
                match hypothesis.step(observation, catalog, axioms, found, &mut removals) {
                    Derivation::PredictedInconsistent => visitor.refuted(depth + level),
                    Derivation::Expand(exit) => stack.push(Frame::Expanding { before, exit, next: 0 }),
                    Derivation::PredictedConsistent(arrival) => {
                        hypothesis.arrive(arrival, observation.entry);
                        stack.push(Frame::Followed { before });
                        ended = visitor.node(depth + level + 1, false).is_break();
                        continue;
                    }
                }
            }
        }
        // Go back up to the next node that has a successor left, and enter that one.
        loop {
            let level = stack.len().wrapping_sub(1);
            match stack.last_mut() {
                None => return removals,
                Some(Frame::Followed { before }) => hypothesis.position = *before,
                Some(Frame::Expanding { before, exit, next }) => {
                    if *next > 0 {
                        hypothesis.position = *before;
                        hypothesis.retract(extensions[level][*next - 1]);
                    }
                    let left = if ended { &[] } else { &extensions[level][*next..] };
                    if let Some(&extension) = left.first() {
                        *next += 1;
                        let observation = observations[depth + level];
                        let arrival = hypothesis.extend(*exit, extension, observation, catalog);
                        hypothesis.arrive(arrival, observation.entry);
                        ended = visitor.node(depth + level + 1, true).is_break();
                        break;
                    }
                }
            }
            stack.pop();
        }
    }
}
