//! A search under way that keeps checkpoints.

use std::io;

use crate::checkpoint::{Keeping, Pen, write_state};
use crate::context::Context;
use crate::engine::Engine;
use crate::limits::StopReason;
use crate::pack::Pack;

/// Searches on, and keeps checkpoints on the way: what `head` writes, and the state of the search.
pub(crate) fn kept<A: Pack>(
    engine: &mut Engine<A>,
    context: Context<'_>,
    keeping: &mut Keeping,
    head: impl Fn(&mut Pen<'_>) -> io::Result<()>,
) -> StopReason {
    let limits = engine.limits(context.watch);
    let stop = loop {
        let watch = &limits.pausing(keeping.due);
        let stop = engine.advance(Context { watch, ..context });
        if !stop.is_complete() && engine.frontier.lost().is_none() {
            keeping.keep(|pen| {
                head(pen)?;
                write_state(engine, pen)
            });
        }
        if !watch.is_pause(stop) {
            break stop;
        }
    };
    engine.end(stop, context);
    stop
}
