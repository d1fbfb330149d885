//! Control laws: what they do, where they apply and where they end (section 2.1.1).

use super::hill_climbing::{climb, summit};
use super::trajectory::{follow_midline, is_blocked, leave};
use super::{Command, Exit, Handling, Percept};

/// A control law.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ControlLaw {
    /// Trajectory-following: out of a place-neighborhood by one of its gateways.
    Leave {
        /// Which neighborhood, by its number.
        neighborhood: u32,
        /// Which of its gateways.
        gateway: usize,
    },
    /// Trajectory-following: along the midline of a corridor to the next place-neighborhood.
    FollowMidline {
        /// How wide the corridor is about, in metres: openings beside it do not attract the robot.
        width: f64,
    },
    /// Hill-climbing: to the point of a place-neighborhood that is farthest from all obstacles. Where it
    /// ends is a distinctive state.
    HillClimb,
}

impl ControlLaw {
    /// Whether the law applies where the robot perceives this: in a neighborhood with the gateway, between
    /// two sides, in a neighborhood.
    #[must_use]
    pub fn is_applicable(&self, percept: &Percept) -> bool {
        match *self {
            ControlLaw::Leave { neighborhood, gateway } => exit(percept, neighborhood, gateway).is_some(),
            ControlLaw::FollowMidline { .. } => percept.left().is_finite() && percept.right().is_finite(),
            ControlLaw::HillClimb => percept.neighborhood.is_some(),
        }
    }

    /// Whether the law ends here: outside of the neighborhood; in a neighborhood, or before something that
    /// is in the way; where no position is better.
    #[must_use]
    pub fn is_finished(&self, percept: &Percept, handling: &Handling) -> bool {
        match *self {
            ControlLaw::Leave { neighborhood, gateway } => exit(percept, neighborhood, gateway).is_none(),
            ControlLaw::FollowMidline { .. } => {
                percept.neighborhood.is_some() || is_blocked(percept, handling)
            }
            ControlLaw::HillClimb => {
                let [x, y] = summit(percept, handling);
                x.hypot(y) <= handling.centered
            }
        }
    }

    /// What to do where the robot perceives this; to rest where the law does not apply.
    #[must_use]
    pub fn command(&self, percept: &Percept, handling: &Handling) -> Command {
        match *self {
            ControlLaw::Leave { neighborhood, gateway } => exit(percept, neighborhood, gateway)
                .map_or(Command::REST, |gateway| leave(percept, gateway, handling)),
            ControlLaw::FollowMidline { width } => follow_midline(percept, width, handling),
            ControlLaw::HillClimb => climb(percept, handling),
        }
    }
}

fn exit(percept: &Percept, neighborhood: u32, gateway: usize) -> Option<&Exit> {
    let here = percept.neighborhood.as_ref().filter(|here| here.number == neighborhood)?;
    here.gateways.get(gateway)
}
