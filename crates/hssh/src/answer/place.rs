//! The places of a map, their ends, and what joins them.

use serde::{Deserialize, Serialize};

/// An end of a star in a map.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct EndReference {
    /// The number of the place.
    pub place: u32,
    /// The name of the end among those of the place.
    pub end: String,
}

/// What is known of an end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EndState {
    /// The path stops here.
    Closed,
    /// A gateway that was never travelled: where it leads is not known.
    Pending,
    /// A gateway that leads to a place of the map.
    Linked,
}

/// An end of a place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredEnd {
    /// The local path's number and its direction, as in `1+`; `1-` is the other end of the same local path.
    pub name: String,
    /// What is known of it.
    pub state: EndState,
    /// What else is known of it: a control law, an appearance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Where it points: radians, counterclockwise from the x axis of the place's frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bearing: Option<f64>,
    /// The end at the other side of its link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leads_to: Option<EndReference>,
    /// With a log: the two ends of the gateway, the line across the way out, in the frame of the place; metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gateway: Option<[[f64; 2]; 2]>,
}

/// A pose in the frame of the first place, and how well it is known.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlacedPose {
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians, counterclockwise.
    pub theta: f64,
    /// Of (x, y, θ), row by row, in the frame of the first place: m², m·rad, rad².
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<[[f64; 3]; 3]>,
}

/// A place of a map.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredPlace {
    /// The name of the star seen on the first visit.
    pub star: String,
    /// The ends of the star, clockwise.
    pub ends: Vec<AnsweredEnd>,
    /// The frame of the place, in which its bearings are given; absent without odometry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<PlacedPose>,
    /// With a log: the region of the building that the first visit to it was in; absent if it was in none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<u32>,
}

/// Two gateways that lead to one another.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredLink {
    /// The one that was travelled from first.
    pub from: EndReference,
    /// The other.
    pub to: EndReference,
    /// With a log: the corners of the way as it was driven, from the one place to the other, on the shortest of the travels and without
    /// its detours; metres in the frame of the first place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 2]>,
}

/// A path: places joined by going straight on.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct AnsweredPath {
    /// The places along it, in one of its two directions.
    pub places: Vec<u32>,
    /// At each of these places, the end that looks ahead.
    pub ahead: Vec<String>,
    /// Whether the last place leads on to the first.
    pub circular: bool,
}
