//! An independent check of maps against explorations (section 2.3.1) and axioms.
//!
//! Nothing here shares code with the recursive step or with what maps carry along as they grow: maps
//! are plain data, and paths, sides, faces and genus are traced from scratch whenever they are asked
//! for. Simple and slow.

mod follow;
mod sketch;
mod trace;
mod violation;

pub use follow::{Contradiction, Discovery, Replay, ReplayedTravel, replay};
pub use sketch::{End, Malformed, MapSketch};
pub use violation::{TracedPath, Violation, violations};
