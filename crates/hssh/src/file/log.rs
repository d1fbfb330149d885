//! Reading laser logs, whatever they were recorded by: CARMEN text, tables, and bags.

use std::path::Path;

use hssh_io::{KnownLaser, read_json_lines, read_table};
use hssh_local::{LaserKind, LaserLog};

use super::error::FileError;
use super::source::Source;
use crate::kind::FileKind;
use crate::pipeline::LaserChoice;

/// What of a recording is used; what is not said is found.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TopicChoice {
    /// The topic with the scans, several with commas between them; of a CARMEN log, the names of messages.
    pub scan: Option<String>,
    /// The topic with the odometry, or the frame of /tf in which the robot moves; `none` for scan matching alone.
    pub odometry: Option<String>,
    /// The frame of the robot that odometry moves.
    pub base_frame: Option<String>,
}

impl TopicChoice {
    /// The lasers of a CARMEN log that are chosen, by the names of their messages; none if nothing is.
    ///
    /// # Errors
    /// If a name is that of no laser's messages.
    pub fn lasers(&self, file: &Path) -> Result<Vec<LaserKind>, FileError> {
        let names = self.scan.iter().flat_map(|names| names.split(','));
        let kind = |name: &str| {
            let unknown = || FileError::NoLaser { file: file.to_owned(), name: name.to_owned() };
            LaserKind::named(name.trim().trim_start_matches('/')).ok_or_else(unknown)
        };
        names.map(kind).collect()
    }

    /// Whether anything is chosen.
    #[must_use]
    pub fn is_given(&self) -> bool {
        *self != TopicChoice::default()
    }
}

/// A log as it was read.
#[derive(Clone, Debug)]
pub struct ReadLog {
    /// The log.
    pub log: LaserLog,
    /// What of a bag is used, in sentences.
    pub used: Vec<String>,
}

/// The log in a file that was opened.
///
/// # Errors
/// If it holds none that can be used, or if choices do not go with what it holds.
pub fn read_log(
    file: &Path,
    source: Source,
    laser: &LaserChoice,
    topics: &TopicChoice,
) -> Result<ReadLog, FileError> {
    let mount = laser.mount();
    let alone = |log: LaserLog| ReadLog { log, used: Vec::new() };
    match source.kind() {
        FileKind::Recording(_) => bag::read_log(file, source, laser, topics),
        FileKind::LaserLog(_) if topics.odometry.is_none() && topics.base_frame.is_none() => {
            let chosen = topics.lasers(file)?;
            LaserLog::read_lasers(source.into_content(), &mount, &chosen)
                .map(alone)
                .map_err(|error| FileError::Log { file: file.to_owned(), error: Box::new(error) })
        }
        kind if topics.is_given() => Err(FileError::NoTopics { file: file.to_owned(), kind: kind.clone() }),
        FileKind::Table => {
            read_table(source.into_content(), &KnownLaser { view: mount.view, pose: mount.pose })
                .map(alone)
                .map_err(|error| FileError::Table { file: file.to_owned(), error: Box::new(error) })
        }
        FileKind::JsonLines => {
            read_json_lines(source.into_content(), &KnownLaser { view: mount.view, pose: mount.pose })
                .map(alone)
                .map_err(|error| FileError::JsonLines { file: file.to_owned(), error: Box::new(error) })
        }
        _ => LaserLog::read_with(source.into_content(), &mount)
            .map(alone)
            .map_err(|error| FileError::Log { file: file.to_owned(), error: Box::new(error) }),
    }
}

#[cfg(feature = "bags")]
pub use bag::{read_bag_account, recording_options};

#[cfg(feature = "bags")]
mod bag {
    use std::path::Path;

    use hssh_io::{BagAccount, RecordingError, RecordingOptions, bag_account, read_bag, with_file};

    use super::{FileError, LaserChoice, ReadLog, Source, TopicChoice};

    pub(super) fn read_log(
        file: &Path,
        source: Source,
        laser: &LaserChoice,
        topics: &TopicChoice,
    ) -> Result<ReadLog, FileError> {
        if laser.view.is_some() {
            return Err(FileError::ViewOfBag);
        }
        let options = recording_options(laser, topics);
        let read = in_file(file, source, |path| read_bag(path, &options))?;
        Ok(ReadLog { log: read.log, used: read.used })
    }

    /// What is in a bag.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn read_bag_account(
        file: &Path,
        source: Source,
        topics: &TopicChoice,
    ) -> Result<BagAccount, FileError> {
        let options = recording_options(&LaserChoice::default(), topics);
        in_file(file, source, |path| bag_account(path, &options))
    }

    /// Bags are read by their indexes: what comes through a pipe is put into a file first.
    fn in_file<T>(
        file: &Path,
        source: Source,
        read: impl FnOnce(&Path) -> Result<T, RecordingError>,
    ) -> Result<T, FileError> {
        let failed = |error| FileError::Bag { file: file.to_owned(), error: Box::new(error) };
        if source.is_plain() {
            return read(file).map_err(failed);
        }
        let unpacked = |error| FileError::Read { file: file.to_owned(), error };
        with_file(source.into_content(), read).map_err(unpacked)?.map_err(failed)
    }

    /// What is known and asked for of a bag.
    #[must_use]
    pub fn recording_options(laser: &LaserChoice, topics: &TopicChoice) -> RecordingOptions {
        let TopicChoice { scan, odometry, base_frame } = topics.clone();
        RecordingOptions { scan, odometry, base_frame, laser: laser.mount().pose }
    }
}

#[cfg(not(feature = "bags"))]
mod bag {
    use std::path::Path;

    use super::{FileError, LaserChoice, ReadLog, Source, TopicChoice};

    pub(super) fn read_log(
        file: &Path,
        source: Source,
        _: &LaserChoice,
        _: &TopicChoice,
    ) -> Result<ReadLog, FileError> {
        Err(FileError::WithoutBags { file: file.to_owned(), kind: source.kind().clone() })
    }
}
