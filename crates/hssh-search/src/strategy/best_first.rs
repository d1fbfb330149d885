//! Best-first, as in the thesis (section 2.3.1): only the successors of the best hypothesis
//! among those that exist are made.
//!
//! Which one that is depends on the expansion before, so that more threads have nothing to do.

use crate::context::Context;
use crate::engine::Engine;
use crate::limits::StopReason;
use crate::pack::Pack;

/// Expansions between two looks at the limits.
const LOOK: u64 = 128;

impl<A: Pack> Engine<A> {
    /// Expands the best open hypothesis until the best one explains everything and, if asked for, is
    /// closed.
    pub(crate) fn best_first(&mut self, context: Context<'_>) -> StopReason {
        if !self.found.is_empty() {
            return StopReason::Found;
        }
        let mut cursor = self.lend_cursor(context);
        let mut stop = StopReason::Exhausted;
        for turn in 0_u64.. {
            let look = turn.is_multiple_of(LOOK);
            if let Some(reason) = look.then(|| self.stop(context)).flatten() {
                stop = reason;
                break;
            }
            let Some(depth) = self.frontier.next_level() else { break };
            let Some(mut leaf) = self.frontier.pop(depth) else { break };
            self.bytes -= self.appraiser.bytes(&leaf);
            if !self.appraiser.is_settled(&leaf) {
                if self.settle(&mut leaf, &mut cursor, context) {
                    self.push(leaf); // its turn may be later now
                }
            } else if depth < context.travels() {
                let grown = self.appraiser.grow(&leaf, &mut cursor, &self.tree, context);
                self.enter(&leaf, grown, context);
            } else if self.goal.accepts(leaf.is_closed()) {
                self.arrive(leaf);
                stop = StopReason::Found;
                break;
            } else {
                self.reject(leaf);
            }
        }
        self.cursors.push(cursor);
        stop
    }
}
