//! What was visited, and how a map explains it.

use serde::{Deserialize, Serialize};

use super::place::PlacedPose;

/// What the robot met: one visit, the same for all maps but for its place in the first one.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct VisitRecord {
    /// The name of the star that was seen.
    pub star: String,
    /// The place in the first map; absent if no map explains the visit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<u32>,
    /// With a log: the scan taken nearest to the place's center.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scan: Option<u64>,
    /// With a log: the first and the last scan from which the place was sighted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans: Option<[u64; 2]>,
    /// With a log that has them: when these two scans were taken, in seconds of the recording program's clock.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<[f64; 2]>,
    /// With a log: the region of the building that the place is in; absent if it is in none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<u32>,
}

/// How a visit follows from the visits before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Finding {
    /// It is the start.
    Start,
    /// The map has the link that was travelled, and the star is as predicted.
    Predicted,
    /// A place that was not visited before.
    NewPlace,
    /// A place visited before, entered by a gateway that was pending.
    Closure,
}

/// A visit as one map tells it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredVisit {
    /// The place.
    pub place: u32,
    /// φ: by how many ends, clockwise, the star as seen is turned to lie on the star of the place.
    pub rotation: u32,
    /// How it follows.
    pub finding: Finding,
    /// The end that the robot came in by, as the place names it; absent at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entry: Option<String>,
    /// The end that the robot left by, as the place names it; absent at the last visit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exit: Option<String>,
    /// With a log: the robot at the visit's `scan`, in the frame of the first place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<PlacedPose>,
}
