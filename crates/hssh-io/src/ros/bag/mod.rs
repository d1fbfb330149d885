//! Bags as containers: what topics there are, and the messages of those that are wanted, whatever the file is.

mod compressed;
mod folder;
mod mcap_file;
mod ros1;
mod ros1_record;
mod sqlite;

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::ros::message::MessageType;
use crate::ros::wire::Wire;

pub use compressed::{is_packed_bag, with_file};

/// Why a bag cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum BagError {
    /// The file system says no.
    #[error("cannot read {file}: {error}", file = file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// It is damaged so early that nothing can be read.
    #[error("the bag {file} is damaged: {reason}; nothing of it can be read", file = file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// It is compressed in a way that is not known.
    #[error(
        "{file} is compressed by `{by}`, which hssh cannot unpack (it knows {known}); rewrite the bag without compression",
        file = file.display()
    )]
    Compression {
        /// The file.
        file: PathBuf,
        /// The compression's name.
        by: String,
        /// Those that are known for such files.
        known: &'static str,
    },
    /// A file of another kind.
    #[error("{file} is no bag: {reason}", file = file.display())]
    NoBag {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

impl BagError {
    fn read(file: &Path) -> impl Fn(io::Error) -> BagError + '_ {
        |error| BagError::Read { file: file.to_owned(), error }
    }

    fn damaged(file: &Path, reason: impl ToString) -> BagError {
        BagError::Damaged { file: file.to_owned(), reason: reason.to_string() }
    }
}

/// A topic of a bag.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct BagTopic {
    pub(crate) name: String,
    /// The name of its type, as the bag writes it.
    pub(crate) type_name: String,
    /// How its messages are written, if that is known.
    pub(crate) wire: Option<Wire>,
    pub(crate) messages: u64,
}

impl BagTopic {
    pub(crate) fn kind(&self) -> MessageType {
        MessageType::of(&self.type_name)
    }

    /// Whether its messages are to be read.
    pub(crate) fn is_read(&self) -> bool {
        self.kind().is_read() && self.wire.is_some()
    }
}

/// What there is in a bag.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct BagContents {
    /// All topics, those that are not read among them.
    pub(crate) topics: Vec<BagTopic>,
    /// When the first and the last message was recorded, if any was: nanoseconds.
    pub(crate) span: Option<[i64; 2]>,
    /// Where and why the bag breaks off, for each file that does.
    pub(crate) breaks: Vec<String>,
}

impl BagContents {
    /// The number of a topic, which is added if it is not there.
    fn topic(&mut self, name: &str, type_name: &str, wire: Option<Wire>) -> usize {
        let known = self.topics.iter().position(|topic| topic.name == name && topic.type_name == type_name);
        known.unwrap_or_else(|| {
            let (name, type_name) = (name.to_owned(), type_name.to_owned());
            self.topics.push(BagTopic { name, type_name, wire, messages: 0 });
            self.topics.len() - 1
        })
    }

    fn extend_span(&mut self, time: i64) {
        let [first, last] = self.span.unwrap_or([time; 2]);
        self.span = Some([first.min(time), last.max(time)]);
    }
}

/// A message that is to be read.
pub(crate) struct BagMessage<'a> {
    pub(crate) topic: &'a BagTopic,
    /// When it was recorded: nanoseconds.
    pub(crate) time: i64,
    pub(crate) bytes: &'a [u8],
}

/// Is told every message of the topics that are read, in the order of the file.
pub(crate) type Visit<'a> = &'a mut dyn FnMut(BagMessage<'_>);

/// Reads a bag: a file of any kind, or a folder of them.
pub(crate) fn read(path: &Path, visit: Visit<'_>) -> Result<BagContents, BagError> {
    let mut contents = BagContents::default();
    if path.is_dir() {
        for file in folder::files(path)? {
            read_file(&file, &mut contents, visit)?;
        }
    } else {
        read_file(path, &mut contents, visit)?;
    }
    Ok(contents)
}

/// Reads an MCAP file as it comes, under a name.
pub(crate) fn read_stream(name: &Path, source: impl Read, visit: Visit<'_>) -> Result<BagContents, BagError> {
    let mut contents = BagContents::default();
    mcap_file::linear(name, source, &mut contents, visit)?;
    Ok(contents)
}

fn read_file(file: &Path, contents: &mut BagContents, visit: Visit<'_>) -> Result<(), BagError> {
    let mut beginning = Vec::new();
    let opened = File::open(file).map_err(BagError::read(file))?;
    opened.take(16).read_to_end(&mut beginning).map_err(BagError::read(file))?;
    match &beginning[..] {
        [0x89, b'M', b'C', b'A', b'P', ..] => mcap_file::read(file, contents, visit),
        [b'S', b'Q', b'L', b'i', b't', b'e', ..] => sqlite::read(file, contents, visit),
        [b'#', b'R', b'O', b'S', b'B', b'A', b'G', ..] => ros1::read(file, contents, visit),
        [0x28, 0xB5, 0x2F, 0xFD, ..] => {
            let unpacked = compressed::unpacked(file)?;
            read_file(unpacked.path(), contents, visit)
        }
        [] => Err(BagError::NoBag { file: file.to_owned(), reason: "it is empty".to_owned() }),
        _ => {
            let reason = "it begins like neither an MCAP file, nor a database, nor a ROS 1 bag".to_owned();
            Err(BagError::NoBag { file: file.to_owned(), reason })
        }
    }
}
