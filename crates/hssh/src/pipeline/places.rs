//! What counts as a place, in the terms of the library for small-scale space.

use hssh_local::{PlaceParameters, SkeletonParameters, SurveyOptions, UnknownSpace};
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
    pub fn in_grids(&self, unknown: UnknownSpace) -> PlaceParameters {
        let usual = SkeletonParameters::default();
        let skeleton = SkeletonParameters {
            unknown,
            clutter: self.clutter.unwrap_or(usual.clutter),
            narrowest_passage: self.narrowest.unwrap_or(usual.narrowest_passage),
            shallowest_branch: self.shallowest.unwrap_or(usual.shallowest_branch),
            ..usual
        };
        PlaceParameters { skeleton, ..PlaceParameters::default() }
    }

    /// What that means along a log.
    #[must_use]
    pub fn along_logs(&self) -> SurveyOptions {
        let usual = SurveyOptions::default();
        let mut options = self.shallowest.map_or(usual, |depth| usual.with_depth(depth));
        options.place.narrowest_way = self.narrowest.unwrap_or(options.place.narrowest_way);
        options.place.clutter = self.clutter.unwrap_or(options.place.clutter);
        options
    }

    /// Whether everything is as usual.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        *self == PlaceChoice::default()
    }
}
