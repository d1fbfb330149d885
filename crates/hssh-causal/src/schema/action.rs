//! Actions: the turns and travels that lead from one distinctive state to the next (section 2.1.2).

use std::fmt;

/// What the robot does in a distinctive state.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Action {
    /// Turns clockwise, to face the oriented local path that many positions on.
    Turn {
        /// Positions in the circular order, at least one.
        clockwise: u32,
    },
    /// Turns by 180 degrees, to face the other direction of the same local path. In the basic SSH the
    /// only action that tells how a path goes on across a place (section 2.3.3).
    TurnAround,
    /// Leaves by the gateway ahead and goes on to the next place, where the robot then looks the way it
    /// came in.
    Travel,
}

impl Action {
    /// Whether the action leads to another place.
    #[must_use]
    pub fn is_travel(self) -> bool {
        self == Action::Travel
    }
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Action::Turn { clockwise } => write!(f, "turn {clockwise}"),
            Action::TurnAround => f.write_str("turn around"),
            Action::Travel => f.write_str("travel"),
        }
    }
}

/// How far an action took the robot: the metrical annotation of a schema.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Change {
    /// Metres from the one place's origin to the other's, as the crow flies. Turns have none.
    pub distance: Option<f64>,
    /// By how much the robot's heading changed, in radians counterclockwise. Known if the bearings of the
    /// faced local paths are, and on a travel the odometry. Clockwise turns are in [−2π, 0), so that a full
    /// circle adds up to −2π; turning around and travels are in (−π, π].
    pub rotation: Option<f64>,
    /// Covariance of (distance, rotation), in m², m·rad and rad², where both were measured by odometry.
    /// Bearings count as exact. A travel of no length has none: its distance has no direction to vary in.
    pub covariance: Option<[[f64; 2]; 2]>,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let deviation = |axis: usize| self.covariance.map(|matrix| matrix[axis][axis].max(0.0).sqrt());
        let mut parts = Vec::new();
        if let Some(distance) = self.distance {
            let deviation = deviation(0).map_or(String::new(), |deviation| format!(" ± {deviation:.2}"));
            parts.push(format!("{distance:.2}{deviation} m"));
        }
        if let Some(rotation) = self.rotation {
            let spread = deviation(1).map(f64::to_degrees);
            let spread = spread.map_or(String::new(), |deviation| format!(" ± {deviation:.1}"));
            // Rounded first: a tiny negative angle is no "-0.0".
            let degrees = (rotation.to_degrees() * 10.0).round() / 10.0 + 0.0;
            parts.push(format!("{degrees:.1}{spread}°"));
        }
        f.write_str(&parts.join(", "))
    }
}
