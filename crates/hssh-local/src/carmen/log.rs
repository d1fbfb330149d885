//! A whole log in memory: its scans, and the raw trajectory between them.

use std::collections::BTreeMap;
use std::io::Read;

use hssh_metrics::Pose;

use super::error::{LogError, LogWarning, MessageProblem};
use super::message::{LaserMessage, Message};
use super::reader::LogReader;
use crate::scan::Scan;

/// The parameter that says from which range on a laser saw nothing.
const FRONT_LASER_MAX: &str = "robot_front_laser_max";
/// That range where the log does not say, in metres. Logs write nothing as 50, 80 or 81.9; no laser of
/// their time saw a wall at 50 m.
const DEFAULT_MAX_RANGE: f64 = 50.0;

/// A scan and where it was taken.
#[derive(Clone, PartialEq, Debug)]
pub struct LoggedScan {
    /// The scan, with what did not come back as infinite.
    pub scan: Scan,
    /// Where raw odometry believed the robot to be.
    pub odometry: Pose,
    /// The same moment's position in [`LaserLog::trajectory`].
    pub moment: usize,
    /// The pose after somebody's scan matching. For scoring only: no part of the mapper looks at it.
    pub corrected: Pose,
    /// The line of the log, counted from 1.
    pub line: u64,
    /// When it was taken, in seconds of the recording program's clock, if the log says so.
    pub time: Option<f64>,
}

/// What a log holds for a mapper.
#[derive(Clone, PartialEq, Debug)]
pub struct LaserLog {
    /// The scans in order; at least one, all with the same number of beams.
    pub scans: Vec<LoggedScan>,
    /// All raw odometry in order, that of the scans included.
    pub trajectory: Vec<Pose>,
    /// Metres from which on a range meant that nothing came back.
    pub max_range: f64,
    /// How many messages of kinds that are not read, by kind; comments are `#`.
    pub skipped: BTreeMap<String, u64>,
    /// What was passed over.
    pub warnings: Vec<LogWarning>,
}

impl LaserLog {
    /// Reads a log, plain or gzip. Messages that cannot be used are left out with a warning; a log that
    /// breaks off is used up to there.
    ///
    /// # Errors
    /// If the source cannot be read, is no text, is empty, or has no usable scan.
    pub fn read(source: impl Read) -> Result<Self, LogError> {
        let mut reader = LogReader::new(source)?;
        let mut log = LaserLog {
            scans: Vec::new(),
            trajectory: Vec::new(),
            max_range: DEFAULT_MAX_RANGE,
            skipped: BTreeMap::new(),
            warnings: Vec::new(),
        };
        while let Some(message) = reader.next_message()? {
            match message {
                Message::Laser(laser) => {
                    if let Err(problem) = log.add_scan(laser, reader.line()) {
                        reader.warn("FLASER", problem);
                    }
                }
                Message::Odometry(pose) => log.trajectory.push(pose),
                Message::Parameter { name, value } => log.set_parameter(&name, &value),
                Message::Other(kind) => *log.skipped.entry(kind).or_default() += 1,
            }
        }
        let lines = reader.line();
        log.warnings = reader.into_warnings();
        if log.scans.is_empty() { Err(log.why_useless(lines)) } else { Ok(log) }
    }

    /// Number of beams of a scan.
    #[must_use]
    pub fn beams(&self) -> usize {
        self.scans.first().map_or(0, |scan| scan.scan.ranges.len())
    }

    fn add_scan(&mut self, laser: LaserMessage, line: u64) -> Result<(), MessageProblem> {
        let (found, expected) = (laser.ranges.len(), self.beams());
        if expected != 0 && found != expected {
            return Err(MessageProblem::OtherBeamCount { found, expected });
        }
        let max_range = self.max_range;
        let came_back = |range: f64| if range > 0.0 && range < max_range { range } else { f64::INFINITY };
        self.scans.push(LoggedScan {
            scan: Scan { ranges: laser.ranges.into_iter().map(came_back).collect() },
            odometry: laser.odometry,
            moment: self.trajectory.len(),
            corrected: laser.corrected,
            line,
            time: laser.time,
        });
        self.trajectory.push(laser.odometry);
        Ok(())
    }

    fn set_parameter(&mut self, name: &str, value: &str) {
        if name == FRONT_LASER_MAX
            && let Ok(metres) = value.parse::<f64>()
            && metres.is_finite()
            && metres > 0.0
        {
            self.max_range = metres;
        }
    }

    fn why_useless(self, lines: u64) -> LogError {
        if lines == 0 {
            return LogError::Empty;
        }
        let mut kinds: Vec<String> = Vec::new();
        if !self.trajectory.is_empty() {
            kinds.push(format!("{} ODOM", self.trajectory.len()));
        }
        let other = self.skipped.iter().filter(|(kind, _)| !kind.is_empty() && *kind != "#").take(5);
        kinds.extend(other.map(|(kind, count)| format!("{count} `{}`", kind.escape_debug())));
        let messages = if kinds.is_empty() { "no message".to_owned() } else { kinds.join(", ") };
        LogError::NoScans { lines, messages, first_warning: self.warnings.into_iter().next() }
    }
}
