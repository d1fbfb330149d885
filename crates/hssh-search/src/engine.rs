//! One search through one tree, whatever it looks for and in whatever order.

use hssh_metrics::SolveError;
use serde::{Deserialize, Serialize};

use crate::branch::Branch;
use crate::context::Context;
use crate::cursor::Cursor;
use crate::elsewhere::Elsewhere;
use crate::fringe::Fringe;
use crate::frontier::Frontier;
use crate::leaf::{Appraise, Growth, Leaf, matters};
use crate::limits::StopReason;
use crate::order::{Goal, Order, Proving};
use crate::pack::Pack;
use crate::tally::Tally;
use crate::tree::Tree;
use crate::visit::MeasurementError;

/// Of the open hypotheses that got farthest, so many are laid out at most to find the best.
const MOST_SETTLED: usize = 64;

/// Sending leaves away is worth while if it frees this part of what a search holds.
const WORTHWHILE: u64 = 16;

/// The process may take this part more of what it may before memory that was freed must have been used anew…
const USED_ANEW: f64 = 0.02;
/// …and no more in all.
const TOO_MUCH: f64 = 1.05;

/// How far the sweeps are.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sweep {
    /// In the next cycle, levels before this one do not have their turn.
    pub(crate) from: usize,
    /// The cycle under way; nothing between two.
    pub(crate) cycle: Option<Cycle>,
    /// Of the reach, beyond the worst of the best maps: nats.
    pub(crate) slack: f64,
    /// Expansions when the best map became the best.
    pub(crate) best_since: u64,
    /// Expansions when the best maps were proved, and the search went on for the rest's probability.
    pub(crate) proved_after: Option<u64>,
}

/// How far a cycle of the sweeps is.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Cycle {
    /// Levels before this one do not have their turn.
    pub(crate) from: usize,
    pub(crate) step: usize,
    /// Whether the levels had their turns in this step.
    pub(crate) turned: bool,
    /// Whether there was nothing to do so far.
    pub(crate) idle: bool,
}

/// Of breadth-first: a level of appraised hypotheses that is not complete.
#[derive(Debug)]
pub(crate) struct GrowingLevel<A: Appraise> {
    /// How many nodes and maps there were before it, and what was counted.
    pub(crate) nodes: usize,
    pub(crate) maps: usize,
    pub(crate) tally: Tally,
    /// The level before, which it grows from.
    pub(crate) leaves: Vec<Leaf<A>>,
    /// The first of them that has not had its turn.
    pub(crate) next: usize,
}

/// A map that explains everything.
#[derive(Clone, Debug)]
pub(crate) struct Found<A: Appraise> {
    pub(crate) leaf: Leaf<A>,
    /// What decides between equal maps.
    pub(crate) branch: Branch,
}

/// A search under way. What was observed so far is explained by [`advance`](Self::advance); after
/// [`observe`](Self::observe) it goes on from what it has.
#[derive(Debug)]
pub(crate) struct Engine<A: Pack> {
    pub(crate) appraiser: A,
    pub(crate) order: Order,
    pub(crate) goal: Goal,
    pub(crate) proving: Proving,
    pub(crate) tree: Tree,
    pub(crate) tally: Tally,
    pub(crate) frontier: Frontier<A>,
    /// Of breadth-first.
    pub(crate) fringe: Fringe,
    /// Of breadth-first, if hypotheses are appraised and a level is not complete.
    pub(crate) growing: Option<GrowingLevel<A>>,
    /// Of breadth-first, if there was no time to look through the fringe: a complete level before it.
    pub(crate) shown: Option<Fringe>,
    /// Of cyclic best-first.
    pub(crate) sweep: Sweep,
    /// Maps that explain everything, the best first.
    pub(crate) found: Vec<Found<A>>,
    /// Hypotheses turned down because no closed map can come of them, until there is another travel.
    pub(crate) rejected: Vec<Leaf<A>>,
    /// Layouts found by least squares.
    pub(crate) solved: u64,
    /// By what factors keys rose of what was promised, where that was relied on, each with the bound of the hypothesis.
    pub(crate) factors: Vec<(Option<A::Key>, f64)>,
    /// How many travels the first hypothesis explains that has no computable layout, and why it has none.
    pub(crate) unsolvable: Option<(usize, SolveError)>,
    /// What a map may be worth and still matter; nothing if there is no map yet.
    pub(crate) reach: Option<A::Key>,
    /// Bytes of all leaves.
    pub(crate) bytes: u64,
    /// When leaves were sent away last: the bytes of tree and leaves, and the part that the process took of what it may.
    room: (u64, f64),
    /// Cursors that wait where they were used last.
    pub(crate) cursors: Vec<Cursor>,
    /// How many travels the search knows of.
    travels: usize,
    /// Whether there is a root: a limit may have come before.
    is_begun: bool,
}

impl<A: Pack> Engine<A> {
    /// A search that has not begun.
    ///
    /// # Errors
    /// If a travel cannot be used.
    pub(crate) fn new(
        appraiser: A,
        order: Order,
        goal: Goal,
        proving: Proving,
        elsewhere: Option<Elsewhere>,
        context: Context<'_>,
    ) -> Result<Self, MeasurementError> {
        let mut engine = Engine {
            appraiser,
            order,
            goal,
            proving,
            tree: Tree::new(),
            tally: Tally::new(),
            frontier: Frontier::new(elsewhere),
            fringe: Fringe::default(),
            growing: None,
            shown: None,
            sweep: Sweep::default(),
            found: Vec::new(),
            rejected: Vec::new(),
            solved: 0,
            factors: Vec::new(),
            unsolvable: None,
            reach: None,
            bytes: 0,
            room: (0, 0.0),
            cursors: Vec::new(),
            travels: 0,
            is_begun: false,
        };
        engine.observe(context)?;
        Ok(engine)
    }

    /// The first hypothesis.
    fn begin(&mut self, context: Context<'_>) {
        self.is_begun = true;
        if self.order != Order::BreadthFirst || A::WEIGHS {
            self.push(self.appraiser.root(context));
        }
    }

    /// Whether there is anything to search.
    pub(crate) fn is_begun(&self) -> bool {
        self.is_begun
    }

    /// Takes notice of the travels that are new: what explained everything is open again, and every bound looks
    /// ahead to them. A limit may stop it, and the next call goes on.
    ///
    /// # Errors
    /// If a travel cannot be used; the search is as it was then.
    pub(crate) fn observe(&mut self, context: Context<'_>) -> Result<Option<StopReason>, MeasurementError> {
        let before = self.travels;
        if self.is_begun && before == context.travels() {
            return Ok(None);
        }
        if let Some(reason) = self.appraiser.observe(context, &self.tree)? {
            return Ok(Some(reason));
        }
        self.travels = context.travels();
        self.frontier.make_room(self.travels);
        if !self.is_begun {
            self.begin(context);
            return Ok(None);
        }
        if !self.found.is_empty() {
            // What explained everything goes first.
            self.sweep = Sweep { from: before, ..Sweep::default() };
        }
        self.sweep.cycle = None;
        (self.sweep.slack, self.sweep.proved_after) = (0.0, None);
        self.reach = None;
        let found = self.found.drain(..).map(|found| found.leaf);
        let mut leaves: Vec<Leaf<A>> = found.chain(self.rejected.drain(..)).collect();
        leaves.extend(self.frontier.drain());
        leaves.sort_unstable_by_key(|leaf| leaf.node);
        self.bytes = 0;
        let mut cursor = self.lend_cursor(context);
        for mut leaf in leaves {
            self.appraiser.renew(&mut leaf, before, &mut cursor, &self.tree, context);
            self.push(leaf);
        }
        self.cursors.push(cursor);
        Ok(None)
    }

    /// How many travels the search knows of.
    pub(crate) fn travels(&self) -> usize {
        self.travels
    }

    /// Why the search has to stop now, if it has to. If memory is what it lacks, it sends away what it can.
    pub(crate) fn stop(&mut self, context: Context<'_>) -> Option<StopReason> {
        if self.frontier.lost().is_some() {
            return Some(StopReason::Interrupted);
        }
        let here = self.bytes - self.frontier.bytes_away();
        let reason = context.stop(&self.tree, here)?;
        let goes_on = reason == StopReason::MemoryLimit && self.send_away(context);
        (!goes_on).then_some(reason)
    }

    /// Makes room in memory; whether the search can go on.
    ///
    /// What is sent away leaves memory to this process that it takes before it asks the system for more: only when that must be used up,
    /// there is less room again.
    fn send_away(&mut self, context: Context<'_>) -> bool {
        let held = |engine: &Self| engine.tree.bytes() + engine.bytes - engine.frontier.bytes_away();
        let (before, taken) = (held(self), context.watch.taken().unwrap_or(0.0));
        if before < self.room.0 && taken < self.room.1 + USED_ANEW {
            return true;
        }
        let appraiser = &self.appraiser;
        let sent = self.frontier.send_away(|leaf| appraiser.bytes(leaf));
        tracing::debug!(sent, before, taken, "leaves sent away");
        self.room = (before, taken);
        sent > before / WORTHWHILE && taken < TOO_MUCH
    }

    pub(crate) fn lend_cursor(&mut self, context: Context<'_>) -> Cursor {
        self.cursors.pop().unwrap_or_else(|| Cursor::new(context.experience))
    }

    /// The end of a search that found everything it looked for.
    pub(crate) fn proved(&self) -> StopReason {
        if self.found.is_empty() { StopReason::Exhausted } else { StopReason::Proved }
    }

    /// Whether something that matters may come of a leaf.
    pub(crate) fn matters(&self, leaf: &Leaf<A>) -> bool {
        matters(&self.appraiser, leaf, self.reach)
    }

    /// Opens a hypothesis.
    pub(crate) fn push(&mut self, leaf: Leaf<A>) {
        self.bytes += self.appraiser.bytes(&leaf);
        self.frontier.push(leaf);
    }

    /// Sets a hypothesis aside.
    pub(crate) fn park(&mut self, leaf: Leaf<A>) {
        self.bytes += self.appraiser.bytes(&leaf);
        self.frontier.park(leaf);
    }

    /// Turns a hypothesis down: no closed map comes of it.
    pub(crate) fn reject(&mut self, leaf: Leaf<A>) {
        self.bytes += self.appraiser.bytes(&leaf);
        self.rejected.push(leaf);
    }

    /// Settles a hypothesis; whether that is possible. One that has no layout has had its turn.
    pub(crate) fn settle(&mut self, leaf: &mut Leaf<A>, cursor: &mut Cursor, context: Context<'_>) -> bool {
        self.solved += 1;
        match self.appraiser.settle(leaf, cursor, &self.tree, context) {
            Ok(factor) => {
                self.factors.extend(factor.map(|factor| (self.appraiser.bound(leaf), factor)));
                true
            }
            Err(problem) => {
                self.unsolvable.get_or_insert((leaf.depth(), problem));
                false
            }
        }
    }

    /// Puts the successors of an expanded hypothesis into the tree; they are its leaves.
    pub(crate) fn plant(&mut self, leaf: &Leaf<A>, grown: Growth<A>, context: Context<'_>) -> Vec<Leaf<A>> {
        let grown = match grown {
            Ok(grown) => grown,
            Err(problem) => {
                self.unsolvable.get_or_insert((leaf.depth() + 1, problem));
                return Vec::new();
            }
        };
        self.tally.enter(leaf, &grown, &mut self.tree);
        context.watch.add_nodes(grown.successors.len() as u64);
        context.watch.explained(leaf.depth() + usize::from(!grown.successors.is_empty()));
        let tree = &mut self.tree;
        let planted =
            grown.successors.into_iter().map(|(child, leaf)| Leaf { node: tree.push(child), ..leaf });
        planted.collect()
    }

    /// Puts the successors of an expanded hypothesis into the tree and where they belong.
    pub(crate) fn enter(&mut self, leaf: &Leaf<A>, mut grown: Growth<A>, context: Context<'_>) {
        if let Some(rest) = grown.as_mut().ok().and_then(|grown| grown.rest.take()) {
            if self.matters(&rest) { self.push(rest) } else { self.park(rest) }
        }
        for next in self.plant(leaf, grown, context) {
            let is_whole = next.depth() == self.travels;
            if is_whole && self.order == Order::Proof && self.appraiser.is_settled(&next) {
                self.judge(next);
            } else if !is_whole
                && self.appraiser.turns_down_early()
                && !self.goal.accepts(next.is_closable(self.travels))
            {
                self.reject(next);
            } else if self.order == Order::BestFirst || self.matters(&next) {
                self.push(next);
            } else {
                self.park(next);
            }
        }
    }

    /// A settled hypothesis that explains everything: it is found, turned down, or too bad to matter.
    pub(crate) fn judge(&mut self, leaf: Leaf<A>) {
        if !self.goal.accepts(leaf.is_closed()) {
            self.reject(leaf);
        } else if A::WEIGHS || self.matters(&leaf) {
            self.arrive(leaf);
        } else {
            self.park(leaf);
        }
    }

    /// A map that explains everything.
    pub(crate) fn arrive(&mut self, leaf: Leaf<A>) {
        self.bytes += self.appraiser.bytes(&leaf);
        let branch = self.tree.choices(leaf.node);
        let found = Found { leaf, branch };
        let order = |found: &Found<A>| (found.leaf.key, found.branch.clone());
        let place = self.found.partition_point(|other| {
            other.leaf.key < found.leaf.key
                || (other.leaf.key == found.leaf.key && order(other) < order(&found))
        });
        self.found.insert(place, found);
        if place == 0 {
            self.sweep.best_since = self.tally.expanded;
        }
        self.set_reach();
        if !A::WEIGHS {
            let kept = self.found.partition_point(|found| self.matters(&found.leaf));
            for found in self.found.split_off(kept) {
                self.frontier.park(found.leaf);
            }
        }
    }

    /// Sets what still matters: whatever is no worse than the last of the best maps that were asked for.
    pub(crate) fn set_reach(&mut self) {
        let last = self.found.get(self.proving.best.max(1) - 1);
        self.reach = last.map(|found| self.appraiser.reach(found.leaf.key, self.sweep.slack));
    }

    /// Of breadth-first: the level to be shown.
    pub(crate) fn level(&self) -> &Fringe {
        self.shown.as_ref().unwrap_or(&self.fringe)
    }

    /// Whether a hypothesis is no map of everything yet, or one that was not looked at yet.
    fn is_open(&self, leaf: &Leaf<A>) -> bool {
        leaf.depth() < self.travels || self.goal.accepts(leaf.is_closed())
    }

    /// How many travels the open hypotheses explain that got farthest.
    pub(crate) fn deepest(&self) -> Option<usize> {
        let mut deepest = None;
        self.frontier.visit(|leaf| {
            if self.is_open(leaf) {
                deepest = deepest.max(Some(leaf.depth()));
            }
        });
        deepest
    }

    /// The best one of the open hypotheses that got farthest, settled; none if none explains a travel.
    pub(crate) fn best_of_deepest(&self, context: Context<'_>) -> Option<Leaf<A>> {
        let deepest = self.deepest().filter(|&travels| travels > 0)?;
        let mut leaves: Vec<Leaf<A>> = Vec::new();
        self.frontier.visit(|leaf| {
            if self.is_open(leaf) && leaf.depth() == deepest {
                leaves.push(leaf.clone());
            }
        });
        leaves.sort_unstable_by_key(|leaf| (leaf.key, leaf.node));
        let mut cursor = Cursor::new(context.experience);
        let mut best: Option<Leaf<A>> = None;
        for (number, mut leaf) in leaves.into_iter().enumerate() {
            let is_beaten = best.as_ref().is_some_and(|best| best.key <= leaf.key);
            if is_beaten || (best.is_some() && number >= MOST_SETTLED) {
                break;
            }
            let is_settled = self.appraiser.is_settled(&leaf)
                || self.appraiser.settle(&mut leaf, &mut cursor, &self.tree, context).is_ok();
            if is_settled && best.as_ref().is_none_or(|best| leaf.key < best.key) {
                best = Some(leaf);
            }
        }
        best
    }

    /// The least that any map can be worth that was not found; nothing if there is none, or if nothing is known.
    pub(crate) fn open_bound(&self) -> Option<A::Key> {
        let mut least: Option<A::Key> = None;
        self.frontier.visit(|leaf| least = least.into_iter().chain(self.appraiser.bound(leaf)).min());
        least
    }

    /// The probability of everything that is still open, at most, where there are probabilities.
    pub(crate) fn rest(&self) -> Option<f64> {
        if !A::WEIGHS {
            return None;
        }
        let found = log_sum(self.found.iter().map(|found| -self.appraiser.nats(found.leaf.key)));
        let mut open = Vec::new();
        self.frontier.visit(|leaf| open.push(self.appraiser.log_mass(leaf)));
        let open = log_sum(open.into_iter());
        Some(if open == f64::NEG_INFINITY { 0.0 } else { 1.0 / (1.0 + (found - open).exp()) })
    }
}

/// ln Σ eˣ, in whatever order they come.
pub(crate) fn log_sum(logs: impl Iterator<Item = f64>) -> f64 {
    let mut logs: Vec<f64> = logs.collect();
    logs.sort_unstable_by(f64::total_cmp);
    let most = logs.last().copied().unwrap_or(f64::NEG_INFINITY);
    if most == f64::NEG_INFINITY {
        most
    } else {
        most + logs.iter().map(|log| (log - most).exp()).sum::<f64>().ln()
    }
}
