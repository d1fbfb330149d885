//! A map of the ranking: what it is worth, its places, and how it explains what was visited.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::difference::MapDifference;
use super::place::{AnsweredLink, AnsweredPath, AnsweredPlace};
use super::visit::AnsweredVisit;

/// What preference looks at in a map (section 2.3.2); the less, the better, the first number first.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct MapMeasure {
    /// Pairs of a path and a place off it of which it is not determined on which side the place is.
    pub undetermined_boundaries: u64,
    /// Paths, those with a single place among them.
    pub paths: u32,
    /// Places.
    pub places: u32,
    /// Handles that a surface needs so that the map can be drawn on it without crossings.
    pub genus: u32,
}

impl fmt::Display for MapMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MapMeasure { undetermined_boundaries, paths, places, genus } = self;
        write!(
            f,
            "{undetermined_boundaries} undetermined boundaries, {paths} paths, {places} places, genus {genus}"
        )
    }
}

/// A part of what a map costs.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct CostItem {
    /// What it is for.
    pub item: String,
    /// How much: nats.
    pub nats: f64,
}

/// What a map costs: minus the logarithm of its posterior probability, up to a constant that all maps share.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct CostSheet {
    /// The sum: nats.
    pub total: f64,
    /// Item by item.
    pub items: Vec<CostItem>,
}

impl CostSheet {
    /// An item's cost; 0 if there is none.
    #[must_use]
    pub fn of(&self, item: &str) -> f64 {
        self.items.iter().find(|cost| cost.item == item).map_or(0.0, |cost| cost.nats)
    }
}

/// Where the robot is at the end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct CurrentPosition {
    /// The place.
    pub place: u32,
    /// φ: by how many ends, clockwise, the star seen last is turned to lie on the star of the place.
    pub rotation: u32,
}

/// A map that explains what is explained.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredMap {
    /// Its place in the ranking, the best one being 1.
    pub rank: u64,
    /// What identifies it anywhere: the choices that lead to it, one word for each travel. `p`: as predicted; `n`: to a new place; `c` with
    /// the number of a gateway: back to a known place, by that gateway. Gateways are numbered place by place, clockwise.
    pub branch: String,
    /// Whether it is proved that none is better.
    pub optimal: bool,
    /// Whether it is as good as the first; the first is.
    pub tied: bool,
    /// By posterior: its probability, at least and at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability: Option<[f64; 2]>,
    /// By posterior: what it costs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub costs: Option<CostSheet>,
    /// What preference looks at.
    pub measure: MapMeasure,
    /// No gateway is pending.
    pub closed: bool,
    /// No gateway is pending on a path with a single place.
    pub nearly_closed: bool,
    /// The places, by number: in the order in which they were found.
    pub places: Vec<AnsweredPlace>,
    /// What joins them, in the order in which it was found.
    pub links: Vec<AnsweredLink>,
    /// Its paths.
    pub paths: Vec<AnsweredPath>,
    /// How it explains the exploration: one entry for each visit explained, the start first.
    pub visits: Vec<AnsweredVisit>,
    /// Where the robot is at the end.
    pub current: CurrentPosition,
    /// With a log, if asked for: when every scan was taken and where, as (time, x, y, θ) in the frame of the first place. The time is
    /// that of the log, or the number of the scan; scans that cannot be used have the pose of the scan before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trajectory: Vec<[f64; 4]>,
    /// What tells it from the first map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<MapDifference>,
}
