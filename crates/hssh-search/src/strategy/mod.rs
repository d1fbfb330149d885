//! The searches: one file for each order in which hypotheses are expanded.

mod best_first;
mod breadth_first;
mod cyclic;
mod proof;

use crate::context::Context;
use crate::engine::Engine;
use crate::limits::{StopReason, Watch};
use crate::order::Order;
use crate::pack::Pack;

impl<A: Pack> Engine<A> {
    /// Searches on until everything observed is explained as well as was asked for, or a limit stops it.
    pub(crate) fn advance(&mut self, context: Context<'_>) -> StopReason {
        match self.order {
            Order::BreadthFirst => self.breadth_first(context),
            Order::BestFirst => self.best_first(context),
            Order::Cyclic => self.cyclic(context),
            Order::Proof => self.least_bound_first(context),
        }
    }

    /// The limits of the search for maps, which leave time to look through them.
    pub(crate) fn limits(&self, watch: &Watch) -> Watch {
        match self.order {
            Order::BreadthFirst => watch.sooner(breadth_first::time_for_looking(watch)),
            _ => watch.clone(),
        }
    }

    /// The end of a search, for now.
    pub(crate) fn end(&mut self, stop: StopReason, context: Context<'_>) {
        if self.order == Order::BreadthFirst {
            self.show_level(stop, context);
        }
    }
}
