//! Cyclic best-first: the best hypothesis of every number of travels explained, in turn, until the answer is proved.
//!
//! Comparing only hypotheses that explain equally much is fair whatever a travel costs, so that a complete map is found
//! soon; and none is dropped, so that the search can come back. A long exploration is swept by several fronts at
//! once, a fixed number of levels apart: what one front does no other sees before the step is over, so that threads can
//! share the step, and the result does not depend on how many they are. Once there is a map, the proof asks for all that is
//! within reach, and fronts with nothing to do help the others.

use hssh_metrics::SolveError;

use crate::context::Context;
use crate::cursor::Cursor;
use crate::engine::{Cycle, Engine};
use crate::frontier::Level;
use crate::leaf::{Appraise, Growth, Leaf, matters};
use crate::limits::StopReason;
use crate::tree::Tree;

/// Up to so many travels there is one front.
const ONE_FRONT: usize = 32;

/// How many fronts there are for more.
const FRONTS: usize = 8;

/// By how many nats the reach of a search grows as long as too much probability is left.
const WIDENING: f64 = 1.0;

/// For the probability of the rest a search expands so many hypotheses more than it did for the proof.
const REST_WORK: u64 = 2_000;

/// What came of one level's turn.
struct Turn<A: Appraise> {
    /// The hypothesis that was expanded.
    expanded: Option<(Leaf<A>, Growth<A>)>,
    /// Those that turned out to be beyond reach.
    beyond: Vec<Leaf<A>>,
    /// Those that have no layout.
    unsolvable: Vec<(Leaf<A>, SolveError)>,
    /// By what factors keys rose of what was promised, each with the leaf's bound.
    factors: Vec<(Option<A::Key>, f64)>,
    solved: u64,
    /// By how many bytes hypotheses grew when they were settled.
    grown: i64,
}

impl<A: Appraise> Default for Turn<A> {
    fn default() -> Self {
        Turn {
            expanded: None,
            beyond: Vec::new(),
            unsolvable: Vec::new(),
            factors: Vec::new(),
            solved: 0,
            grown: 0,
        }
    }
}

impl<A: Appraise> Turn<A> {
    /// Settles a hypothesis; it is returned if something may still come of it.
    fn settled(
        &mut self,
        appraiser: &A,
        mut leaf: Leaf<A>,
        reach: Option<A::Key>,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Option<Leaf<A>> {
        if matters(appraiser, &leaf, reach) && !appraiser.is_settled(&leaf) {
            self.solved += 1;
            let before = appraiser.bytes(&leaf);
            match appraiser.settle(&mut leaf, cursor, tree, context) {
                Ok(factor) => self.factors.extend(factor.map(|factor| (appraiser.bound(&leaf), factor))),
                Err(problem) => {
                    self.unsolvable.push((leaf, problem));
                    return None;
                }
            }
            self.grown += appraiser.bytes(&leaf) as i64 - before as i64;
        }
        if matters(appraiser, &leaf, reach) {
            return Some(leaf);
        }
        self.beyond.push(leaf);
        None
    }
}

impl<A: Appraise> Engine<A> {
    /// Sweeps until the best maps are proved, and so little probability is left as was asked for.
    pub(crate) fn cyclic(&mut self, context: Context<'_>) -> StopReason {
        let travels = context.travels();
        let apart = if travels <= ONE_FRONT { travels + 1 } else { travels.div_ceil(FRONTS) };
        if let Some(reason) = self.stop(context) {
            return reason;
        }
        loop {
            let begin = || Cycle { from: self.sweep.from, step: 0, turned: false, idle: true };
            let mut cycle = self.sweep.cycle.unwrap_or_else(begin);
            self.sweep.from = 0;
            while cycle.step < apart {
                if !cycle.turned {
                    let turns = (cycle.step..travels).step_by(apart).filter(|&level| level >= cycle.from);
                    cycle.idle &= !self.take_turns(turns.collect(), context);
                    cycle.turned = true;
                }
                if cycle.step == travels % apart {
                    cycle.idle &= !self.take_whole(context);
                }
                if let Some(reason) = self.stop(context).or_else(|| self.is_out_of_patience()) {
                    self.sweep.cycle = Some(cycle);
                    return reason;
                }
                if self.is_rest_too_dear() {
                    self.sweep.cycle = Some(cycle);
                    return self.proved();
                }
                (cycle.step, cycle.turned) = (cycle.step + 1, false);
            }
            self.sweep.cycle = None;
            if cycle.idle && cycle.from == 0 && !self.widen() {
                return self.proved();
            }
        }
    }

    /// The best hypothesis of each of these levels is expanded; whether there was any.
    ///
    /// Once there is a map, whatever is within reach has to be expanded before the map is proved, in whatever order: then levels that
    /// have work take over the shares of those that have none.
    fn take_turns(&mut self, levels: Vec<usize>, context: Context<'_>) -> bool {
        if self.reach.is_some() && levels.len() > 1 {
            return self.take_shares(&levels, context);
        }
        while self.cursors.len() < levels.len() {
            self.cursors.push(Cursor::new(context.experience));
        }
        let (appraiser, tree, reach) = (&self.appraiser, &self.tree, self.reach);
        let chosen = levels.iter().scan(0, |from, &level| {
            let skip = level - std::mem::replace(from, level + 1);
            Some(skip)
        });
        let mut all = self.frontier.levels.iter_mut();
        let levels: Vec<_> = chosen.filter_map(|skip| all.nth(skip)).collect();
        let jobs: Vec<_> = levels.into_iter().zip(&mut self.cursors).collect();
        let turns = context
            .crew
            .each(jobs, |(level, cursor)| take_turn(appraiser, level, reach, cursor, tree, context));
        turns.into_iter().fold(false, |any, turn| self.end_turn(turn, context) | any)
    }

    /// The best hypotheses of these levels, as many as there are fronts, are expanded or set aside; whether there were any.
    fn take_shares(&mut self, levels: &[usize], context: Context<'_>) -> bool {
        let mut leaves = Vec::with_capacity(FRONTS);
        for _ in 0..FRONTS {
            let queues = &mut self.frontier.levels;
            leaves.extend(levels.iter().filter_map(|&level| queues[level].pop()).take(FRONTS - leaves.len()));
        }
        while self.cursors.len() < leaves.len() {
            self.cursors.push(Cursor::new(context.experience));
        }
        let any = !leaves.is_empty();
        let (appraiser, tree, reach) = (&self.appraiser, &self.tree, self.reach);
        let jobs: Vec<_> = leaves.into_iter().zip(&mut self.cursors).collect();
        let turns = context
            .crew
            .each(jobs, |(leaf, cursor)| take_share(appraiser, leaf, reach, cursor, tree, context));
        for turn in turns {
            self.end_turn(turn, context);
        }
        any
    }

    /// Enters what came of a level's turn; whether anything was expanded.
    fn end_turn(&mut self, turn: Turn<A>, context: Context<'_>) -> bool {
        let Turn { expanded, beyond, unsolvable, factors, solved, grown } = turn;
        self.solved += solved;
        self.bytes = self.bytes.saturating_add_signed(grown);
        self.factors.extend(factors);
        for (leaf, problem) in unsolvable {
            self.bytes -= self.appraiser.bytes(&leaf);
            self.unsolvable.get_or_insert((leaf.depth(), problem));
        }
        beyond.into_iter().for_each(|leaf| self.frontier.park(leaf));
        let Some((leaf, grown)) = expanded else { return false };
        self.bytes -= self.appraiser.bytes(&leaf);
        self.enter(&leaf, grown, context);
        true
    }

    /// All hypotheses within reach that explain everything are maps found, or turned down; whether there was any.
    fn take_whole(&mut self, context: Context<'_>) -> bool {
        let mut cursor = self.lend_cursor(context);
        let mut any = false;
        loop {
            let level = &mut self.frontier.levels[context.travels()];
            let mut turn = choose(&self.appraiser, level, self.reach, &mut cursor, &self.tree, context);
            let chosen = turn.1.take();
            self.end_turn(turn.0, context);
            let Some(leaf) = chosen else { break };
            self.bytes -= self.appraiser.bytes(&leaf);
            any = true;
            self.judge(leaf);
            if self.stop(context).is_some() {
                break;
            }
        }
        self.cursors.push(cursor);
        any
    }

    /// Nothing is left within reach: reaches farther if too much probability is left; whether it does.
    fn widen(&mut self) -> bool {
        let (Some(least), Some(reach)) = (self.open_bound(), self.reach) else { return false };
        if self.rest().is_none_or(|rest| rest <= self.proving.rest) {
            return false;
        }
        self.sweep.proved_after.get_or_insert(self.tally.expanded);
        if self.is_rest_too_dear() {
            return false;
        }
        self.sweep.slack += self.appraiser.distance(reach, least).max(0.0) + WIDENING;
        self.set_reach();
        let (appraiser, reach) = (&self.appraiser, self.reach);
        self.frontier.unpark(|leaf| matters(appraiser, leaf, reach));
        true
    }

    /// Whether what comes after the proof took as much work as the proof, and some more: the rest's probability is then told
    /// as it is.
    fn is_rest_too_dear(&self) -> bool {
        let expanded = self.tally.expanded;
        self.sweep
            .proved_after
            .is_some_and(|proved| expanded >= proved.saturating_mul(2).saturating_add(REST_WORK))
    }

    fn is_out_of_patience(&self) -> Option<StopReason> {
        let patience = self.proving.patience.filter(|_| !self.found.is_empty())?;
        let waited = self.tally.expanded - self.sweep.best_since;
        (waited >= patience).then_some(StopReason::Found)
    }
}

/// Expands the best hypothesis of a level.
fn take_turn<A: Appraise>(
    appraiser: &A,
    level: &mut Level<A>,
    reach: Option<A::Key>,
    cursor: &mut Cursor,
    tree: &Tree,
    context: Context<'_>,
) -> Turn<A> {
    let (mut turn, chosen) = choose(appraiser, level, reach, cursor, tree, context);
    turn.expanded = chosen.map(|leaf| {
        let grown = appraiser.grow(&leaf, cursor, tree, context);
        (leaf, grown)
    });
    turn
}

/// Expands a hypothesis, if something may come of it.
fn take_share<A: Appraise>(
    appraiser: &A,
    leaf: Leaf<A>,
    reach: Option<A::Key>,
    cursor: &mut Cursor,
    tree: &Tree,
    context: Context<'_>,
) -> Turn<A> {
    let mut turn = Turn::default();
    turn.expanded = turn.settled(appraiser, leaf, reach, cursor, tree, context).map(|leaf| {
        let grown = appraiser.grow(&leaf, cursor, tree, context);
        (leaf, grown)
    });
    turn
}

/// Takes the best hypothesis of a level that something may come of. It is settled.
fn choose<A: Appraise>(
    appraiser: &A,
    level: &mut Level<A>,
    reach: Option<A::Key>,
    cursor: &mut Cursor,
    tree: &Tree,
    context: Context<'_>,
) -> (Turn<A>, Option<Leaf<A>>) {
    let mut turn = Turn::default();
    while let Some(leaf) = level.pop() {
        let Some(leaf) = turn.settled(appraiser, leaf, reach, cursor, tree, context) else { continue };
        if level.peek().is_some_and(|other| *other < leaf) {
            level.push(leaf);
        } else {
            return (turn, Some(leaf));
        }
    }
    (turn, None)
}
