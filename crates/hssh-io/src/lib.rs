//! Recordings of robots, read as laser logs: ROS 2 bags (MCAP, SQLite, folders), ROS 1 bags, and tables.
//!
//! What is made of a recording is a [`LaserLog`](hssh_local::LaserLog): the scans of one laser with the geometry that they
//! tell, in order of time, and raw odometry between them. Units are metres, radians and seconds.
//!
//! ```
//! use hssh_io::{KnownLaser, read_table};
//!
//! let table = "time,x,y,theta,ranges\n0.0,0.0,0.0,0.0,1.2,1.3,4.0\n0.5,0.2,0.0,0.0,1.2,inf,3.8\n";
//! let log = read_table(table.as_bytes(), &KnownLaser::default())?;
//! assert_eq!((log.scans.len(), log.beams()), (2, 3));
//! assert_eq!(log.scans[1].scan.hits(50.0).count(), 2); // nothing came back along one beam
//! # Ok::<(), hssh_io::TableError>(())
//! ```

mod json_lines;
mod laser;
#[cfg(feature = "bags")]
mod ros;
mod table;

pub use json_lines::{JsonLines, JsonLinesError, is_json_lines, next_line, read_json_lines};
pub use laser::KnownLaser;
#[cfg(feature = "bags")]
pub use ros::{
    BagAccount, BagError, FrameAccount, GrowingBag, ReadRecording, RecordingError, RecordingOptions,
    TopicAccount, bag_account, follow_bag, is_packed_bag, read_bag, with_file,
};
pub use table::{TableError, is_table, read_table};
