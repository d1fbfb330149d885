//! The tree of all maps that explain an exploration, and the searches through it.
//!
//! [`Mapper`] takes one observation at a time and can be asked for its maps at any time. It searches
//! breadth-first, best-first, or best-first with a proof that nothing better exists;
//! [`MapperBuilder::count`] goes through the same tree depth-first in constant memory. All of them expand their frontier on any
//! number of threads with the same result in the same order.
//!
//! [`PosteriorSearch`] takes a whole exploration with odometry, and finds its most probable maps with a proof (chapter 4).

mod best_first;
mod branching;
mod breadth_first;
mod context;
mod count;
mod crew;
mod depth_first;
mod distinction;
mod experience;
mod frames;
mod frontier;
mod limits;
mod mapper;
mod measured;
mod placement;
mod posterior;
mod proof;
mod report;
mod tree;

pub use branching::{BranchingSample, branching};
pub use depth_first::{Visitor, depth_first};
pub use distinction::{Distinction, Parting, Prediction, Test, distinguish};
pub use experience::Experience;
pub use limits::{Limits, Monitor, StopReason};
pub use mapper::{Goal, Mapper, MapperBuilder, ObservationError, RankedMap, Strategy, ThreadsError};
pub use measured::MeasurementError;
pub use placement::{Placement, PlacementError, place_by_odometry};
pub use posterior::{
    Appearance, Corridor, Cost, LINEAR_TRUST, MapPrior, Metrical, ModelError, PlacePrior, Posterior,
    PosteriorError, PosteriorModel, PosteriorOrder, PosteriorReport, PosteriorSearch, ProbableMap, Proving,
};
pub use proof::Certificate;
pub use report::{FinalCounts, LevelCounts, Levels, Report};
pub use tree::{Cursor, Derived, NodeId, Outcome, Tree};
