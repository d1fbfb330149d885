//! The control level: trajectory-following and hill-climbing control laws, which take a robot from one
//! distinctive state to the next (section 2.1.1).
//!
//! A [`ControlLaw`] is data: what it does, where it applies and where it ends are functions of what the
//! robot perceives around itself, a [`Percept`], and of nothing else. A [`travel`] is the sequence of laws
//! that the causal level abstracts to one action: leave the place by a gateway, follow the midline of the
//! corridor, center in the next place. Where hill-climbing ends is a distinctive state.
//!
//! ```
//! use hssh_causal::control::{ControlLaw, Handling, Percept};
//!
//! // In a corridor 2 m wide, 0.3 m left of its midline, looking along it.
//! let ranges = (0..360).map(|degree: i32| {
//!     let sin = f64::from(degree).to_radians().sin();
//!     if sin > 0.0 { 0.7 / sin } else { 1.3 / sin.abs() }
//! });
//! let percept = Percept { ranges: ranges.collect(), neighborhood: None };
//! let law = ControlLaw::FollowMidline { width: 2.0 };
//! assert!(law.is_applicable(&percept) && !law.is_finished(&percept, &Handling::default()));
//! let command = law.command(&percept, &Handling::default());
//! assert!(command.speed > 0.0 && command.turn < 0.0, "it goes on and turns to the right");
//! ```

mod action;
mod command;
mod handling;
mod hill_climbing;
mod law;
mod percept;
#[cfg(test)]
mod tests;
mod trajectory;
mod view;

pub use action::{Action, approach, travel};
pub use command::Command;
pub use handling::Handling;
pub use law::ControlLaw;
pub use percept::{Exit, Percept, Vicinity};
