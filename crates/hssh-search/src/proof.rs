//! Best-first with proof: in the order of an admissible bound, until no open hypothesis can lead to a
//! map as good as the best ones found.
//!
//! Along one branch neither the genus, nor the number of places, nor that of closed ends ever falls
//! (see `Measure::bound`), so that every map below a node ranks no better than the node's bound.

use std::cmp::Reverse;
use std::fmt;

use hssh_topology::{Hypothesis, Measure, Preference, Rank};
use serde::Serialize;

use crate::context::Context;
use crate::experience::Experience;
use crate::frontier::{Frontier, Scored, Turn};
use crate::limits::StopReason;
use crate::mapper::Goal;
use crate::report::Tally;
use crate::tree::{Cursor, NodeId, Tree};

/// Expansions between two looks at the limits.
const LOOK: u64 = 128;

/// What a best-first search with proof knows about its answer.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Certificate {
    /// What the best maps found measure.
    pub best: Option<Measure>,
    /// The least that a map not found yet can measure; nothing if there is none left.
    pub open_bound: Option<Measure>,
    /// Nodes that the recursive step was applied to.
    pub expanded: u64,
    /// Whether all maps as good as the best were found and none is better.
    pub proved: bool,
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let show = |measure: Option<Measure>| measure.map_or("none".to_owned(), |m| m.to_string());
        let verdict = if self.proved { "proved" } else { "not proved" };
        let (best, open) = (show(self.best), show(self.open_bound));
        write!(f, "{verdict}; best {best}; open from {open}; {} expanded", self.expanded)
    }
}

/// The open hypotheses and the best maps found.
#[derive(Debug)]
pub(crate) struct Proof {
    goal: Goal,
    frontier: Frontier,
    best: Option<Measure>,
    optimal: Vec<NodeId>,
    proved: bool,
}

impl Proof {
    /// A search that starts at the root of a new tree.
    pub(crate) fn new(goal: Goal, preference: Preference) -> Self {
        let frontier = Frontier::from_root(preference);
        Proof { goal, frontier, best: None, optimal: Vec::new(), proved: false }
    }

    /// All maps found that share the best rank.
    pub(crate) fn maps(&self) -> Vec<NodeId> {
        self.optimal.clone()
    }

    pub(crate) fn certificate(&self, tree: &Tree, experience: &Experience, expanded: u64) -> Certificate {
        let open_bound = self.frontier.peek().map(|turn| {
            let mut cursor = Cursor::new(experience);
            let left = experience.observations.len() - turn.depth.0 as usize;
            Measure::bound(&cursor.go_to(turn.node, tree, experience).map, left as u32)
        });
        Certificate { best: self.best, open_bound, expanded, proved: self.proved }
    }

    /// Expands the open hypothesis with the least bound until the answer is proved.
    pub(crate) fn advance(&mut self, tree: &mut Tree, context: Context<'_>, tally: &mut Tally) -> StopReason {
        let (travels, preference) = (context.travels() as u32, context.preference);
        for expansions in 0_u64.. {
            let look = expansions.is_multiple_of(LOOK);
            if let Some(reason) = look.then(|| context.stop(tree, self.frontier.bytes())).flatten() {
                return reason;
            }
            let promising = self.frontier.peek().is_some_and(|turn| self.is_promising(turn.rank, preference));
            let Some(turn) = promising.then(|| self.frontier.pop()).flatten() else { break };
            if turn.depth.0 == travels {
                // Maps that explain everything are never queued, but for the root if there is nothing to explain.
                let root = Hypothesis::root(&context.experience.catalog, context.experience.start);
                if self.goal.accepts(root.map.is_closed()) {
                    self.offer(turn.node, Measure::of(&root.map), preference);
                }
                continue;
            }
            let depth = turn.depth.0 + 1;
            for (node, scored) in self.frontier.expand(turn, tree, context, tally) {
                let Scored { measure, bound, closed, .. } = scored;
                let rank = preference.rank(bound);
                if depth < travels && self.is_promising(rank, preference) {
                    self.frontier.push(Turn { rank, depth: Reverse(depth), node, closed });
                } else if depth == travels && self.goal.accepts(closed) {
                    self.offer(node, measure, preference);
                }
            }
        }
        self.proved = true;
        if self.best.is_some() { StopReason::Proved } else { StopReason::Exhausted }
    }

    /// Whether something of that rank may be as good as the best map found.
    fn is_promising(&self, rank: Rank, preference: Preference) -> bool {
        self.best.is_none_or(|best| rank <= preference.rank(best))
    }

    /// A map that explains everything.
    fn offer(&mut self, node: NodeId, measure: Measure, preference: Preference) {
        let rank = preference.rank(measure);
        if !self.is_promising(rank, preference) {
            return;
        }
        if self.best.is_none_or(|best| rank < preference.rank(best)) {
            self.best = Some(measure);
            self.optimal.clear();
        }
        self.optimal.push(node);
    }
}
