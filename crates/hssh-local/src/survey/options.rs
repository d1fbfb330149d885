//! The numbers that a survey goes by.

use crate::closing::ClosingOptions;
use crate::local_map::LocalMapOptions;
use crate::matching::MatchOptions;
use crate::place::PlaceOptions;
use crate::route::RouteOptions;

/// The numbers that a survey goes by, each beside its default; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SurveyOptions {
    /// How the robot's motion is tracked.
    pub matching: MatchOptions,
    /// How loops are closed.
    pub closing: ClosingOptions,
    /// How ways are found in the robot's way.
    pub route: RouteOptions,
    /// How local maps are made.
    pub local_map: LocalMapOptions,
    /// How places are told from corridors.
    pub place: PlaceOptions,
    /// Side of the square that is looked at.
    pub window: f64,
    /// How well the frame of a place is known, standard deviations: its center and its heading.
    pub place_fix: (f64, f64),
}

impl SurveyOptions {
    /// The same options for ways out that lead `depth` metres on, with windows and local maps as large
    /// as it takes to see so far.
    #[must_use]
    pub fn with_depth(mut self, depth: f64) -> Self {
        self.place = self.place.with_depth(depth);
        self.window = 2.0 * depth + 12.0;
        self.local_map.side = self.window + 2.0 * depth + 4.0;
        self
    }
}

impl Default for SurveyOptions {
    fn default() -> Self {
        SurveyOptions {
            matching: MatchOptions::default(),
            closing: ClosingOptions::default(),
            route: RouteOptions::default(),
            local_map: LocalMapOptions::default(),
            place: PlaceOptions::corridors(),
            window: 28.0,
            place_fix: (0.3, 0.03),
        }
    }
}
