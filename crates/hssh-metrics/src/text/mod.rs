//! Pose graphs as text: g2o (which GTSAM's own files use too), Vertigo, TORO and iSAM.

mod error;
mod fields;
mod file;
mod lines;
mod read;
mod records;
mod write;

pub use error::{ReadError, ReadProblem};
pub use file::{GraphFile, SkippedRecords};
pub use read::read_pose_graph;
