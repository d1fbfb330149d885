//! Commands to a differential drive, and how it is steered toward a point.

use super::Handling;

/// What a differential drive is told to do.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Command {
    /// Metres per second, forward.
    pub speed: f64,
    /// Radians per second, counterclockwise.
    pub turn: f64,
}

impl Command {
    /// Stand still.
    pub const REST: Command = Command { speed: 0.0, turn: 0.0 };

    /// Turn on the spot toward a bearing; always to the left toward what is behind, so that nothing behind
    /// makes the robot waver.
    pub(super) fn face(bearing: f64, handling: &Handling) -> Command {
        /// From this bearing on, in radians, something is behind.
        const BEHIND: f64 = 2.6;
        let turn = if bearing.abs() > BEHIND { handling.turn } else { 2.0 * bearing };
        Command { speed: 0.0, turn: turn.clamp(-handling.turn, handling.turn) }
    }

    /// Drive to a point on a circle that the present heading touches; toward what is far to the side turn on
    /// the spot first. No faster than `speed`.
    pub(super) fn toward(point: [f64; 2], speed: f64, handling: &Handling) -> Command {
        let bearing = point[1].atan2(point[0]);
        if bearing.abs() > handling.widest_curve {
            return Command::face(bearing, handling);
        }
        let curvature = 2.0 * bearing.sin() / point[0].hypot(point[1]);
        let speed = speed.min(handling.turn / curvature.abs().max(f64::MIN_POSITIVE));
        Command { speed, turn: speed * curvature }
    }
}
