//! What can be wrong with a log: problems of one message, which are passed over, and of the whole.

use std::fmt;

/// Why one message cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum MessageProblem {
    /// A word is no finite number.
    #[error("word {word}, `{token}`, is no finite number")]
    NotANumber {
        /// Its position in the line, counted from 1.
        word: usize,
        /// The word.
        token: String,
    },
    /// A range below zero.
    #[error("word {word}, `{token}`, is a negative range")]
    NegativeRange {
        /// Its position in the line, counted from 1.
        word: usize,
        /// The word.
        token: String,
    },
    /// The second word of a laser message does not say how many beams there are.
    #[error("word 2, `{token}`, is no number of beams between 1 and {most}", most = super::message::MOST_BEAMS)]
    BeamCount {
        /// The word.
        token: String,
    },
    /// The line ends before the message does, or has words left over.
    #[error("the message has {found} words, but {beams} beams take {expected}")]
    Length {
        /// How many words there are.
        found: usize,
        /// How many beams were announced.
        beams: usize,
        /// How many words that takes.
        expected: usize,
    },
    /// The line ends before the message does.
    #[error("the message ends after {found} words, {expected} are needed")]
    TooShort {
        /// How many words there are.
        found: usize,
        /// How many are needed.
        expected: usize,
    },
    /// The scan has another number of beams than the scans before it.
    #[error("the scan has {found} beams, but the scans before it have {expected}")]
    OtherBeamCount {
        /// How many beams it has.
        found: usize,
        /// How many the first scan has.
        expected: usize,
    },
}

/// Something in a log that was passed over.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum LogWarning {
    /// A message that was left out.
    Message {
        /// Its line, counted from 1.
        line: u64,
        /// What kind it says it is.
        kind: String,
        /// Why it was left out.
        problem: MessageProblem,
    },
    /// The log breaks off inside a line or inside its compressed data; it was used up to there.
    BreaksOff {
        /// The last line that began, counted from 1.
        line: u64,
        /// What happened there.
        reason: String,
    },
}

impl fmt::Display for LogWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LogWarning::Message { line, kind, problem } => {
                write!(f, "line {line}: {kind} left out: {problem}")
            }
            LogWarning::BreaksOff { line, reason } => {
                write!(f, "line {line}: the log breaks off here ({reason}); it was used up to this line")
            }
        }
    }
}

/// Why a log cannot be used at all.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be read.
    #[error("{}: {error}", if *line == 0 { "cannot read it".to_owned() } else { format!("cannot read on at line {line}") })]
    Read {
        /// The last line that began, counted from 1; 0 if none did.
        line: u64,
        /// Why not.
        error: std::io::Error,
    },
    /// A line that no log has: the file is something else.
    #[error("line {line} is longer than {most} bytes: this is no CARMEN log")]
    EndlessLine {
        /// The line, counted from 1.
        line: u64,
        /// How long a line may be.
        most: usize,
    },
    /// Nothing in it.
    #[error("the log is empty")]
    Empty,
    /// No usable scan.
    #[error(
        "the log has no usable laser scan: {lines} lines, among them {messages}{first}; a log needs FLASER messages",
        first = first_warning.as_ref().map_or_else(String::new, |warning| format!("; {warning}"))
    )]
    NoScans {
        /// How many lines there are.
        lines: u64,
        /// What they are.
        messages: String,
        /// The first problem met, if there was any.
        first_warning: Option<LogWarning>,
    },
}
