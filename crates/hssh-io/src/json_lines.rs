//! Scans and odometry as JSON, one object a line: what is easily written by a few lines of a program on the robot.
//!
//! ```text
//! {"time": 0.05, "pose": [0.0, 0.0, 0.0]}
//! {"time": 0.10, "pose": [0.1, 0.0, 0.0], "angle_min": -1.57, "angle_increment": 0.0175, "range_max": 30, "ranges": [1.25, null, 2.75]}
//! ```
//!
//! Seconds, metres, radians. A pose is the robot's as its odometry believes it: x, y, θ. A line with ranges is a scan; it may
//! come without a pose, between lines that have one. Without both angles, the ranges span the view that the caller
//! says. A range that is null, not positive, or not less than `range_max`, says that nothing came back; so do the words
//! `NaN` and `Infinity`, which are no JSON and which Python writes all the same. Other fields are passed over.

use std::io::{self, BufRead};

use hssh_local::{LaserLog, LogError, LogWarning, RecordedScan, Recording, Scan, TimedPose};
use hssh_metrics::Pose;
use serde::Deserialize;

use crate::laser::KnownLaser;

/// No line is longer, in bytes.
const LONGEST_LINE: u64 = 1 << 22;
/// No time or place is farther off, in seconds or metres.
const FARTHEST: f64 = 1e11;
/// No laser turns more often than this in a scan: radians.
const WIDEST: f64 = 13.0;

/// Why lines of JSON are no log.
#[derive(Debug, thiserror::Error)]
pub enum JsonLinesError {
    /// The file cannot be read.
    #[error("cannot read on at line {line}: {error}")]
    Read {
        /// The line, counted from 1.
        line: u64,
        /// Why not.
        error: io::Error,
    },
    /// No line is a scan.
    #[error(
        "none of {lines} lines is a scan, as {{\"time\": …, \"pose\": [x, y, θ], \"ranges\": […]}}{}",
        first.as_ref().map(|first| format!("; {first}")).unwrap_or_default()
    )]
    NoScan {
        /// How many lines there are.
        lines: u64,
        /// What is wrong with the first line that is none of these.
        first: Option<String>,
    },
    /// The log that it makes cannot be used.
    #[error(transparent)]
    Log(#[from] LogError),
}

/// A line.
#[derive(Deserialize)]
struct Record {
    time: f64,
    pose: Option<[f64; 3]>,
    ranges: Option<Vec<Option<f64>>>,
    angle_min: Option<f64>,
    angle_increment: Option<f64>,
    range_max: Option<f64>,
}

/// Lines that were left out for one reason: how many, and the first.
#[derive(Clone, PartialEq, Debug)]
struct LeftOut {
    lines: u64,
    first: String,
}

/// Scans and odometry as their lines come.
#[derive(Clone, PartialEq, Debug)]
pub struct JsonLines {
    laser: KnownLaser,
    recording: Recording,
    lines: u64,
    unreadable: Option<LeftOut>,
    back: Option<LeftOut>,
}

/// Whether a text's first line is of this kind.
#[must_use]
pub fn is_json_lines(line: &str) -> bool {
    let line = line.trim();
    let is_record = |line: &str| ["\"ranges\"", "\"pose\""].iter().any(|key| line.contains(key));
    line.starts_with('{') && line.contains("\"time\"") && is_record(line)
}

/// Reads lines of JSON as a laser log. What is no record is left out with a warning.
///
/// # Errors
/// If it cannot be read, at its line, or if there is no scan in it that can be used.
pub fn read_json_lines(mut source: impl BufRead, laser: &KnownLaser) -> Result<LaserLog, JsonLinesError> {
    let mut lines = JsonLines::new(*laser);
    while let Some(line) = next_line(&mut source, lines.lines + 1)? {
        lines.add(&line);
    }
    lines.into_log()
}

/// The next line of a source, which has that number; `None` at its end.
///
/// # Errors
/// If it cannot be read.
pub fn next_line(source: &mut impl BufRead, line: u64) -> Result<Option<String>, JsonLinesError> {
    let mut bytes = Vec::new();
    let read = io::Read::take(source, LONGEST_LINE).read_until(b'\n', &mut bytes);
    let count = read.map_err(|error| JsonLinesError::Read { line, error })?;
    Ok((count > 0).then(|| String::from_utf8_lossy(&bytes).into_owned()))
}

impl JsonLines {
    /// No line yet, of a laser of which something may be known.
    #[must_use]
    pub fn new(laser: KnownLaser) -> Self {
        let at = laser.pose.unwrap_or_default();
        let is_laser_given = laser.pose.is_some();
        let recording = Recording { laser: [at.x, at.y], is_laser_given, ..Recording::default() };
        JsonLines { laser, recording, lines: 0, unreadable: None, back: None }
    }

    /// Adds a line.
    pub fn add(&mut self, text: &str) {
        self.lines += 1;
        let text = text.trim();
        if text.is_empty() {
            return;
        }
        match self.record(text) {
            Ok(record) => self.take(record),
            Err(problem) => leave_out(&mut self.unreadable, || format!("line {}: {problem}", self.lines)),
        }
    }

    /// How many scans have come.
    #[must_use]
    pub fn scans(&self) -> usize {
        self.recording.scans.len()
    }

    /// The log of what has come so far and is settled: a scan is when odometry of a later time has come.
    ///
    /// # Errors
    /// If there is no scan that can be used.
    pub fn log(&self) -> Result<LaserLog, JsonLinesError> {
        let mut settled = self.clone();
        settled.recording.drop_unsettled();
        settled.into_log()
    }

    /// The log of all lines.
    ///
    /// # Errors
    /// If there is no scan that can be used.
    pub fn into_log(mut self) -> Result<LaserLog, JsonLinesError> {
        if self.recording.scans.is_empty() {
            let first = self.unreadable.map(|unreadable| unreadable.first);
            return Err(JsonLinesError::NoScan { lines: self.lines, first });
        }
        for LeftOut { lines, first } in [self.unreadable, self.back].into_iter().flatten() {
            let text = format!("{first}: left out, {lines} lines in all");
            self.recording.warnings.push(LogWarning::Remark { text, is_loss: true });
        }
        Ok(LaserLog::from_recording(self.recording)?)
    }

    fn record(&self, text: &str) -> Result<Record, String> {
        let is_plain = !["NaN", "Infinity"].iter().any(|word| text.contains(word));
        let read = if is_plain {
            serde_json::from_str(text)
        } else {
            serde_json::from_str(
                &text.replace("-Infinity", "null").replace("Infinity", "null").replace("NaN", "null"),
            )
        };
        let record: Record = read.map_err(|error| {
            // The line that serde counts is always the first.
            let error = error.to_string();
            error.split(" at line ").next().unwrap_or_default().to_owned()
        })?;
        let is_sane = |number: &f64| number.is_finite() && number.abs() < FARTHEST;
        if !is_sane(&record.time) {
            return Err("the time is no finite number of seconds".to_owned());
        }
        if record.pose.is_some_and(|pose| !pose.iter().all(is_sane)) {
            return Err("the pose has numbers that are none".to_owned());
        }
        let is_angle = |angle: &f64| angle.abs() <= WIDEST;
        if record.angle_min.is_some_and(|angle| !is_angle(&angle))
            || record.angle_increment.is_some_and(|angle| !is_angle(&angle) || angle == 0.0)
        {
            return Err("an angle is no angle in radians, or 0 between beams".to_owned());
        }
        if record.pose.is_none() && record.ranges.as_ref().is_none_or(Vec::is_empty) {
            return Err("neither `pose` nor `ranges`".to_owned());
        }
        Ok(record)
    }

    fn take(&mut self, record: Record) {
        let Record { time, pose, .. } = record;
        let last_scan = self.recording.scans.last().map(|scan| scan.time);
        let last_pose = self.recording.odometry.last().map(|last| last.time);
        let is_back = |last: Option<f64>| last.is_some_and(|last| time < last);
        let is_scan = record.ranges.as_ref().is_some_and(|ranges| !ranges.is_empty());
        if (pose.is_some() && is_back(last_pose)) || (is_scan && is_back(last_scan)) {
            leave_out(&mut self.back, || format!("line {}: time runs backwards", self.lines));
            return;
        }
        if let Some([x, y, theta]) = pose {
            self.recording.odometry.push(TimedPose { time, pose: Pose::new(x, y, theta) });
        }
        if is_scan {
            let scan = self.scan(record);
            self.recording.scans.push(RecordedScan { scan, time });
        }
    }

    fn scan(&self, record: Record) -> Scan {
        let limit = record.range_max.filter(|limit| *limit > 0.0).unwrap_or(f64::INFINITY);
        let came_back = |range: Option<f64>| {
            range.filter(|range| *range > 0.0 && *range < limit).unwrap_or(f64::INFINITY)
        };
        let mut ranges: Vec<f64> = record.ranges.unwrap_or_default().into_iter().map(came_back).collect();
        let steps = (ranges.len() - ranges.len() % 2) as f64;
        let turn = self.laser.pose.map_or(0.0, |pose| pose.theta);
        let (view, middle) = match (record.angle_min, record.angle_increment) {
            (Some(first), Some(step)) => {
                let last = first + step * (ranges.len() as f64 - 1.0);
                // Beams are counted from the right, as angles grow.
                if step < 0.0 {
                    ranges.reverse();
                }
                (step.abs() * steps, first.min(last) + step.abs() * steps / 2.0)
            }
            _ => (self.laser.view.unwrap_or(std::f64::consts::PI), 0.0),
        };
        Scan { ranges, view, turn: middle + turn }
    }
}

fn leave_out(left_out: &mut Option<LeftOut>, first: impl FnOnce() -> String) {
    match left_out {
        Some(known) => known.lines += 1,
        None => *left_out = Some(LeftOut { lines: 1, first: first() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<LaserLog, JsonLinesError> {
        read_json_lines(text.as_bytes(), &KnownLaser::default())
    }

    #[test]
    fn lines_are_a_log() {
        let text = r#"
            {"time": 0.0, "pose": [0, 0, 0]}
            {"time": 0.5, "ranges": [1.5, null, 2, 8.0], "angle_min": -0.5, "angle_increment": 0.5, "range_max": 8, "seq": 7}
            {"time": 1.0, "pose": [1, 0, 0], "ranges": [1.0, NaN, Infinity, 3.0], "angle_min": 1.0, "angle_increment": -0.5}
        "#;
        let log = read(text).unwrap();
        let [first, second] = &log.scans[..] else { panic!("{log:?}") };
        assert_eq!(first.scan.ranges, [1.5, f64::INFINITY, 2.0, f64::INFINITY]);
        assert_eq!((first.odometry.x, first.time), (0.5, Some(0.5)));
        let bearings = |scan: &Scan| (0..4).map(|beam| scan.bearing(beam)).collect::<Vec<_>>();
        assert_eq!(bearings(&first.scan), [-0.5, 0.0, 0.5, 1.0]);
        assert_eq!(second.scan.ranges, [3.0, f64::INFINITY, f64::INFINITY, 1.0]);
        assert_eq!(bearings(&second.scan), [-0.5, 0.0, 0.5, 1.0]);
    }

    #[test]
    fn what_is_no_record_is_left_out_and_told() {
        let scan = |time: u32| format!("{{\"time\": {time}, \"pose\": [0, 0, 0], \"ranges\": [1, 2, 3]}}\n");
        let text = scan(1) + "{\"time\": 2}\nnonsense\n" + &scan(0) + &scan(3);
        let log = read(&text).unwrap();
        assert_eq!(log.scans.len(), 2);
        let told: Vec<String> = log.warnings.iter().map(ToString::to_string).collect();
        assert!(told[0].starts_with("line 2: neither `pose` nor `ranges`: left out, 2 lines"), "{told:?}");
        assert!(told[1].starts_with("line 4: time runs backwards: left out, 1 lines"), "{told:?}");
        let none = read("{\"time\": 2, \"pose\": [0, 0]}").unwrap_err().to_string();
        assert!(
            none.contains("none of 1 lines is a scan") && none.contains("line 1: invalid length 2"),
            "{none}"
        );
    }

    /// While a robot drives, a scan waits for the odometry behind it.
    #[test]
    fn what_has_come_is_a_log_at_any_time() {
        let mut lines = JsonLines::new(KnownLaser::default());
        lines.add("{\"time\": 0, \"pose\": [0, 0, 0], \"ranges\": [1, 2, 3]}");
        lines.add("{\"time\": 1, \"ranges\": [1, 2, 3]}");
        assert_eq!((lines.scans(), lines.log().unwrap().scans.len()), (2, 1));
        lines.add("{\"time\": 2, \"pose\": [2, 0, 0]}");
        let log = lines.log().unwrap();
        assert_eq!(log.scans.iter().map(|scan| scan.odometry.x).collect::<Vec<_>>(), [0.0, 1.0]);
    }

    #[test]
    fn they_are_known_by_their_first_line() {
        assert!(is_json_lines("{\"time\": 1, \"pose\": [0, 0, 0]}"));
        assert!(!is_json_lines("{\"format\": \"hssh-answer\"}") && !is_json_lines("time,x,y"));
    }
}
