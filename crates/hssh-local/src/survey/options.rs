//! The numbers that a survey goes by.

use crate::local_map::LocalMapOptions;
use crate::matching::MatchOptions;
use crate::place::PlaceOptions;

/// The numbers that a survey goes by, each beside its default; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SurveyOptions {
    /// How the robot's motion is tracked.
    pub matching: MatchOptions,
    /// How local maps are made.
    pub local_map: LocalMapOptions,
    /// How places are told from corridors.
    pub place: PlaceOptions,
    /// A neighborhood is looked at every so many metres…
    pub look_distance: f64,
    /// …when the robot has travelled so much farther: it sees a place best when it has left it.
    pub hindsight: f64,
    /// Side of the square that is looked at.
    pub window: f64,
    /// Two sightings in succession whose centers are this near are of one place.
    pub same_place: f64,
    /// A place must have been sighted so often.
    pub least_sightings: usize,
    /// How well the frame of a place is known, standard deviations: its center and its heading.
    pub place_fix: (f64, f64),
}

impl SurveyOptions {
    /// The same options for ways out that lead `depth` metres on, with windows and local maps as large, and hindsight
    /// as long, as it takes to see so far.
    #[must_use]
    pub fn with_depth(mut self, depth: f64) -> Self {
        self.place = self.place.with_depth(depth);
        self.hindsight = depth;
        self.window = 2.0 * depth + 12.0;
        self.local_map.side = self.window + 2.0 * depth + 4.0;
        self
    }
}

impl Default for SurveyOptions {
    fn default() -> Self {
        SurveyOptions {
            matching: MatchOptions::default(),
            local_map: LocalMapOptions::default(),
            place: PlaceOptions::corridors(),
            look_distance: 0.3,
            hindsight: 8.0,
            window: 28.0,
            same_place: 3.0,
            least_sightings: 2,
            place_fix: (0.3, 0.03),
        }
    }
}
