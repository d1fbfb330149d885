//! Reading laser logs, whatever they were recorded by: CARMEN text, tables, and bags.

use std::path::Path;

use hssh::kind::FileKind;
use hssh::pipeline::LaserChoice;
use hssh_io::{KnownLaser, read_json_lines, read_table};
use hssh_local::LaserLog;

use super::Source;
use crate::arguments::TopicArguments;
use crate::failure::Failure;

/// The log in a file that was opened. What is used of a bag goes to standard error.
pub(super) fn read_log(
    file: &Path,
    source: Source,
    laser: &LaserChoice,
    topics: &TopicArguments,
) -> Result<LaserLog, Failure> {
    let mount = laser.mount();
    match source.kind() {
        FileKind::Recording(_) => bag::read_log(file, source, laser, topics),
        _ if topics.is_given() => Err(Failure::Usage(format!(
            "{} has no topics nor frames to choose from by --scan, --odom or --base-frame: it is {}",
            file.display(),
            source.kind()
        ))),
        FileKind::Table => {
            read_table(source.into_content(), &KnownLaser { view: mount.view, pose: mount.pose })
                .map_err(|error| Failure::ReadTable { file: file.to_owned(), error: Box::new(error) })
        }
        FileKind::JsonLines => {
            read_json_lines(source.into_content(), &KnownLaser { view: mount.view, pose: mount.pose })
                .map_err(|error| Failure::ReadJsonLines { file: file.to_owned(), error: Box::new(error) })
        }
        _ => LaserLog::read_with(source.into_content(), &mount)
            .map_err(|error| Failure::ReadLog { file: file.to_owned(), error: Box::new(error) }),
    }
}

#[cfg(feature = "bags")]
pub(crate) use bag::{read_account, recording_options};

#[cfg(feature = "bags")]
mod bag {
    use std::path::Path;

    use hssh::pipeline::LaserChoice;
    use hssh_io::{BagAccount, RecordingError, RecordingOptions, bag_account, read_bag, with_file};
    use hssh_local::LaserLog;

    use super::Source;
    use crate::arguments::TopicArguments;
    use crate::failure::Failure;
    use crate::terminal::say;

    pub(super) fn read_log(
        file: &Path,
        source: Source,
        laser: &LaserChoice,
        topics: &TopicArguments,
    ) -> Result<LaserLog, Failure> {
        if laser.view.is_some() {
            let text = "--fov (or the option laser.view) is for logs that do not say how wide the laser looks: a bag does";
            return Err(Failure::Usage(text.to_owned()));
        }
        let options = recording_options(laser, topics);
        let read = in_file(file, source, |path| read_bag(path, &options))?;
        for used in read.used {
            say(&format!("{}: {used}", file.display()));
        }
        Ok(read.log)
    }

    /// What is in a bag.
    pub(crate) fn read_account(
        file: &Path,
        source: Source,
        topics: &TopicArguments,
    ) -> Result<BagAccount, Failure> {
        let options = recording_options(&LaserChoice::default(), topics);
        in_file(file, source, |path| bag_account(path, &options))
    }

    /// Bags are read by their indexes: what comes through a pipe is put into a file first.
    fn in_file<T>(
        file: &Path,
        source: Source,
        read: impl FnOnce(&Path) -> Result<T, RecordingError>,
    ) -> Result<T, Failure> {
        let failed = |error| Failure::ReadBag { file: file.to_owned(), error: Box::new(error) };
        if source.is_plain() {
            return read(file).map_err(failed);
        }
        let unpacked = |error| Failure::Read { file: file.to_owned(), error };
        with_file(source.into_content(), read).map_err(unpacked)?.map_err(failed)
    }

    /// What is known and asked for of a bag.
    pub(crate) fn recording_options(laser: &LaserChoice, topics: &TopicArguments) -> RecordingOptions {
        let TopicArguments { scan, odom, base_frame } = topics.clone();
        RecordingOptions { scan, odometry: odom, base_frame, laser: laser.mount().pose }
    }
}

#[cfg(not(feature = "bags"))]
mod bag {
    use std::path::Path;

    use hssh::pipeline::LaserChoice;
    use hssh_local::LaserLog;

    use super::Source;
    use crate::arguments::TopicArguments;
    use crate::failure::Failure;

    pub(super) fn read_log(
        file: &Path,
        source: Source,
        _: &LaserChoice,
        _: &TopicArguments,
    ) -> Result<LaserLog, Failure> {
        Err(Failure::WithoutBags { file: file.to_owned(), kind: source.kind().clone() })
    }
}
