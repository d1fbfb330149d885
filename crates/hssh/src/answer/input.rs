//! What an answer was asked about, and how much of it the maps explain.

use serde::{Deserialize, Serialize};

/// What kind of input it was.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InputKind {
    /// Stars and travels.
    Exploration,
    /// A robot's laser log.
    LaserLog,
}

/// What was to be explained.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct AnsweredInput {
    /// The file or other source, as it was given.
    pub name: String,
    /// What it is.
    pub kind: InputKind,
    /// How many travels it has.
    pub travels: u64,
    /// How many of them, from the first on, were to be explained.
    pub considered: u64,
    /// How many of them the maps explain; 0 without maps.
    pub explained: u64,
    /// Laser scans in the log.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans: Option<u64>,
    /// How many of them could be used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans_used: Option<u64>,
}

impl AnsweredInput {
    /// How many travels the verdict is about: those explained, or those that nothing explains.
    #[must_use]
    pub fn basis(&self) -> u64 {
        if self.explained > 0 { self.explained } else { self.considered }
    }
}
