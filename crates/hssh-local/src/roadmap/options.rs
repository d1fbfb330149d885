//! For which robot the ways are, and where places are on them.

use serde::{Deserialize, Serialize};

use crate::place::PlaceOptions;
use crate::skeleton::UnknownSpace;

/// How a roadmap is made; lengths in metres.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RoadmapOptions {
    /// The radius of the robot: no point of a way is nearer to an obstacle. Default: 0.25 m.
    pub radius: f64,
    /// What unknown cells are. Default: walls.
    pub unknown: UnknownSpace,
    /// Obstacles farther away than this are no reason for a detour. Default: 1.5 m.
    pub comfort: f64,
    /// A way is left out if others lead to the same end and are longer by no more than this factor. Default: 1.25.
    pub detour: f64,
    /// Where ways part in a corridor is a junction if they lead on by this many widths of the corridor. Default: 2.
    pub arm: f64,
    /// The middle of a corridor is where obstacles are at least this part of half its width away. Default: 0.7.
    pub middle: f64,
    /// Lines are straightened as long as they move by no more than this. Default: 0.1 m.
    pub straighten: f64,
    /// Which gateways of a place continue one another.
    pub place: PlaceOptions,
}

impl Default for RoadmapOptions {
    fn default() -> Self {
        RoadmapOptions {
            radius: 0.25,
            unknown: UnknownSpace::Wall,
            comfort: 1.5,
            detour: 1.25,
            arm: 2.0,
            middle: 0.7,
            straighten: 0.1,
            place: PlaceOptions::default(),
        }
    }
}
