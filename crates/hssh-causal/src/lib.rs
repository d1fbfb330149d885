//! Control and causal input: explorations as plain data, and the RON text they are written in.

mod exploration;

pub use exploration::{
    Exploration, ExplorationError, NamedStar, Odometry, OdometryError, StarType, Travel, TravelError,
};
