//! Where in a log something stands.

use std::fmt;

/// Where in a log something stands: on a line if it is a text, else at a scan.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum LogPosition {
    /// A line of a text, counted from 1.
    Line(u64),
    /// A scan of a recording without lines, counted from 1 among all that it holds.
    Scan(u64),
}

impl fmt::Display for LogPosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LogPosition::Line(number) => write!(f, "line {number}"),
            LogPosition::Scan(number) => write!(f, "scan {number}"),
        }
    }
}
