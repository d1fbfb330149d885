//! Best-first with proof: in the order of an admissible bound, until no open hypothesis can lead to a
//! map as good as the best ones found.
//!
//! Along one branch neither the genus, nor the number of places, nor that of closed ends ever falls
//! (see `Measure::bound`), so that every map below a node ranks no better than the node's bound.

use std::cmp::Reverse;
use std::fmt;

use hssh_topology::{Axioms, Measure, Preference};
use serde::Serialize;

use crate::crew::Crew;
use crate::experience::Experience;
use crate::frontier::{Frontier, Turn};
use crate::limits::{StopReason, Watch};
use crate::mapper::Goal;
use crate::report::Tally;
use crate::tree::{NodeId, Tree};

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
        let mut frontier = Frontier::default();
        let rank = preference.rank(Measure::default());
        frontier.push(Turn { rank, depth: Reverse(0), node: NodeId::ROOT, closed: false });
        Proof { goal, frontier, best: None, optimal: Vec::new(), proved: false }
    }

    /// All maps found that share the best rank.
    pub(crate) fn maps(&self) -> Vec<NodeId> {
        self.optimal.clone()
    }

    pub(crate) fn certificate(&self, tree: &Tree, experience: &Experience, expanded: u64) -> Certificate {
        let open_bound = self.frontier.peek().map(|turn| {
            let mut cursor = crate::Cursor::new(experience);
            let left = experience.observations.len() - turn.depth.0 as usize;
            Measure::bound(&cursor.go_to(turn.node, tree, experience).map, left as u32)
        });
        Certificate { best: self.best, open_bound, expanded, proved: self.proved }
    }

    /// Expands the open hypothesis with the least bound until the answer is proved.
    pub(crate) fn advance(
        &mut self,
        tree: &mut Tree,
        (experience, axioms, preference): (&Experience, &Axioms, Preference),
        (crew, watch): (&Crew, &Watch),
        tally: &mut Tally,
    ) -> StopReason {
        let travels = experience.observations.len() as u32;
        if travels == 0 {
            self.offer(
                NodeId::ROOT,
                Measure::of(&crate::Cursor::new(experience).into_hypothesis().map),
                preference,
            );
        }
        for expansions in 0_u64.. {
            if expansions.is_multiple_of(LOOK) {
                let bytes = tree.bytes() + self.frontier.bytes();
                let stop = watch.interruption().or_else(|| watch.excess(tree.len() as u64, bytes));
                if let Some(reason) = stop {
                    return reason;
                }
            }
            let best = self.best.map(|best| preference.rank(best));
            let promising =
                self.frontier.peek().is_some_and(|turn| best.is_none_or(|best| turn.rank <= best));
            let Some(turn) = promising.then(|| self.frontier.pop()).flatten() else { break };
            if turn.depth.0 == travels {
                continue;
            }
            let expansion = self.frontier.expansion(turn.node, tree, (experience, axioms), crew);
            tally.enter(turn.node, &expansion, tree);
            watch.add_nodes(expansion.successors.len() as u64);
            watch.explained(turn.depth.0 as usize);
            for scored in expansion.successors {
                let node = tree.push(scored.child);
                let depth = turn.depth.0 + 1;
                if depth == travels {
                    if self.goal.accepts(scored.closed) {
                        self.offer(node, scored.measure, preference);
                    }
                    continue;
                }
                let rank = preference.rank(scored.bound);
                let best = self.best.map(|best| preference.rank(best));
                if best.is_none_or(|best| rank <= best) {
                    self.frontier.push(Turn { rank, depth: Reverse(depth), node, closed: scored.closed });
                }
            }
        }
        self.proved = true;
        if self.best.is_some() { StopReason::Proved } else { StopReason::Exhausted }
    }

    /// A map that explains everything.
    fn offer(&mut self, node: NodeId, measure: Measure, preference: Preference) {
        let rank = preference.rank(measure);
        let best = self.best.map(|best| preference.rank(best));
        if best.is_none_or(|best| rank < best) {
            self.best = Some(measure);
            self.optimal.clear();
        }
        if best.is_none_or(|best| rank <= best) {
            self.optimal.push(node);
        }
    }
}
