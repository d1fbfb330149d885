//! A whole log in memory: its scans, and the raw trajectory between them.

use std::collections::BTreeMap;

use hssh_metrics::Pose;

use super::error::LogWarning;
use super::position::LogPosition;
use super::turn::LaserTurn;
use crate::scan::Scan;

/// A scan and where it was taken.
#[derive(Clone, PartialEq, Debug)]
pub struct LoggedScan {
    /// The scan, with what did not come back as infinite.
    pub scan: Scan,
    /// Where raw odometry believed the laser to be.
    pub odometry: Pose,
    /// The same moment's position in [`LaserLog::trajectory`].
    pub moment: usize,
    /// The pose after somebody's scan matching, or the raw one where nobody did any. For scoring only: no part of the mapper looks at it, but for the laser's
    /// place on the robot, which logs that nobody corrected tell by it.
    pub corrected: Pose,
    /// Where in the log it stands.
    pub at: LogPosition,
    /// When it was taken, in seconds of the recording program's clock, if the log says so.
    pub time: Option<f64>,
}

/// What a log holds for a mapper.
#[derive(Clone, PartialEq, Debug)]
pub struct LaserLog {
    /// The scans in order; at least one. Each has its own beams.
    pub scans: Vec<LoggedScan>,
    /// All raw odometry of the laser in order, that of the scans included. Where it jumped, the jump is taken out, and a
    /// detour says how little is known of that step.
    pub trajectory: Vec<Pose>,
    /// Metres from which on a range meant that nothing came back.
    pub max_range: f64,
    /// How many messages of kinds that are not read, by kind; comments are `#`.
    pub skipped: BTreeMap<String, u64>,
    /// Whether the robot drove straight on, and nothing that it saw there tells whether its laser looks ahead, as is taken for
    /// granted, or back.
    pub is_facing_unclear: bool,
    /// Whether who read the log said where its laser sits: what scans show does not count against that.
    pub is_laser_given: bool,
    /// By how much the odometry was turned with the laser, because scans show it; `None` if it is as the log has it.
    pub laser_turn: Option<LaserTurn>,
    /// What was passed over.
    pub warnings: Vec<LogWarning>,
}

impl LaserLog {
    /// The log as if it ended with its scan number `scans`, counted from 1.
    #[must_use]
    pub fn beginning(&self, scans: usize) -> Self {
        let scans = self.scans[..scans.min(self.scans.len())].to_vec();
        let moments = scans.last().map_or(0, |last| last.moment + 1);
        LaserLog { scans, trajectory: self.trajectory[..moments].to_vec(), ..self.clone() }
    }

    /// The log with its odometry taken to be that of a laser that is turned so much on the robot.
    #[must_use]
    pub fn turned(mut self, turn: LaserTurn) -> Self {
        let by = Pose::new(0.0, 0.0, turn.angle);
        for pose in &mut self.trajectory {
            *pose = pose.compose(by);
        }
        for scan in &mut self.scans {
            scan.odometry = scan.odometry.compose(by);
        }
        self.laser_turn = Some(turn);
        self
    }

    /// Number of beams of most scans.
    #[must_use]
    pub fn beams(&self) -> usize {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for logged in &self.scans {
            *counts.entry(logged.scan.ranges.len()).or_default() += 1;
        }
        counts.into_iter().max_by_key(|&(beams, scans)| (scans, beams)).map_or(0, |(beams, _)| beams)
    }
}
