//! What tells a map from the first of the ranking, and how to find out which is right.

use serde::{Deserialize, Serialize};

use super::place::EndReference;

/// What tells a map from the first.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct MapDifference {
    /// In words.
    pub sentence: String,
    /// The first visit on which the two disagree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parting: Option<PartingVisit>,
    /// Travels that find out which is right; absent if none through known links do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<TestTravels>,
}

/// A visit that two maps take for different ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct PartingVisit {
    /// The visit, the start being 0.
    pub visit: u64,
    /// Its place in the first map.
    pub first_place: u32,
    /// φ in the first map.
    pub first_rotation: u32,
    /// Its place in this one.
    pub place: u32,
    /// φ in this one.
    pub rotation: u32,
}

/// Travels from where the robot is, the last of which the two maps say different things about.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct TestTravels {
    /// The gateways to leave by, one after the other, as gateways of the first map.
    pub exits: Vec<EndReference>,
    /// The end that the last travel arrives by, says the first map; absent if anything may follow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_arrival: Option<EndReference>,
    /// The same as this map says it, in this map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrival: Option<EndReference>,
}
