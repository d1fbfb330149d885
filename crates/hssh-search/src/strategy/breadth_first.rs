//! Breadth-first: the complete fringe after every observation, as in the thesis (section 2.3.1).

use std::time::Duration;

use crate::context::Context;
use crate::engine::Engine;
use crate::leaf::{Appraise, Growth, Leaf};
use crate::limits::StopReason;

/// Hypotheses between two looks at the limits.
const LOOK: usize = 256;

/// This part of a limit on time is for looking through what was found…
const FOR_LOOKING: u32 = 4;
/// …and so much time is after an interruption.
const PATIENCE: Duration = Duration::from_millis(300);

impl<A: Appraise> Engine<A> {
    /// Grows the tree level by level to the last travel.
    pub(crate) fn breadth_first(&mut self, context: Context<'_>) -> StopReason {
        let reserve = context.watch.time().map_or(PATIENCE, |time| time / FOR_LOOKING);
        let watch = context.watch.sooner(reserve);
        let stop = self.grow_levels(Context { watch: &watch, ..context });
        let is_pressed = matches!(stop, StopReason::TimeLimit | StopReason::Interrupted) && !A::WEIGHS;
        let patience = if stop == StopReason::Interrupted { PATIENCE } else { reserve };
        self.shown =
            is_pressed.then(|| self.fringe.showable(&self.tree, context, &self.tally.levels, patience));
        stop
    }

    fn grow_levels(&mut self, context: Context<'_>) -> StopReason {
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

    /// Grows the tree by one level whose hypotheses are all appraised. A limit leaves the tree as it was.
    fn grow_appraised(&mut self, context: Context<'_>) -> Result<(), StopReason> {
        let (nodes, maps) = (self.tree.len(), self.tree.map_count());
        let depth = self.fringe.depth;
        let tally = self.tally.clone();
        let mut leaves: Vec<Leaf<A>> = std::iter::from_fn(|| self.frontier.levels[depth].pop()).collect();
        leaves.sort_unstable_by_key(|leaf| leaf.node);
        let mut stop = None;
        let mut level = Vec::new();
        for together in leaves.chunks(LOOK) {
            stop = stop.or_else(|| self.stop(context));
            if stop.is_some() {
                break;
            }
            let (appraiser, tree) = (&self.appraiser, &self.tree);
            let grown = context.crew.map(together, context.experience, |cursor, leaf| -> Growth<A> {
                let mut leaf = leaf.clone();
                appraiser.settle(&mut leaf, cursor, tree, context)?;
                appraiser.grow(&leaf, cursor, tree, context)
            });
            for (leaf, grown) in together.iter().zip(grown) {
                self.solved += u64::from(!self.appraiser.is_settled(leaf));
                level.extend(self.plant(leaf, grown, context));
            }
        }
        if let Some(reason) = stop {
            self.fringe.give_up(&mut self.tree, nodes, maps);
            self.tally = tally;
            context.crew.recall();
            leaves.into_iter().for_each(|leaf| self.frontier.push(leaf));
            return Err(reason);
        }
        self.bytes -= leaves.iter().map(|leaf| self.appraiser.bytes(leaf)).sum::<u64>();
        level.into_iter().for_each(|leaf| self.push(leaf));
        self.tally.make_level(depth + 1);
        self.fringe.advance(&self.tree, nodes, context);
        Ok(())
    }

    /// All hypotheses of the complete fringe are maps that were found.
    fn find_fringe(&mut self, context: Context<'_>) {
        let mut cursor = self.lend_cursor(context);
        while let Some(mut leaf) = self.frontier.levels[context.travels()].pop() {
            self.bytes -= self.appraiser.bytes(&leaf);
            if self.appraiser.is_settled(&leaf) || self.settle(&mut leaf, &mut cursor, context) {
                self.arrive(leaf);
            }
        }
        self.cursors.push(cursor);
    }
}
