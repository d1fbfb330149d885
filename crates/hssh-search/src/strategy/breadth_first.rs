//! Breadth-first: the complete fringe after every observation, as in the thesis (section 2.3.1).

use std::time::Duration;

use crate::context::Context;
use crate::cursor::Cursor;
use crate::engine::{Engine, GrowingLevel};
use crate::leaf::Leaf;
use crate::limits::{StopReason, Watch};
use crate::pack::Pack;
use crate::turns::{End, Taken, Turn, take_all};

/// Hypotheses between two looks at the limits.
const LOOK: usize = 256;

/// This part of a limit on time is for looking through what was found…
const FOR_LOOKING: u32 = 4;
/// …and so much time is after an interruption.
const PATIENCE: Duration = Duration::from_millis(300);

/// How much of the time of a search is for looking through what was found.
pub(crate) fn time_for_looking(watch: &Watch) -> Duration {
    watch.time().map_or(PATIENCE, |time| time / FOR_LOOKING)
}

impl<A: Pack> Engine<A> {
    /// Grows the tree level by level to the last travel. A limit leaves a level incomplete, with which the next call goes on.
    pub(crate) fn breadth_first(&mut self, context: Context<'_>) -> StopReason {
        while self.fringe.depth < context.travels() {
            let grown = if A::WEIGHS {
                self.grow_appraised(context)
            } else {
                self.fringe.grow(&mut self.tree, context, &mut self.tally)
            };
            tracing::debug!(explained = self.fringe.depth, fringe = self.fringe.nodes.len(), "level");
            if let Err(reason) = grown {
                return reason;
            }
        }
        if A::WEIGHS {
            self.find_fringe(context);
        }
        StopReason::Exhausted
    }

    /// The end of a search, for now: gives up a level that is not complete, and chooses one that there is time to look through.
    pub(crate) fn show_level(&mut self, stop: StopReason, context: Context<'_>) {
        self.fringe.give_up(&mut self.tree, context);
        self.give_up_appraised(context);
        let is_pressed = matches!(stop, StopReason::TimeLimit | StopReason::Interrupted) && !A::WEIGHS;
        let patience =
            if stop == StopReason::Interrupted { PATIENCE } else { time_for_looking(context.watch) };
        self.shown =
            is_pressed.then(|| self.fringe.showable(&self.tree, context, &self.tally.levels, patience));
    }

    /// Grows the tree by one level whose hypotheses are all appraised.
    fn grow_appraised(&mut self, context: Context<'_>) -> Result<(), StopReason> {
        let depth = self.fringe.depth;
        let mut growing = self.growing.take().unwrap_or_else(|| {
            let mut leaves: Vec<Leaf<A>> = std::iter::from_fn(|| self.frontier.pop(depth)).collect();
            leaves.sort_unstable_by_key(|leaf| leaf.node);
            let (nodes, maps, tally) = (self.tree.len(), self.tree.map_count(), self.tally.clone());
            GrowingLevel { nodes, maps, tally, leaves, next: 0 }
        });
        while growing.next < growing.leaves.len() {
            if let Some(reason) = self.stop(context) {
                self.growing = Some(growing);
                return Err(reason);
            }
            let (appraiser, tree) = (&self.appraiser, &self.tree);
            let together = growing.leaves[growing.next..].iter().take(LOOK);
            let turn = |leaf: &Leaf<A>| Turn { leaf: leaf.clone(), reach: None, next: None, front: 0 };
            let turns: Vec<Turn<A>> = together.map(turn).collect();
            let taken = take_all(&turns, tree, context, |turns| {
                let take = |cursor: &mut Cursor, turn: &Turn<A>| turn.take(appraiser, cursor, tree, context);
                context.crew.map(turns, context.experience, take)
            });
            for Taken { leaf, solved, end, .. } in taken {
                self.solved += u64::from(solved);
                let grown = match end {
                    End::Grown(grown) => grown,
                    End::Unsolvable(problem) => Err(problem),
                    End::Beyond | End::Overtaken | End::Settled => continue,
                };
                self.plant(&leaf, grown, context).into_iter().for_each(|leaf| self.push(leaf));
            }
            growing.next += turns.len();
        }
        self.bytes -= growing.leaves.iter().map(|leaf| self.appraiser.bytes(leaf)).sum::<u64>();
        self.tally.make_level(depth + 1);
        self.fringe.advance(&self.tree, growing.nodes, context);
        Ok(())
    }

    /// Forgets the level that is being grown, if there is one.
    fn give_up_appraised(&mut self, context: Context<'_>) {
        let Some(GrowingLevel { nodes, maps, tally, leaves, .. }) = self.growing.take() else { return };
        let given_up = self.frontier.empty(self.fringe.depth + 1);
        self.bytes -= given_up.iter().map(|leaf| self.appraiser.bytes(leaf)).sum::<u64>();
        self.fringe.forget(&mut self.tree, nodes, maps, context);
        self.tally = tally;
        leaves.into_iter().for_each(|leaf| self.frontier.push(leaf));
    }

    /// All hypotheses of the complete fringe are maps that were found.
    fn find_fringe(&mut self, context: Context<'_>) {
        let mut cursor = self.lend_cursor(context);
        while let Some(mut leaf) = self.frontier.pop(context.travels()) {
            self.bytes -= self.appraiser.bytes(&leaf);
            if self.appraiser.is_settled(&leaf) || self.settle(&mut leaf, &mut cursor, context) {
                self.arrive(leaf);
            }
        }
        self.cursors.push(cursor);
    }
}
