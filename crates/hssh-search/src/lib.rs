//! The tree of all maps that explain an exploration, and the searches through it.
//!
//! [`Mapper`] takes one visit at a time and can be asked for its maps at any time. What makes a map better than another
//! is its [`Objective`]: the order of preference, or posterior probability (chapter 4). In which [`Order`] the tree is
//! searched is another choice: breadth-first, best-first, cyclic best-first, or by a bound; the last two prove that nothing better
//! exists. [`MapperBuilder::count`] goes through the same tree depth-first in constant memory. All of them share their
//! frontier among any number of threads with the same result in the same order.
//!
//! One step, one engine: [`Hypothesis::step`](hssh_topology::Hypothesis::step) says in which ways a travel follows, an objective
//! appraises them, and an order takes the next one from the frontier.
//!
//! ```
//! use hssh_search::{Mapper, Order};
//! use hssh_world::{grid, snake};
//!
//! // A robot that goes through 3 × 3 crossings row by row, and proves which map is the simplest.
//! let world = grid(3, 3, 8.0)?;
//! let exploration = world.explore(&world.route_through(&snake(3, 3))?)?;
//! let mapper = Mapper::builder().order(Order::Cyclic).explain(&exploration)?;
//! assert!(mapper.report().is_optimal);
//! assert_eq!(mapper.maps(1)[0].measure.genus, 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod branch;
mod branching;
mod builder;
mod certificate;
mod checkpoint;
mod constraints;
mod context;
mod count;
mod crew;
mod cursor;
mod depth_first;
mod distinction;
mod elsewhere;
mod engine;
mod expander;
mod experience;
mod fingerprint;
mod frames;
mod fringe;
mod frontier;
mod helpers;
mod kept;
mod leaf;
mod legs;
mod limits;
mod mapper;
mod measured;
mod order;
mod pack;
mod paths;
mod placement;
mod posterior;
mod preference;
mod reading;
mod report;
mod step;
mod steps;
mod strategy;
mod tally;
mod tree;
mod turns;
mod visit;
mod visited;

pub use branch::Branch;
pub use branching::{BranchingSample, branching};
pub use builder::{MapperBuilder, MapperError, Objective};
pub use checkpoint::{CheckpointError, Checkpoints, Keeper, Source};
pub use constraints::{ConstraintError, VisitConstraints, VisitPair};
pub use count::{BranchCounter, CountedBranch, SharedCount};
pub use crew::{ThreadsError, useful_threads};
pub use cursor::Cursor;
pub use depth_first::{Visitor, depth_first};
pub use distinction::{Distinction, Parting, Prediction, Test, distinguish};
pub use elsewhere::Store;
pub use expander::Expander;
pub use experience::Experience;
pub use helpers::Helpers;
pub use limits::{Limits, Monitor, StopReason};
pub use mapper::Mapper;
pub use order::{Goal, Order, Proving};
pub use placement::{Placement, PlacementError, place_by_odometry};
pub use posterior::{
    Appearance, Corridor, Cost, Horizon, LINEAR_TRUST, MapPrior, Metrical, ModelError, PlacePrior,
    PosteriorModel,
};
pub use reading::{Corrected, Correction, Passage, ReadAnswer, ReadMap, Reader};
pub use report::{FinalCounts, LevelCounts, Levels, Probable, Proof, RankedMap, Report, Score};
pub use tree::{NodeId, Tree};
pub use visit::{MeasurementError, Visit, VisitError};
