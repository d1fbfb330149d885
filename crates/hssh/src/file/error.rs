//! What can be wrong with a file that is to be read, in the words that people see.

use std::path::{Path, PathBuf};

use hssh_causal::ParseError;
use hssh_local::LaserKind;

use crate::kind::FileKind;

/// Why a file cannot be used. It says the file, what is wrong with it and what to do.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// It cannot be opened or read.
    #[error("cannot read {}: {error}\nhelp: give the path of a file that is there, or - for standard input", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the operating system says.
        error: std::io::Error,
    },
    /// It is compressed by something that is not unpacked here.
    #[error("{} is {kind}: unpack it first, as by `{} {} | hssh …` with `-` for the file", file.display(), unpacker(kind), file.display())]
    Compressed {
        /// The file.
        file: PathBuf,
        /// By what.
        kind: FileKind,
    },
    /// It holds something else.
    #[error("{} is {kind}, but this command takes {wanted}{}", file.display(), advice(kind))]
    Kind {
        /// The file.
        file: PathBuf,
        /// What it holds.
        kind: FileKind,
        /// What was wanted.
        wanted: &'static str,
    },
    /// It cannot be unpacked.
    #[error("cannot unpack {}: {error}\nhelp: the file is cut off or damaged: copy it again", file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// What the unpacker says.
        error: std::io::Error,
    },
    /// It is longer than anything of its kind.
    #[error("{} is longer than {most} MiB: no exploration is that large\nhelp: a laser log or a pose graph may be", file.display())]
    TooLong {
        /// The file.
        file: PathBuf,
        /// MiB that it may have.
        most: u64,
    },
    /// It is no exploration.
    #[error("{rendered}")]
    Exploration {
        /// What is wrong with it, with the lines that are.
        rendered: String,
        /// The same as data.
        error: ParseError,
    },
    /// It is no laser log.
    #[error("cannot use {}: {error}\nhelp: give the path of a CARMEN log with FLASER messages, plain or gzip, or - for standard input", file.display())]
    Log {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<hssh_local::LogError>,
    },
    /// It is no table of scans.
    #[error("cannot use {}: {error}", file.display())]
    Table {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<hssh_io::TableError>,
    },
    /// It is no scans as lines of JSON.
    #[error("cannot use {}: {error}", file.display())]
    JsonLines {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<hssh_io::JsonLinesError>,
    },
    /// It is no bag with scans.
    #[cfg(feature = "bags")]
    #[error("cannot use {}: {error}\nhelp: `hssh check` says what is in a bag", file.display())]
    Bag {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<hssh_io::RecordingError>,
    },
    /// It is a bag, which this build does not read.
    #[cfg(not(feature = "bags"))]
    #[error("{} is {kind}, and this hssh was built without its feature `bags`\nhelp: `cargo run --release --package hssh -- …` has it", file.display())]
    WithoutBags {
        /// The file.
        file: PathBuf,
        /// Of which kind.
        kind: FileKind,
    },
    /// A name after `--scan` that no messages of a laser have.
    #[error("--scan {name}: the lasers of {}, a CARMEN log, go by the names of their messages: {}", file.display(), LaserKind::ALL.map(LaserKind::name).join(", "))]
    NoLaser {
        /// The log.
        file: PathBuf,
        /// The name.
        name: String,
    },
    /// Topics were chosen of something that has none.
    #[error("{} has no topics nor frames to choose from by --scan, --odom or --base-frame: it is {kind}", file.display())]
    NoTopics {
        /// The file.
        file: PathBuf,
        /// What it holds.
        kind: FileKind,
    },
    /// A bag says itself how wide its laser looks.
    #[cfg(feature = "bags")]
    #[error(
        "--fov (or the option laser.view) is for logs that do not say how wide the laser looks: a bag does"
    )]
    ViewOfBag,
    /// It is no pose graph.
    #[error("{}: {error}", file.display())]
    PoseGraph {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<hssh_metrics::ReadError>,
    },
    /// It has no measurements between poses in the plane.
    #[error("{} holds no pose graph in the plane: {skipped}\nhelp: hssh reads records in the plane: `VERTEX_SE2`, `EDGE_SE2` (g2o), `VERTEX2`, `EDGE2` (TORO), `ODOMETRY` (iSAM)", file.display())]
    EmptyGraph {
        /// The file.
        file: PathBuf,
        /// What it has instead.
        skipped: String,
    },
}

impl FileError {
    /// Of a text that is no exploration.
    #[must_use]
    pub fn of_exploration(file: &Path, bytes: &[u8], error: ParseError) -> Self {
        let source = String::from_utf8_lossy(bytes);
        FileError::Exploration { rendered: error.render(&file.display().to_string(), &source), error }
    }
}

/// What unpacks a compressed file.
fn unpacker(kind: &FileKind) -> &'static str {
    if let FileKind::Compressed(_, unpacker) = kind { unpacker } else { "cat" }
}

/// What to do with a file that another command takes, on a line of its own.
fn advice(kind: &FileKind) -> String {
    match kind.advice() {
        "" => String::new(),
        advice => format!("\nhelp: {advice}"),
    }
}
