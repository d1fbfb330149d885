//! Control and causal input: explorations as plain data, and the RON text they are written in.

mod exploration;

pub use exploration::{Exploration, NamedStar, Odometry, StarType, Travel};
