//! Pose graphs as text: g2o (which GTSAM's own files use too) and TORO.

mod file;
mod read;
mod write;

pub use file::{GraphFile, SkippedLine};
pub use read::{ReadError, ReadProblem, read_pose_graph};
