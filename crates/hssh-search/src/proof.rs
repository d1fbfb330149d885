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
use crate::frontier::{Frontier, Order, Scored, Turn};
use crate::limits::StopReason;
use crate::mapper::Goal;
use crate::report::Tally;
use crate::tree::{NodeId, Tree};

/// Hypotheses of equal rank that are expanded together.
const ROUND: usize = 2048;

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
    /// Hypotheses that no closed map can come of, where closed ones were asked for.
    rejected: u64,
    /// The least rank that was too high to be queued.
    least_left_out: Option<Rank>,
    proved: bool,
    preference: Preference,
}

impl Proof {
    /// A search that starts at the root of a new tree.
    pub(crate) fn new(goal: Goal, preference: Preference) -> Self {
        let frontier = Frontier::from_root(Order::Bound, preference);
        Proof {
            goal,
            frontier,
            best: None,
            optimal: Vec::new(),
            rejected: 0,
            least_left_out: None,
            proved: false,
            preference,
        }
    }

    /// All maps found that share the best rank.
    pub(crate) fn maps(&self) -> Vec<NodeId> {
        self.optimal.clone()
    }

    /// How many hypotheses were turned down because no closed map can come of them.
    pub(crate) fn rejected(&self) -> u64 {
        self.rejected
    }

    pub(crate) fn certificate(&self, expanded: u64) -> Certificate {
        let next = self.frontier.peek().map(|turn| turn.rank);
        let open_bound = next.into_iter().chain(self.least_left_out).min();
        Certificate {
            best: self.best,
            open_bound: open_bound.map(|rank| self.preference.measure(rank)),
            expanded,
            proved: self.proved,
        }
    }

    /// Expands the open hypothesis with the least bound until the answer is proved.
    pub(crate) fn advance(&mut self, tree: &mut Tree, context: Context<'_>, tally: &mut Tally) -> StopReason {
        let (travels, preference) = (context.travels() as u32, context.preference);
        loop {
            if let Some(reason) = context.stop(tree, self.frontier.bytes()) {
                return reason;
            }
            if !self.frontier.peek().is_some_and(|turn| self.is_promising(turn.rank)) {
                break;
            }
            // All of one rank have their turn before the proof is done, so that none is expanded in vain.
            let mut turns = self.frontier.pop_equals(ROUND);
            if travels == 0 {
                // There is nothing to explain: the root does it.
                let root = Hypothesis::root(&context.experience.catalog, context.experience.start);
                self.arrive(NodeId::ROOT, Measure::of(&root.map), root.map.is_closed());
                turns.clear();
            }
            for (node, scored) in self.frontier.expand(&turns, tree, context, tally) {
                let Scored { score, closed, closable, .. } = scored;
                let (depth, rank) = (tree.depth(node) as u32, preference.rank(score));
                if depth == travels {
                    self.arrive(node, score, closed);
                } else if !self.goal.accepts(closable) {
                    self.rejected += 1;
                } else if self.is_promising(rank) {
                    self.frontier.push(Turn { rank, depth: Reverse(depth), node, closed });
                } else {
                    self.least_left_out = self.least_left_out.into_iter().chain([rank]).min();
                }
            }
        }
        self.proved = true;
        if self.best.is_some() { StopReason::Proved } else { StopReason::Exhausted }
    }

    /// Whether something of that rank may be as good as the best map found.
    fn is_promising(&self, rank: Rank) -> bool {
        self.best.is_none_or(|best| rank <= self.preference.rank(best))
    }

    /// A map that explains everything.
    fn arrive(&mut self, node: NodeId, measure: Measure, closed: bool) {
        let rank = self.preference.rank(measure);
        if !self.goal.accepts(closed) {
            self.rejected += 1;
        } else if self.is_promising(rank) {
            if self.best.is_none_or(|best| rank < self.preference.rank(best)) {
                self.best = Some(measure);
                self.optimal.clear();
            }
            self.optimal.push(node);
        }
    }
}
