//! Best-first with proof: in the order of an admissible bound, until no open hypothesis can lead to a
//! map as good as the best ones found.

use crate::context::Context;
use crate::engine::Engine;
use crate::leaf::Leaf;
use crate::limits::StopReason;
use crate::pack::Pack;
use crate::turns::{End, Taken, Turn, take_all};

/// Hypotheses of equal key that are expanded together.
const ROUND: usize = 2048;

/// Hypotheses that one thread takes at a time.
const PIECE: usize = 64;

impl<A: Pack> Engine<A> {
    /// Expands the open hypotheses with the least bound until the answer is proved.
    pub(crate) fn least_bound_first(&mut self, context: Context<'_>) -> StopReason {
        let mut cursor = self.lend_cursor(context);
        let stop = loop {
            if let Some(reason) = self.stop(context) {
                break reason;
            }
            // All of one key have their turn before the proof is done, so that none is expanded in vain.
            let mut turns = self.frontier.pop_equals(ROUND);
            let Some(first) = turns.first() else { break self.proved() };
            if !self.matters(first) {
                turns.into_iter().for_each(|leaf| self.frontier.push(leaf));
                break self.proved();
            }
            turns.sort_unstable_by_key(|leaf| leaf.node);
            let mut settled = Vec::with_capacity(turns.len());
            for mut leaf in turns {
                self.bytes -= self.appraiser.bytes(&leaf);
                if self.appraiser.is_settled(&leaf) {
                    settled.push(leaf);
                } else if self.settle(&mut leaf, &mut cursor, context) {
                    self.push(leaf); // its turn may be later now
                }
            }
            let (whole, open): (Vec<_>, Vec<_>) =
                settled.into_iter().partition(|leaf| leaf.depth() == context.travels());
            whole.into_iter().for_each(|leaf| self.judge(leaf));
            self.expand(open, context);
        };
        self.cursors.push(cursor);
        stop
    }

    /// Expands hypotheses together; what explains everything arrives at once.
    fn expand(&mut self, leaves: Vec<Leaf<A>>, context: Context<'_>) {
        let turn = |leaf| Turn { leaf, reach: None, next: None, front: 0 };
        let turns: Vec<Turn<A>> = leaves.into_iter().map(turn).collect();
        let (appraiser, tree) = (&self.appraiser, &self.tree);
        let taken = take_all(&turns, tree, context, |turns| {
            let pieces: Vec<&[Turn<A>]> = turns.chunks(PIECE).collect();
            let taken = context.crew.map(&pieces, context.experience, |cursor, piece| {
                piece.iter().map(|turn| turn.take(appraiser, cursor, tree, context)).collect::<Vec<_>>()
            });
            taken.into_iter().flatten().collect()
        });
        for Taken { leaf, end, .. } in taken {
            if let End::Grown(grown) = end {
                self.enter(&leaf, grown, context);
            }
        }
    }
}
