//! Actions: the sequences of control laws that lead from one distinctive state to another (section 2.1.2).

use super::{ControlLaw, Vicinity};

/// Control laws, each applied until it ends.
pub type Action = Vec<ControlLaw>;

/// The travel that leaves a neighborhood by one of its gateways; `None` if it has no such gateway. The turn
/// toward the gateway is part of leaving.
#[must_use]
pub fn travel(from: &Vicinity, gateway: usize) -> Option<Action> {
    let width = from.gateways.get(gateway)?.width;
    let leave = ControlLaw::Leave { neighborhood: from.number, gateway };
    Some(vec![leave, ControlLaw::FollowMidline { width }, ControlLaw::HillClimb])
}

/// The action that leads from somewhere in a corridor `width` metres wide to the place ahead.
#[must_use]
pub fn approach(width: f64) -> Action {
    vec![ControlLaw::FollowMidline { width }, ControlLaw::HillClimb]
}
