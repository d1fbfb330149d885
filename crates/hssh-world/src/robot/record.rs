//! What a drive leaves: the lines of its log, where the robot stopped, and how it ended.

use std::fmt;

use hssh_causal::control::ControlLaw;
use hssh_local::PlaceNumber;
use hssh_metrics::Pose;
use hssh_topology::Olp;

/// A line of the log with the truth.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// Seconds since the start.
    pub time: f64,
    /// Where the robot was, in the frame of the grid.
    pub pose: Pose,
    /// Where its odometry believed it was; it starts at the origin.
    pub odometry: Pose,
    /// What its laser saw, if it was logged: from right to left, infinite where nothing came back.
    pub scan: Option<Vec<f64>>,
}

/// A distinctive state: where hill-climbing ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stop {
    /// The place whose center is nearest, if the robot is within its clearance.
    pub place: Option<PlaceNumber>,
    /// The place that it meant to reach; none where it started.
    pub meant: Option<PlaceNumber>,
    /// Where it stopped, in the frame of the grid.
    pub pose: Pose,
    /// Metres from the place's center.
    pub off_center: Option<f64>,
    /// By which end of the place's star it went on; none at the last stop.
    pub exit: Option<Olp>,
    /// The moment of the log when it was there.
    pub moment: usize,
}

/// How a drive ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ending {
    /// All that was asked for was done.
    Done,
    /// As many travels as were allowed were made before all was done; what is left, connections not travelled or places
    /// of the list not visited.
    OutOfTravels(usize),
    /// Nobody knows a way on: the robot is at none of the map's places, or not next to the place asked for.
    NoWayOn,
    /// A control law did not apply, or did not end.
    Lost(ControlLaw),
    /// The robot would have run into something.
    Collision,
    /// Somebody stopped it.
    Interrupted,
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Ending::Done => write!(f, "everything that was asked for was done"),
            Ending::OutOfTravels(left) => {
                write!(f, "the travels it was allowed are used up, and {left} more were asked for")
            }
            Ending::Interrupted => write!(f, "the drive was interrupted; its log is that of the way so far"),
            Ending::NoWayOn => write!(f, "no way on is known from where the robot centered itself"),
            Ending::Lost(ControlLaw::Leave { .. }) => write!(f, "the robot did not get out of a place"),
            Ending::Lost(ControlLaw::FollowMidline { .. }) => {
                write!(f, "the robot found no next place along a corridor")
            }
            Ending::Lost(ControlLaw::HillClimb) => write!(f, "the robot found no place to center in"),
            Ending::Collision => write!(f, "the robot would have run into something"),
        }
    }
}
