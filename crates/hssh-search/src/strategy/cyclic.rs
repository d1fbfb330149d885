//! Cyclic best-first: the best hypothesis of every number of travels explained, in turn, until the answer is proved.
//!
//! Comparing only hypotheses that explain equally much is fair whatever a travel costs, so that a complete map is found
//! soon; and none is dropped, so that the search can come back. A long exploration is swept by several fronts at
//! once, a fixed number of levels apart: what one front does no other sees before the step is over, so that threads can
//! share the step, and the result does not depend on how many they are. Once there is a map, the proof asks for all that is
//! within reach, and fronts with nothing to do help the others.

use crate::context::Context;
use crate::cursor::Cursor;
use crate::engine::{Cycle, Engine};
use crate::leaf::matters;
use crate::limits::StopReason;
use crate::pack::Pack;
use crate::tree::Tree;
use crate::turns::{End, Taken, Turn, take_all};

/// Up to so many travels there is one front.
const ONE_FRONT: usize = 32;

/// How many fronts there are for more.
const FRONTS: usize = 8;

/// By how many nats the reach of a search grows as long as too much probability is left.
const WIDENING: f64 = 1.0;

/// For the probability of the rest a search expands so many hypotheses more than it did for the proof.
const REST_WORK: u64 = 6_000;

impl<A: Pack> Engine<A> {
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
        let mut ended: Vec<Vec<Taken<A>>> = levels.iter().map(|_| Vec::new()).collect();
        let mut open: Vec<usize> = (0..levels.len()).collect();
        while !open.is_empty() {
            let turn = |front| self.next_turn(levels[front], front);
            let turns: Vec<Turn<A>> = open.drain(..).filter_map(turn).collect();
            let taken = self.take_by_fronts(&turns, context);
            for (&Turn { front, .. }, taken) in turns.iter().zip(taken) {
                if !matches!(taken.end, End::Grown(_)) {
                    open.push(front);
                }
                match taken.end {
                    End::Overtaken => {
                        let leaf = taken.leaf.clone();
                        self.end_turn(taken, context);
                        self.frontier.push(leaf);
                    }
                    _ => ended[front].push(taken),
                }
            }
        }
        ended.into_iter().flatten().fold(false, |any, taken| self.end_turn(taken, context) | any)
    }

    /// The best hypothesis of a level, if there is one.
    fn next_turn(&mut self, level: usize, front: usize) -> Option<Turn<A>> {
        let leaf = self.frontier.pop(level)?;
        let next = self.frontier.first(level);
        Some(Turn { leaf, reach: self.reach, next, front })
    }

    /// The best hypotheses of these levels, as many as there are fronts, are expanded or set aside; whether there were any.
    fn take_shares(&mut self, levels: &[usize], context: Context<'_>) -> bool {
        let mut leaves = Vec::with_capacity(FRONTS);
        for _ in 0..FRONTS {
            let next = levels.iter().filter_map(|&level| self.frontier.pop(level));
            leaves.extend(next.take(FRONTS - leaves.len()));
        }
        let any = !leaves.is_empty();
        let reach = self.reach;
        let turn = |(front, leaf)| Turn { leaf, reach, next: None, front };
        let turns: Vec<Turn<A>> = leaves.into_iter().enumerate().map(turn).collect();
        for taken in self.take_by_fronts(&turns, context) {
            self.end_turn(taken, context);
        }
        any
    }

    /// Takes turns of several fronts in their order, each by the cursor of its front.
    fn take_by_fronts(&mut self, turns: &[Turn<A>], context: Context<'_>) -> Vec<Taken<A>> {
        let fronts = turns.last().map_or(0, |turn| turn.front + 1);
        while self.cursors.len() < fronts {
            self.cursors.push(Cursor::new(context.experience));
        }
        let Engine { appraiser, tree, cursors, .. } = self;
        let (appraiser, tree): (&A, &Tree) = (appraiser, tree);
        take_all(turns, tree, context, |turns| {
            let mut all = cursors.iter_mut().enumerate();
            let mut cursor_of = |front| all.find(|(number, _)| *number == front).map(|(_, cursor)| cursor);
            let jobs: Vec<_> = turns.iter().filter_map(|turn| Some((turn, cursor_of(turn.front)?))).collect();
            context.crew.each(jobs, |(turn, cursor)| turn.take(appraiser, cursor, tree, context))
        })
    }

    /// Enters what came of a turn; whether anything was expanded.
    fn end_turn(&mut self, taken: Taken<A>, context: Context<'_>) -> bool {
        let Taken { leaf, bytes, solved, factor, end } = taken;
        self.solved += u64::from(solved);
        self.factors.extend(factor.map(|factor| (self.appraiser.bound(&leaf), factor)));
        let now = self.appraiser.bytes(&leaf);
        match end {
            End::Unsolvable(problem) => {
                self.bytes -= bytes;
                self.unsolvable.get_or_insert((leaf.depth(), problem));
            }
            End::Beyond => {
                self.bytes = self.bytes - bytes + now;
                self.frontier.park(leaf);
            }
            End::Overtaken | End::Settled => self.bytes = self.bytes - bytes + now,
            End::Grown(grown) => {
                self.bytes -= bytes;
                self.enter(&leaf, grown, context);
                return true;
            }
        }
        false
    }

    /// All hypotheses within reach that explain everything are maps found, or turned down; whether there was any.
    fn take_whole(&mut self, context: Context<'_>) -> bool {
        let mut cursor = self.lend_cursor(context);
        let mut any = false;
        while let Some(turn) = self.next_turn(context.travels(), 0) {
            let taken = turn.settle(&self.appraiser, &mut cursor, &self.tree, context);
            let (leaf, is_overtaken) = (taken.leaf.clone(), matches!(taken.end, End::Overtaken));
            let is_settled = matches!(taken.end, End::Settled);
            self.end_turn(taken, context);
            if is_overtaken {
                self.frontier.push(leaf);
            } else if is_settled {
                self.bytes -= self.appraiser.bytes(&leaf);
                any = true;
                self.judge(leaf);
                if self.stop(context).is_some() {
                    break;
                }
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

    /// Whether more hypotheses are open than the rest's probability is worth.
    pub(crate) fn is_much_open(&self) -> bool {
        self.frontier.len() > self.tally.expanded.saturating_mul(2).saturating_add(REST_WORK)
    }

    fn is_out_of_patience(&self) -> Option<StopReason> {
        let patience = self.proving.patience.filter(|_| !self.found.is_empty())?;
        let waited = self.tally.expanded - self.sweep.best_since;
        (waited >= patience).then_some(StopReason::Found)
    }
}
