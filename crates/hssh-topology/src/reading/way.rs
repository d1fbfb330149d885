//! Ways: what one travel may have been, if perception errs.

use serde::{Deserialize, Serialize};

use super::chart::{ChartEnd, Side};
use super::matching::Reading;
use crate::ids::Olp;

/// One way in which a travel follows from an [`Account`](super::Account).
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Way {
    /// The places passed without a report, in order.
    pub hops: Vec<Hop>,
    /// Where the robot then was.
    pub arrival: Arrival,
    /// What it costs, nats.
    pub price: f64,
}

/// A place that was passed without a report.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Hop {
    /// A place of the chart, from one of its ends to another. If the robot left by a pending end, that is linked to `enter`.
    Pass {
        /// The end that it came in by.
        enter: ChartEnd,
        /// The end that it left by.
        leave: ChartEnd,
    },
    /// A junction on the link that the robot left by: it went on by the stem.
    Branch {
        /// Where the stem is.
        side: Side,
    },
    /// A junction on a link, to whose stem the robot's pending end led: it went on along the link.
    Merge {
        /// The end that the link was made from.
        on: ChartEnd,
        /// Where the stem is, seen from there.
        side: Side,
        /// Whether the robot went back to that end.
        back: bool,
    },
}

/// Where a travel leads.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub enum Arrival {
    /// To the place that its link leads to.
    Predicted(Reading),
    /// To a place that was not known.
    NewPlace,
    /// From a pending end to another one.
    Closure(ChartEnd, Reading),
    /// From a pending end to an end that no visit has shown.
    NewEnd(Reading),
    /// To a place that was not known, on the way that was travelled before.
    Inserted {
        /// The end that faces where the way led.
        ahead: Olp,
    },
    /// From a pending end to a place that was not known, on another link.
    Crossing {
        /// The end that the link was made from.
        on: ChartEnd,
        /// The end that faces it.
        back: Olp,
        /// The end that faces the link's other end.
        ahead: Olp,
    },
    /// The robot turned on the way, and is where it was.
    TurnedBack(Reading),
    /// The report is of no place.
    False,
}

impl Arrival {
    /// The reading of the star, unless the place is new or none.
    #[must_use]
    pub fn reading(&self) -> Option<&Reading> {
        match self {
            Arrival::Predicted(reading)
            | Arrival::Closure(_, reading)
            | Arrival::NewEnd(reading)
            | Arrival::TurnedBack(reading) => Some(reading),
            Arrival::NewPlace | Arrival::Inserted { .. } | Arrival::Crossing { .. } | Arrival::False => None,
        }
    }
}

impl Way {
    /// Whether it follows without any error: as predicted, to a new place or by a closure, under an isomorphism.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        let is_exact = match &self.arrival {
            Arrival::Predicted(reading) | Arrival::Closure(_, reading) => reading.is_isomorphism(),
            Arrival::NewPlace => true,
            _ => false,
        };
        self.hops.is_empty() && is_exact
    }
}
