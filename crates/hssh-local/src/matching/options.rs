//! The numbers that scan matching goes by.

use super::motion::{MotionNoise, Slip};

/// The numbers that scan matching goes by, each beside its default.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MatchOptions {
    /// How raw odometry errs.
    pub odometry: MotionNoise,
    /// How it errs at worst: believed of a step where the scans contradict `odometry`; `None` if that is the worst already.
    pub worst_odometry: Option<MotionNoise>,
    /// Metres: only what a beam hits nearer than this is matched. Far walls hold the heading.
    pub reach: f64,
    /// Metres: the same for a scan that shows little up to there, as on a lawn.
    pub farthest_reach: f64,
    /// Metres: beams are thinned until what they hit is about this far apart.
    pub spacing: f64,
    /// Metres between a hit and the surface that it belongs to, standard deviation of one hit.
    pub hit_noise: f64,
    /// Neighboring hits err together: so many count as one.
    pub hits_per_observation: f64,
    /// The most recent scans that a scan is matched against, a stretch of so many metres of travel.
    pub memory: f64,
    /// Metres of travel after which a scan is added to those matched against…
    pub keyframe_distance: f64,
    /// …or radians of turning.
    pub keyframe_turn: f64,
    /// What to do where odometry and scans do not fit; `None` believes the odometry.
    pub slip: Option<Slip>,
    /// How many standard deviations of the odometry the coarse search looks around.
    pub search_sigmas: f64,
    /// However good a match is, a step is not known better than this: metres and radians, standard deviations.
    pub floor: (f64, f64),
}

impl Default for MatchOptions {
    fn default() -> Self {
        MatchOptions {
            odometry: MotionNoise::default(),
            worst_odometry: None,
            reach: 30.0,
            farthest_reach: 60.0,
            spacing: 0.08,
            hit_noise: 0.04,
            hits_per_observation: 2.0,
            memory: 8.0,
            keyframe_distance: 0.4,
            keyframe_turn: 0.3,
            slip: Some(Slip::default()),
            search_sigmas: 2.5,
            floor: (0.005, 0.001),
        }
    }
}
