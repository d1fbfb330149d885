//! Closing loops: where the robot was before, found by matching what it saw along stretches of its way, and the
//! trajectory that all of this and its tracked motion agree with best (section 2.1.4).

mod chain;
mod close;
mod field;
mod keyframe;
mod matching;
mod options;
mod refine;
mod scans;
mod search;
mod submap;
mod ways;

pub use close::{Alike, ClosedTrack, ClosingError, Closure, close_loops};
pub use options::ClosingOptions;
pub(crate) use ways::{Known, Ways};
