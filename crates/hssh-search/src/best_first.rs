//! Best-first by preference, as in the thesis (section 2.3.1): only the successors of the best map
//! among those that exist are made.

use std::cmp::Reverse;

use hssh_topology::{Axioms, Measure, Preference};

use crate::crew::Crew;
use crate::experience::Experience;
use crate::frontier::{Frontier, Turn};
use crate::limits::{StopReason, Watch};
use crate::mapper::Goal;
use crate::report::Tally;
use crate::tree::{NodeId, Tree};

/// Expansions between two looks at the limits.
const LOOK: u64 = 128;

/// The open hypotheses and the maps found.
#[derive(Debug)]
pub(crate) struct BestFirst {
    goal: Goal,
    frontier: Frontier,
    found: Option<Turn>,
    /// Maps that explain everything but are not what was asked for: the search went back.
    rejected: Vec<Turn>,
}

impl BestFirst {
    pub(crate) fn new(goal: Goal, preference: Preference) -> Self {
        let mut frontier = Frontier::default();
        let rank = preference.rank(Measure::default());
        frontier.push(Turn { rank, depth: Reverse(0), node: NodeId::ROOT, closed: false });
        BestFirst { goal, frontier, found: None, rejected: Vec::new() }
    }

    /// The map found; if there is none, those that explain everything but are not closed.
    pub(crate) fn maps(&self) -> Vec<NodeId> {
        match self.found {
            Some(turn) => vec![turn.node],
            None => self.rejected.iter().map(|turn| turn.node).collect(),
        }
    }

    /// There is one more travel to explain: what explained all of them is open again.
    pub(crate) fn reopen(&mut self) {
        let explained = self.found.take().into_iter().chain(self.rejected.drain(..));
        explained.for_each(|turn| self.frontier.push(turn));
    }

    /// Expands the best open hypothesis until the best one explains everything and, if asked for, is
    /// closed.
    pub(crate) fn advance(
        &mut self,
        tree: &mut Tree,
        (experience, axioms, preference): (&Experience, &Axioms, Preference),
        (crew, watch): (&Crew, &Watch),
        tally: &mut Tally,
    ) -> StopReason {
        let travels = experience.observations.len();
        if self.found.is_some() {
            return StopReason::Found;
        }
        for expansions in 0_u64.. {
            if expansions.is_multiple_of(LOOK) {
                let bytes = tree.bytes() + self.frontier.bytes();
                let stop = watch.interruption().or_else(|| watch.excess(tree.len() as u64, bytes));
                if let Some(reason) = stop {
                    return reason;
                }
            }
            let Some(turn) = self.frontier.pop() else { break };
            if turn.depth.0 as usize == travels {
                if self.goal.accepts(turn.closed) {
                    self.found = Some(turn);
                    return StopReason::Found;
                }
                self.rejected.push(turn);
                continue;
            }
            let expansion = self.frontier.expansion(turn.node, tree, (experience, axioms), crew);
            tally.enter(turn.node, &expansion, tree);
            watch.add_nodes(expansion.successors.len() as u64);
            watch.explained(turn.depth.0 as usize);
            for scored in expansion.successors {
                let node = tree.push(scored.child);
                let depth = Reverse(turn.depth.0 + 1);
                self.frontier.push(Turn {
                    rank: preference.rank(scored.measure),
                    depth,
                    node,
                    closed: scored.closed,
                });
            }
        }
        StopReason::Exhausted
    }
}
