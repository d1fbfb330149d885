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

/// What the places of a log rest on: where the laser showed that the robot was back.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredEvidence {
    /// How often the robot came back to a stretch of its way, as the laser shows.
    pub returns: u64,
    /// How many stretches looked like an earlier one, and the rest of the log contradicts that.
    pub contradicted: u64,
    /// How many times the robot seems to be back and the laser does not show it.
    pub unconfirmed: u64,
    /// On how many stretches the robot was lost; no odometry at all counts as one.
    pub lost: u64,
    /// How probable it is that none of this misleads; a factor of the probability of every map.
    pub probability: f64,
}

/// What was to be explained.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
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
    /// Of a log: what its places rest on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<AnsweredEvidence>,
}

impl AnsweredInput {
    /// How many travels the verdict is about: those explained, or those that nothing explains.
    #[must_use]
    pub fn basis(&self) -> u64 {
        if self.explained > 0 { self.explained } else { self.considered }
    }
}
