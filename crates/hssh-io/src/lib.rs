//! Recordings of robots, read as laser logs: ROS 2 bags (MCAP, SQLite, folders), ROS 1 bags, and tables.
//!
//! What is made of a recording is a [`LaserLog`](hssh_local::LaserLog): the scans of one laser with the geometry that they
//! tell, in order of time, and raw odometry between them. Units are metres, radians and seconds.

#[cfg(feature = "bags")]
mod bag;
#[cfg(feature = "bags")]
mod choice;
#[cfg(feature = "bags")]
mod clock;
#[cfg(feature = "bags")]
mod error;
#[cfg(feature = "bags")]
mod frames;
#[cfg(feature = "bags")]
mod gather;
#[cfg(feature = "bags")]
mod inventory;
#[cfg(feature = "bags")]
mod message;
#[cfg(feature = "bags")]
mod recording;
#[cfg(feature = "bags")]
mod sweep;
mod table;
#[cfg(feature = "bags")]
mod wire;

#[cfg(feature = "bags")]
pub use bag::{BagError, with_file};
#[cfg(feature = "bags")]
pub use choice::RecordingOptions;
#[cfg(feature = "bags")]
pub use error::RecordingError;
#[cfg(feature = "bags")]
pub use inventory::{BagAccount, FrameAccount, TopicAccount, bag_account};
#[cfg(feature = "bags")]
pub use recording::{ReadRecording, read_bag};
pub use table::{TableError, TableOptions, is_table, read_table};

/// Whether a file holds a bag that zstd compressed as a whole.
#[cfg(feature = "bags")]
#[must_use]
pub fn is_packed_bag(file: &std::path::Path) -> bool {
    bag::holds_bag(file)
}
