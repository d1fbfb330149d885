//! The corrected odometry of a laser log: where every scan was taken.

use std::fmt;

use hssh_local::LaserTurn;
use hssh_metrics::Pose;
use serde::{Deserialize, Serialize};

use crate::answer::{AnswerWarning, counted};
use crate::pipeline::TrackedLog;

/// The robot's way along a log by matching scan with scan; metres and radians in the frame of the first scan.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct TrackAccount {
    /// `hssh-track`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The log, as it was given.
    pub name: String,
    /// Why the track may well be wrong, if it may.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// How many laser scans the log has.
    pub scans: u64,
    /// How many of them can be used.
    pub scans_used: u64,
    /// Beams of a scan.
    pub beams: u64,
    /// How far the robot went, by the track.
    pub metres: f64,
    /// The last scan's pose as raw odometry has it from the first.
    pub raw_end: Pose,
    /// The same as the track has it.
    pub end: Pose,
    /// How well the track knows that: standard deviations of x, y and θ; absent if it is hardly known at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_sigma: Option<[f64; 3]>,
    /// By how much the laser seems to be turned to the left against the odometry, and the standard deviation of that: radians;
    /// absent if the robot hardly went straight ahead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub laser_turn: Option<[f64; 2]>,
    /// The scans that can be used.
    pub poses: Vec<TrackedPose>,
    /// What was left out, or where the robot is lost.
    pub warnings: Vec<AnswerWarning>,
}

/// Where a scan was taken.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct TrackedPose {
    /// Its number among all scans of the log, counted from 0.
    pub scan: u64,
    /// Seconds of the recording program's clock; absent if the log does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians.
    pub theta: f64,
}

impl TrackAccount {
    /// The account of a tracked log.
    #[must_use]
    pub fn new(name: &str, tracked: &TrackedLog) -> Self {
        let (log, scans) = (&tracked.log, &tracked.track.scans);
        let warnings = tracked.warnings();
        let pose = |(used, scan): (usize, &hssh_local::TrackedScan)| TrackedPose {
            scan: tracked.scan_number(used),
            time: log.scans[used].time,
            x: scan.pose.x,
            y: scan.pose.y,
            theta: scan.pose.theta,
        };
        let last = scans.len().saturating_sub(1);
        let whole = tracked.track.motion(0, last).ok().flatten();
        let sigma = |variance: f64| variance.max(0.0).sqrt();
        TrackAccount {
            format: "hssh-track".to_owned(),
            version: 1,
            name: name.to_owned(),
            doubt: warnings.iter().find(|warning| warning.is_serious()).map(AnswerWarning::to_string),
            scans: tracked.scans(),
            scans_used: log.scans.len() as u64,
            beams: log.beams() as u64,
            metres: scans.last().map_or(0.0, |scan| scan.travelled),
            raw_end: log.scans[0].odometry.between(log.scans[last].odometry),
            end: scans[last].pose,
            end_sigma: whole.map(|whole| {
                let variances = whole.covariance.matrix().diagonal();
                [0, 1, 2].map(|axis| sigma(variances[axis]))
            }),
            laser_turn: log
                .laser_turn
                .or_else(|| LaserTurn::of(log, &tracked.track))
                .map(|turn| [turn.angle, turn.sigma]),
            poses: scans.iter().enumerate().map(pose).collect(),
            warnings,
        }
    }
}

impl fmt::Display for TrackAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(doubt) = &self.doubt {
            writeln!(f, "DOUBTFUL: {doubt}")?;
        }
        writeln!(
            f,
            "{}: {} of {} beams, {:.0} m",
            self.name,
            counted(self.scans_used as usize, "scan"),
            self.beams,
            self.metres
        )?;
        for (name, end) in [("raw odometry", self.raw_end), ("the track", self.end)] {
            let degrees = end.theta.to_degrees();
            writeln!(
                f,
                "  {name:<13} ends at {:.2}, {:.2} m, {degrees:.1}° from where it began",
                end.x, end.y
            )?;
        }
        if let Some([angle, sigma]) = self.laser_turn.map(|radians| radians.map(f64::to_degrees)) {
            writeln!(
                f,
                "  the laser is turned by {angle:.2}° ± {sigma:.2}° to the left against the odometry"
            )?;
        }
        match self.end_sigma {
            Some([x, y, theta]) => {
                let degrees = theta.to_degrees();
                writeln!(
                    f,
                    "  that is known up to {x:.2} m, {y:.2} m and {degrees:.1}° (standard deviations)"
                )
            }
            None => writeln!(f, "  that is hardly known at all"),
        }
    }
}
