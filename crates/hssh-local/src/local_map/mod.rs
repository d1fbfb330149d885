//! The local perceptual map: a bounded occupancy grid that scrolls with the robot (section 2.2.1).

mod evidence;
mod options;

pub use evidence::LocalMap;
pub use options::LocalMapOptions;
