//! What a map takes for errors of perception.

use serde::{Deserialize, Serialize};

/// The account that the maps of an answer rest on: what of the exploration is taken for misread (docs/readings.md). The maps are those of the
/// exploration as it must have been.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ReadingAccount {
    /// What it costs altogether, errors and layout: nats.
    pub nats: f64,
    /// What the errors cost.
    pub nats_of_errors: f64,
    /// Its share of the probability of all accounts that were found: what it has at most.
    pub at_most: f64,
    /// Whether no other account is better, which then is proved.
    pub proved: bool,
    /// How many accounts were found.
    pub found: u64,
    /// What is taken for misread, in the order of the visits.
    pub corrections: Vec<ReadingCorrection>,
    /// Visits of the exploration as told that are visits of the maps: ⟨as told, of the maps⟩, the start being 0. The others are taken for none, or
    /// for nothing but a turn on the way.
    pub visits: Vec<[u64; 2]>,
}

/// One thing that is taken for misread.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct ReadingCorrection {
    /// What kind of error.
    pub kind: CorrectionKind,
    /// The visit of the exploration as told, the start being 0; for a place that was passed: the visit that the travel ended in.
    pub visit: u64,
    /// The place of the first map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<u32>,
    /// The ends of the place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<String>,
    /// For people.
    pub sentence: String,
}

/// Kinds of errors.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CorrectionKind {
    /// Ends of the place were not seen.
    Missed,
    /// Ends were seen that no visit had shown before.
    New,
    /// A place was passed without a report.
    Passed,
    /// The report is of no place.
    False,
    /// The robot turned on the way, and came back.
    TurnedBack,
}
