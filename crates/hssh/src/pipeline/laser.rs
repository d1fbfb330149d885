//! What is known of a log's laser beside the log.

use hssh_local::LaserMount;
use hssh_metrics::Pose;
use serde::{Deserialize, Serialize};

/// How the laser of a log looks and sits; what is not said is as the log says, or straight ahead from the robot's axis and
/// half a turn wide.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LaserChoice {
    /// Degrees: how wide it looks.
    pub view: Option<f64>,
    /// Metres ahead of the robot's axis, metres to its left, and degrees that it is turned to the left.
    pub pose: Option<(f64, f64, f64)>,
}

impl LaserChoice {
    /// The same in the terms of the log's reader.
    #[must_use]
    pub fn mount(&self) -> LaserMount {
        let pose = self.pose.map(|(x, y, turn)| Pose::new(x, y, turn.to_radians()));
        LaserMount { view: self.view.map(f64::to_radians), pose }
    }

    /// Whether nothing is said.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        *self == LaserChoice::default()
    }
}
