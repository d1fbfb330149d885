//! Trajectory-following: along the midline of a corridor, and out of a place by a gateway (section 2.1.1).

use super::view::View;
use super::{Command, Exit, Handling, Percept};

/// The directions that are compared, on either side.
const DIRECTIONS: i32 = 24;
/// What a radian of turning costs, in metres of clearance: enough to go straight on where all is alike.
const TURNING: f64 = 0.05;

/// How far to either side of where it wants to go the robot looks for room, in radians.
const AROUND_CORNERS: f64 = 1.0;

/// Goes on along the ridge of the clearance: the midline, which is as far from what is at the left as from
/// what is at the right.
pub(super) fn follow_midline(percept: &Percept, width: f64, handling: &Handling) -> Command {
    along(percept, 0.0, 45_f64.to_radians(), width, handling)
}

/// Goes to a gateway, and through it.
pub(super) fn leave(percept: &Percept, gateway: &Exit, handling: &Handling) -> Command {
    let [x, y] = gateway.position;
    let beyond = -(x * gateway.bearing.cos() + y * gateway.bearing.sin());
    if beyond > -handling.look_ahead / 2.0 {
        return along(percept, gateway.bearing, AROUND_CORNERS, gateway.width, handling);
    }
    along(percept, y.atan2(x), AROUND_CORNERS, gateway.width, handling)
}

/// Goes about in a direction, around what is in the way.
pub(super) fn toward(percept: &Percept, bearing: f64, handling: &Handling) -> Command {
    let width = 2.0 * (handling.radius + handling.margin);
    along(percept, bearing, AROUND_CORNERS, width, handling)
}

/// Whether there is no room ahead, sixty degrees to either side.
pub(super) fn is_blocked(percept: &Percept, handling: &Handling) -> bool {
    let view = View::new(percept);
    let room = |step: i32| {
        let (sin, cos) = (f64::from(step) * 5_f64.to_radians()).sin_cos();
        view.clearance_at([handling.look_ahead * cos, handling.look_ahead * sin])
    };
    (-12..=12).all(|step| room(step) < handling.radius + handling.margin)
}

/// Goes where, about as far ahead as the robot looks, there is most room, `arc` to either side of a bearing.
fn along(percept: &Percept, bearing: f64, arc: f64, width: f64, handling: &Handling) -> Command {
    if bearing.abs() > handling.widest_curve {
        return Command::face(bearing, handling);
    }
    let view = View::new(percept);
    // More room than in the middle of the corridor attracts nobody: openings along the way are passed by.
    let enough = width / 2.0;
    let point =
        |direction: f64| [handling.look_ahead * direction.cos(), handling.look_ahead * direction.sin()];
    let merit = |direction: f64| {
        view.clearance_at(point(direction)).min(enough) - TURNING * (direction - bearing).abs()
    };
    let directions = (-DIRECTIONS..=DIRECTIONS)
        .map(|step| bearing + arc * f64::from(step) / f64::from(DIRECTIONS))
        .map(|direction| (merit(direction), direction));
    let best = directions.reduce(|best, other| if other.0 > best.0 { other } else { best });
    let (_, direction) = best.unwrap_or((0.0, bearing));
    let room = percept.ahead(handling.radius + handling.margin) - handling.radius - handling.margin;
    if room <= 0.0 {
        return Command::face(direction, handling);
    }
    Command::toward(point(direction), handling.speed.min(room), handling)
}
