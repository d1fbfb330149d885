//! Best-first by preference, as in the thesis (section 2.3.1): only the successors of the best map
//! among those that exist are made.
//!
//! Which map that is depends on the expansion before, so that more threads have nothing to do.

use std::cmp::Reverse;

use hssh_topology::Preference;

use crate::context::Context;
use crate::frontier::{Frontier, Order, Scored, Turn};
use crate::limits::StopReason;
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
        let frontier = Frontier::from_root(Order::Measure, preference);
        BestFirst { goal, frontier, found: None, rejected: Vec::new() }
    }

    /// The map found, if there is one.
    pub(crate) fn maps(&self) -> Vec<NodeId> {
        self.found.iter().map(|turn| turn.node).collect()
    }

    /// How many maps explain everything but are not closed, where a closed one was asked for.
    pub(crate) fn rejected(&self) -> u64 {
        self.rejected.len() as u64
    }

    /// There is one more travel to explain: what explained all of them is open again.
    pub(crate) fn reopen(&mut self) {
        let explained = self.found.take().into_iter().chain(self.rejected.drain(..));
        explained.for_each(|turn| self.frontier.push(turn));
    }

    /// Expands the best open hypothesis until the best one explains everything and, if asked for, is
    /// closed.
    pub(crate) fn advance(&mut self, tree: &mut Tree, context: Context<'_>, tally: &mut Tally) -> StopReason {
        if self.found.is_some() {
            return StopReason::Found;
        }
        for expansions in 0_u64.. {
            let look = expansions.is_multiple_of(LOOK);
            if let Some(reason) = look.then(|| context.stop(tree, self.frontier.bytes())).flatten() {
                return reason;
            }
            let Some(turn) = self.frontier.pop() else { break };
            if (turn.depth.0 as usize) < context.travels() {
                let depth = Reverse(turn.depth.0 + 1);
                for (node, Scored { score, closed, .. }) in
                    self.frontier.expand(&[turn], tree, context, tally)
                {
                    self.frontier.push(Turn { rank: context.preference.rank(score), depth, node, closed });
                }
            } else if self.goal.accepts(turn.closed) {
                self.found = Some(turn);
                return StopReason::Found;
            } else {
                self.rejected.push(turn);
            }
        }
        StopReason::Exhausted
    }
}
