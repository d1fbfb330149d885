//! Files as input: opened and unpacked, told apart by what is in them, and read.

mod error;
mod log;
mod source;

use std::path::Path;

use hssh_causal::Exploration;
use hssh_metrics::{GraphFile, read_pose_graph};

use crate::kind::FileKind;

pub use error::FileError;
pub use log::{ReadLog, TopicChoice, read_log};
#[cfg(feature = "bags")]
pub use log::{read_bag_account, recording_options};
pub use source::Source;

/// The exploration in a file that was opened.
///
/// # Errors
/// If it holds something else, or is wrong somewhere, with line and column.
pub fn read_exploration(file: &Path, source: Source) -> Result<Exploration, FileError> {
    if !matches!(source.kind(), FileKind::Exploration | FileKind::Text | FileKind::Empty) {
        return Err(source.unfit("an exploration"));
    }
    let bytes = source.into_bytes()?;
    Exploration::from_ron_bytes(&bytes).map_err(|error| FileError::of_exploration(file, &bytes, error))
}

/// The pose graph in a file that was opened; one without measurements in the plane is refused.
///
/// # Errors
/// If it holds something else or nothing, or is wrong somewhere, with its line.
pub fn read_graph(file: &Path, source: Source) -> Result<GraphFile, FileError> {
    if !matches!(
        source.kind(),
        FileKind::PoseGraph(_) | FileKind::LaserLog(_) | FileKind::Text | FileKind::Empty
    ) {
        return Err(source.unfit("a pose graph"));
    }
    let unfit = source.unfit("a pose graph");
    let is_log = matches!(source.kind(), FileKind::LaserLog(_));
    let read = read_pose_graph(source.into_content())
        .map_err(|error| FileError::PoseGraph { file: file.to_owned(), error: Box::new(error) })?;
    let has_poses = read.labels.len() > read.landmarks.len();
    let lost = read.skipped.iter().find(|skipped| skipped.matters());
    match lost.or(read.skipped.first()) {
        _ if has_poses && (!read.graph.edges().is_empty() || lost.is_none()) => Ok(read),
        _ if is_log => Err(unfit),
        None => {
            let skipped = "it has no records at all".to_owned();
            Err(FileError::EmptyGraph { file: file.to_owned(), skipped })
        }
        Some(first) => {
            let what = if first.is_spatial() {
                "is of a graph in space"
            } else {
                "is of a type that hssh does not know"
            };
            let skipped = format!(
                "{} of its records, `{}` on line {} the first, {what}",
                first.count, first.record, first.line
            );
            Err(FileError::EmptyGraph { file: file.to_owned(), skipped })
        }
    }
}
