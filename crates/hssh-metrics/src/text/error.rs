//! What can be wrong with the text of a pose graph.

use crate::graph::GraphError;
use crate::uncertainty::UncertaintyError;

/// No line is longer, in bytes.
pub(super) const LONGEST_LINE: usize = 1 << 20;

/// What is wrong with a text that should be a pose graph, and where.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ReadError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    #[source]
    pub problem: ReadProblem,
}

/// What is wrong with a line.
#[derive(Debug, thiserror::Error)]
pub enum ReadProblem {
    /// The text cannot be read any further.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
    /// A line without end.
    #[error("the line is longer than {LONGEST_LINE} bytes, as no line of a pose graph is")]
    EndlessLine,
    /// Bytes that are no text.
    #[error("the line is no text in UTF-8: a pose graph is plain text, one record a line")]
    NoText,
    /// So many lines, and not one of a known type.
    #[error("there is no record of a pose graph on any line so far")]
    NoRecords,
    /// The line ends too early.
    #[error("{record} ends before its {field}; a complete line is `{form}`")]
    Missing {
        /// The record type.
        record: &'static str,
        /// What should come next.
        field: &'static str,
        /// How the record is written.
        form: &'static str,
    },
    /// A word that is not what stands there.
    #[error(
        "`{token}` stands where {record} has its {field}, which must be {expected}; a complete line is `{form}`"
    )]
    Malformed {
        /// The record type.
        record: &'static str,
        /// The word, shortened if it is long.
        token: String,
        /// What it should be.
        field: &'static str,
        /// How that is written.
        expected: &'static str,
        /// How the record is written.
        form: &'static str,
    },
    /// The line goes on after its last field.
    #[error("`{token}` is one word too many for {record}; a complete line is `{form}`")]
    Superfluous {
        /// The record type.
        record: &'static str,
        /// The first word too many, shortened if it is long.
        token: String,
        /// How the record is written.
        form: &'static str,
    },
    /// Two vertex records for one pose.
    #[error("pose {label} was given on line {first} already: every pose has one vertex record")]
    RepeatedPose {
        /// The file's number for the pose.
        label: u64,
        /// The line that gave it first.
        first: usize,
    },
    /// An anchor for a pose that occurs nowhere.
    #[error("pose {0} is fixed, but no vertex and no edge mentions it")]
    UnknownFixedPose(u64),
    /// One number for a pose and for a landmark.
    #[error("{0} is a landmark here and a pose elsewhere: every number names one thing")]
    PoseAndLandmark(u64),
    /// The information matrix is none.
    #[error("the information matrix from pose {from} to pose {to} is {problem}")]
    Information {
        /// The file's number for the start pose.
        from: u64,
        /// The file's number for the end pose.
        to: u64,
        /// What is wrong with it.
        problem: UncertaintyError,
    },
    /// The information matrix of a prior is none.
    #[error("the information matrix of the prior of pose {pose} is {problem}")]
    PriorInformation {
        /// The file's number for the pose.
        pose: u64,
        /// What is wrong with it.
        problem: UncertaintyError,
    },
    /// An edge from a pose to itself.
    #[error("the edge leads from pose {0} to itself: it says nothing about where the pose is, leave it out")]
    SelfEdge(u64),
    /// The edge does not fit into the graph; poses are named by [`PoseId`](crate::PoseId).
    #[error(transparent)]
    Edge(#[from] GraphError),
}

/// A word as it is shown: not endless, and nothing in it that a terminal would obey.
pub(super) fn shown(word: &str) -> String {
    const MOST: usize = 40;
    let short: String = word.chars().take(MOST).flat_map(char::escape_debug).collect();
    if word.chars().nth(MOST).is_some() { short + "…" } else { short }
}
