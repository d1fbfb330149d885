//! What can be wrong with a survey.

use hssh_causal::ExplorationError;
use hssh_metrics::UncertaintyError;

use crate::carmen::LaserTurn;
use crate::closing::ClosingError;
use crate::grid::LatticeError;

/// Something that a survey had to decide with little reason.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SurveyWarning {
    /// A match that the rest of the log contradicts.
    #[error(
        "scan {scan}: what it shows looks like what scan {earlier} showed, and the rest of the log contradicts that; \
         it was left out"
    )]
    Contradicted {
        /// The later scan, counted from 1.
        scan: usize,
        /// The earlier one, counted from 1.
        earlier: usize,
    },
    /// A return that no match confirms.
    #[error(
        "scan {scan}: the robot seems to be back where scan {earlier} was taken, and what the laser shows does not \
         confirm it"
    )]
    Unconfirmed {
        /// The later scan, counted from 1.
        scan: usize,
        /// The earlier one, counted from 1.
        earlier: usize,
    },
    /// A return that may be one, and may be none.
    #[error(
        "scan {scan}: the robot may be back where scan {earlier} was taken, for it looks the same there, but other places nearby do, \
         too, and where the robot is is not known well enough to tell"
    )]
    Possible {
        /// The later scan, counted from 1.
        scan: usize,
        /// The earlier one, counted from 1.
        earlier: usize,
    },
    /// Scans that lie on nothing.
    #[error(
        "scans {first} to {last} lie on nothing that was seen before, wherever they are put: the robot is lost there, \
         its odometry is wrong, or scans are missing"
    )]
    Lost {
        /// The first of them, counted from 1.
        first: usize,
        /// The last of them, counted from 1.
        last: usize,
    },
    /// A scan that lies on nothing, and nothing after it on what was before.
    #[error(
        "scan {scan} lies on nothing that was seen before, and the robot never came back from there to where it had been: how the two parts of \
         the log lie to one another, the odometry alone says"
    )]
    Break {
        /// The scan, counted from 1.
        scan: usize,
    },
    /// The same where the odometry jumps.
    #[error(
        "scan {scan} lies on nothing that was seen before, the odometry jumps there, and the robot never came back to where it had been: are these \
         recordings of several places, or was the robot carried? how the parts of the log lie to one another is not known"
    )]
    Carried {
        /// The scan, counted from 1.
        scan: usize,
    },
    /// Odometry that stands still.
    #[error("the log has no odometry: it stands still while the scans move, and scans alone lose their way")]
    NoOdometry,
    /// Odometry that stands still for a while.
    #[error(
        "scans {first} to {last}: the odometry stands still while the scans move on by {metres:.1} m: did the wheels' counter stop? what the \
         log shows from there on may be in the wrong place"
    )]
    OdometryStands {
        /// The first of these scans, counted from 1.
        first: usize,
        /// The last of them, counted from 1.
        last: usize,
        /// How far the scans say that the robot went: metres.
        metres: f64,
    },
    /// A laser that sees less far than ways out have to lead.
    #[error(
        "the laser sees no farther than {reach:.1} m, and a way out has to lead {depth} m on: whether ways do is guessed, so that places may be \
         missing; say with --shallowest that shorter ways count, or use a laser that sees farther"
    )]
    ShortSighted {
        /// The longest range that came back: metres.
        reach: f64,
        /// How far a way out has to lead: metres.
        depth: f64,
    },
    /// A laser that is not where it was taken to be.
    #[error(
        "the laser seems to be turned by {:.1}° to the left (± {:.1}°) against the odometry: if it is, say so with --laser-pose, \
         for a track goes astray by that", .0.angle.to_degrees(), .0.sigma.to_degrees()
    )]
    LaserTurned(LaserTurn),
    /// A laser of which nobody said how it sits, and scans do.
    #[error(
        "the laser is turned by {:.1}° to the left (± {:.1}°) against the odometry, as straight stretches show: that is reckoned \
         with, unless --laser-pose says how it sits", .0.angle.to_degrees(), .0.sigma.to_degrees()
    )]
    TurnedWithLaser(LaserTurn),
    /// Somebody stopped it.
    #[error("the survey was interrupted: it is one of the first {scans} scans, with the loops found so far")]
    Interrupted {
        /// How many scans it is of.
        scans: usize,
    },
}

/// Why there is no survey or no exploration.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SurveyError {
    /// The options describe no local map.
    #[error("no local map can be made: {0}")]
    LocalMap(#[from] LatticeError),
    /// Loops that cannot be closed.
    #[error(transparent)]
    Closing(#[from] ClosingError),
    /// No place along the way.
    #[error(
        "no place was found along {metres:.0} m of way: nowhere are there other ways out than on and back; \
         a way out has to lead {depth} m on"
    )]
    NoPlaces {
        /// How far the robot travelled.
        metres: f64,
        /// How far a way out leads.
        depth: f64,
    },
    /// A way so long that its covariance is useless.
    #[error("the way from visit {visit} to the next cannot be measured: {problem}")]
    Motion {
        /// The visit, counted from 0.
        visit: usize,
        /// Why not.
        problem: UncertaintyError,
    },
    /// Nobody knows by which ends the robot went from one visit to the next.
    #[error("by which ways the robot went from visit {visit} to the next is not known")]
    NoWay {
        /// The visit, counted from 0.
        visit: usize,
    },
    /// The visits are no exploration.
    #[error("the visits make no exploration: {0}")]
    Exploration(#[from] ExplorationError),
}
