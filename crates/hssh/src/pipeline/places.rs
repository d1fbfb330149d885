//! What counts as a place, in the terms of the library for small-scale space.

use hssh_local::{PlaceOptions, SurveyOptions, UnknownSpace};
use serde::{Deserialize, Serialize};

/// What counts as a place; what is not said is as usual, which is different in grid maps and along logs.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlaceChoice {
    /// Metres: passages narrower than this are closed.
    pub narrowest: Option<f64>,
    /// Metres: ways that lead on for less are no ways out.
    pub shallowest: Option<f64>,
    /// Metres: obstacles no larger than this are clutter.
    pub clutter: Option<f64>,
}

impl PlaceChoice {
    /// What that means in a grid map.
    #[must_use]
    pub fn in_grids(&self, unknown: UnknownSpace) -> PlaceOptions {
        let usual = PlaceOptions::default();
        let mut options = self.shallowest.map_or(usual, |depth| usual.with_depth(depth));
        options.skeleton.unknown = unknown;
        self.narrow(options)
    }

    /// What that means along a log.
    #[must_use]
    pub fn along_logs(&self) -> SurveyOptions {
        let usual = SurveyOptions::default();
        let options = self.shallowest.map_or(usual, |depth| usual.with_depth(depth));
        SurveyOptions { place: self.narrow(options.place), ..options }
    }

    /// What is said about free space, which is the same in both.
    fn narrow(&self, mut options: PlaceOptions) -> PlaceOptions {
        let skeleton = &mut options.skeleton;
        skeleton.narrowest_passage = self.narrowest.unwrap_or(skeleton.narrowest_passage);
        skeleton.clutter = self.clutter.unwrap_or(skeleton.clutter);
        options
    }

    /// Whether everything is as usual.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        *self == PlaceChoice::default()
    }
}
