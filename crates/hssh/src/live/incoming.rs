//! What comes from a robot while it drives, of whatever kind it is.

use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::Path;

use hssh::file::FileError;
use hssh::kind::FileKind;
use hssh::pipeline::LaserChoice;
use hssh_io::{JsonLines, KnownLaser, next_line};
use hssh_local::{GrowingLog, LaserLog, LogReader};

use crate::arguments::TopicArguments;
use crate::failure::Failure;

/// So much is looked at, at most, to say what comes.
const LOOKED_AT: usize = 1 << 16;

/// What has come so far.
#[derive(Clone)]
pub(crate) enum Incoming {
    /// Messages of a CARMEN log.
    Messages(GrowingLog),
    /// Lines of JSON.
    Lines(JsonLines),
    /// An MCAP file.
    #[cfg(feature = "bags")]
    Bag(hssh_io::GrowingBag),
}

/// A source of which it is known what comes.
pub(crate) struct Source {
    content: Box<dyn BufRead + Send>,
    /// What there is of it so far: nothing.
    pub(crate) incoming: Incoming,
}

impl Source {
    /// Opens a pipe or a file, or standard input if the path is `-`, and waits for its first line.
    pub(crate) fn open(file: &Path, laser: &LaserChoice, topics: &TopicArguments) -> Result<Self, Failure> {
        let unreadable = |error| FileError::Read { file: file.to_owned(), error };
        let mut content: Box<dyn BufRead + Send> = if file.as_os_str() == "-" {
            Box::new(BufReader::new(io::stdin()))
        } else {
            Box::new(BufReader::new(std::fs::File::open(file).map_err(unreadable)?))
        };
        let beginning = first_line(&mut content).map_err(unreadable)?;
        let kind = FileKind::of(&beginning);
        let is_gzip = beginning.starts_with(&[0x1F, 0x8B]);
        let mount = laser.mount();
        let chosen =
            if matches!(kind, FileKind::Recording(_)) { Vec::new() } else { topics.choice().lasers(file)? };
        let messages = || Incoming::Messages(GrowingLog::new(mount).of_lasers(&chosen));
        let incoming = match kind {
            FileKind::JsonLines => {
                Incoming::Lines(JsonLines::new(KnownLaser { view: mount.view, pose: mount.pose }))
            }
            FileKind::Recording(_) if beginning.starts_with(b"\x89MCAP") => bag(file, laser, topics)?,
            _ if is_gzip => messages(),
            FileKind::LaserLog(_) | FileKind::Text => messages(),
            kind => {
                let wanted =
                    "messages of a CARMEN log, scans as lines of JSON, or an MCAP file, as they come";
                return Err(FileError::Kind { file: file.to_owned(), kind, wanted }.into());
            }
        };
        Ok(Source { content: Box::new(Cursor::new(beginning).chain(content)), incoming })
    }

    /// Reads to the end. `change` is given each change of what has come.
    pub(crate) fn read(
        self,
        file: &Path,
        mut change: impl FnMut(&mut dyn FnMut(&mut Incoming)),
    ) -> Result<(), Failure> {
        match self.incoming {
            Incoming::Messages(_) => {
                let failed = |error| FileError::Log { file: file.to_owned(), error: Box::new(error) };
                let mut reader = LogReader::new(self.content).map_err(failed)?;
                loop {
                    let mut message = reader.next_message().map_err(failed)?;
                    let is_end = message.is_none();
                    change(&mut |incoming| {
                        if let Incoming::Messages(log) = incoming {
                            log.add(message.take(), &mut reader);
                        }
                    });
                    if is_end {
                        return Ok(());
                    }
                }
            }
            Incoming::Lines(_) => {
                let failed = |error| FileError::JsonLines { file: file.to_owned(), error: Box::new(error) };
                let mut content = self.content;
                let mut number = 1;
                while let Some(line) = next_line(&mut content, number).map_err(failed)? {
                    number += 1;
                    change(&mut |incoming| {
                        if let Incoming::Lines(lines) = incoming {
                            lines.add(&line);
                        }
                    });
                }
                Ok(())
            }
            #[cfg(feature = "bags")]
            Incoming::Bag(_) => {
                let read = hssh_io::follow_bag(file, self.content, |on_bag| {
                    change(&mut |incoming| {
                        if let Incoming::Bag(bag) = incoming {
                            on_bag(bag);
                        }
                    });
                });
                Ok(read.map_err(|error| FileError::Bag { file: file.to_owned(), error: Box::new(error) })?)
            }
        }
    }
}

#[cfg(feature = "bags")]
fn bag(_: &Path, laser: &LaserChoice, topics: &TopicArguments) -> Result<Incoming, Failure> {
    let options = hssh::file::recording_options(laser, &topics.choice());
    Ok(Incoming::Bag(hssh_io::GrowingBag::new(options)))
}

#[cfg(not(feature = "bags"))]
fn bag(file: &Path, _: &LaserChoice, _: &TopicArguments) -> Result<Incoming, Failure> {
    Err(FileError::WithoutBags { file: file.to_owned(), kind: FileKind::Recording("an MCAP file") }.into())
}

impl Incoming {
    /// How many scans have come.
    pub(crate) fn scans(&self) -> usize {
        match self {
            Incoming::Messages(log) => log.scans(),
            Incoming::Lines(lines) => lines.scans(),
            #[cfg(feature = "bags")]
            Incoming::Bag(bag) => bag.scans(),
        }
    }

    /// The log as far as it is settled; `None` if nothing can be made of it yet.
    pub(crate) fn settled(&self) -> Option<LaserLog> {
        match self {
            Incoming::Messages(log) => log.log().ok(),
            Incoming::Lines(lines) => lines.log().ok(),
            #[cfg(feature = "bags")]
            Incoming::Bag(bag) => bag.log().ok(),
        }
    }

    /// The log of all that has come.
    pub(crate) fn into_log(self, file: &Path) -> Result<LaserLog, FileError> {
        let file = file.to_owned();
        match self {
            Incoming::Messages(log) => {
                log.into_log().map_err(|error| FileError::Log { file, error: Box::new(error) })
            }
            Incoming::Lines(lines) => {
                lines.into_log().map_err(|error| FileError::JsonLines { file, error: Box::new(error) })
            }
            #[cfg(feature = "bags")]
            Incoming::Bag(bag) => bag
                .read()
                .map(|read| read.log)
                .map_err(|error| FileError::Bag { file, error: Box::new(error) }),
        }
    }
}

/// What comes first, up to the end of a line if there is one.
fn first_line(content: &mut impl BufRead) -> io::Result<Vec<u8>> {
    let mut beginning = Vec::new();
    while beginning.len() < LOOKED_AT && !beginning.contains(&b'\n') {
        let new = content.fill_buf()?;
        if new.is_empty() {
            break;
        }
        beginning.extend_from_slice(new);
        let count = new.len();
        content.consume(count);
    }
    Ok(beginning)
}
