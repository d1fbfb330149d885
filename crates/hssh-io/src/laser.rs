//! What is known of a laser beside what was recorded.

use hssh_metrics::Pose;

/// What is known of the laser where a recording may not say it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct KnownLaser {
    /// How wide the laser looks, in radians; half a turn if neither this nor the recording says it.
    pub view: Option<f64>,
    /// The laser in the robot's frame.
    pub pose: Option<Pose>,
}
