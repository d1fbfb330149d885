//! Tables: a line for each scan, with its time, the robot's odometry and the ranges.
//!
//! ```text
//! # angle_min: -1.5708        radians; without both angles the ranges span the view that the caller says
//! # angle_increment: 0.0175
//! time,x,y,theta,ranges
//! 0.0,0.0,0.0,0.0,1.25,1.30,inf,2.75
//! 0.1,0.2,0.0,0.0
//! ```
//!
//! Seconds, metres, radians. The line of names may be missing. A line without ranges is odometry between scans; a range
//! that is `inf`, `nan`, empty, 0 or negative says nothing. Fields are parted by commas, semicolons or tabs;
//! where semicolons part them, commas may be decimal.

use std::borrow::Cow;
use std::io::{self, BufRead};

use hssh_local::{LaserLog, LineEnds, LogError, LogWarning, RecordedScan, Recording, Scan, TimedPose};
use hssh_metrics::Pose;

use crate::laser::KnownLaser;

/// No line is longer, in bytes.
const LONGEST_LINE: usize = 1 << 22;
/// The columns before the ranges.
const COLUMNS: [&str; 4] = ["time", "x", "y", "theta"];

/// Why a table cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file cannot be read.
    #[error("cannot read on at line {line}: {error}")]
    Read {
        /// The line, counted from 1.
        line: u64,
        /// Why not.
        error: io::Error,
    },
    /// A field is no number.
    #[error("line {line}, column {column}: `{field}` is no {wanted}")]
    Field {
        /// The line, counted from 1.
        line: u64,
        /// The column, counted from 1.
        column: usize,
        /// What stands there.
        field: String,
        /// What should.
        wanted: &'static str,
    },
    /// The columns are others.
    #[error(
        "line {line}: the columns are `{found}`; a table has time,x,y,theta and then the ranges of the beams"
    )]
    Columns {
        /// The line, counted from 1.
        line: u64,
        /// What stands there.
        found: String,
    },
    /// A comment says angles that cannot be.
    #[error("line {line}: `{text}`: an angle in radians is needed, and none of 0 between beams")]
    Angle {
        /// The line, counted from 1.
        line: u64,
        /// What stands there.
        text: String,
    },
    /// A line ends where there should be a pose.
    #[error("line {line} has {found} fields: time,x,y,theta are needed at least")]
    Short {
        /// The line, counted from 1.
        line: u64,
        /// How many fields it has.
        found: usize,
    },
    /// The log that it makes cannot be used.
    #[error(transparent)]
    Log(#[from] LogError),
}

/// Whether a text's beginning is that of a table.
#[must_use]
pub fn is_table(line: &str) -> bool {
    let line = with_points(line);
    let fields: Vec<&str> = fields(&line).collect();
    let is_time = ["time", "t", "stamp", "timestamp"].contains(&fields[0].to_ascii_lowercase().as_str());
    let are_numbers =
        fields.len() > COLUMNS.len() && fields[..4].iter().all(|field| field.parse::<f64>().is_ok());
    (is_time && fields.len() > 1) || are_numbers
}

fn fields(line: &str) -> impl Iterator<Item = &str> {
    line.split([',', ';', '\t']).map(str::trim)
}

/// A line with points where it has decimal commas, as tables have whose fields are parted by semicolons: commas part fields only where all
/// ranges stand between the same two semicolons.
fn with_points(line: &str) -> Cow<'_, str> {
    let parted = || line.split(';');
    let is_decimal = line.contains(',')
        && line.contains(';')
        && (parted().count() > COLUMNS.len() + 1
            || parted().take(COLUMNS.len()).any(|field| field.contains(',')));
    if is_decimal { Cow::Owned(line.replace(',', ".")) } else { Cow::Borrowed(line) }
}

/// Reads a table as a laser log.
///
/// # Errors
/// If it cannot be read, at its line, or if there is no scan in it that can be used.
pub fn read_table(mut source: impl BufRead, laser: &KnownLaser) -> Result<LaserLog, TableError> {
    let mut table = Table::new(laser);
    let mut line = 0;
    let mut bytes = Vec::new();
    let mut ends = LineEnds::default();
    loop {
        bytes.clear();
        line += 1;
        let read = ends.read_line(&mut source, LONGEST_LINE, &mut bytes);
        read.map_err(|error| TableError::Read { line, error })?;
        if bytes.is_empty() {
            break;
        }
        table.add(line, String::from_utf8_lossy(&bytes).trim())?;
    }
    Ok(LaserLog::from_recording(table.recording())?)
}

struct Table {
    angles: [Option<f64>; 2],
    view: f64,
    turn: f64,
    recording: Recording,
    /// How often time runs backwards, and the first line where it does.
    back: Option<(u64, u64)>,
}

impl Table {
    fn new(laser: &KnownLaser) -> Self {
        let pose = laser.pose.unwrap_or_default();
        Table {
            angles: [None; 2],
            view: laser.view.unwrap_or(std::f64::consts::PI),
            turn: pose.theta,
            recording: Recording {
                laser: [pose.x, pose.y],
                is_laser_given: laser.pose.is_some(),
                ..Recording::default()
            },
            back: None,
        }
    }

    fn add(&mut self, line: u64, text: &str) -> Result<(), TableError> {
        if let Some(comment) = text.strip_prefix('#') {
            return self.comment(line, comment.trim());
        }
        if text.is_empty() {
            return Ok(());
        }
        let text = with_points(text);
        let fields: Vec<&str> = fields(&text).collect();
        if self.recording.odometry.is_empty()
            && fields[0].starts_with(|c: char| c.is_ascii_alphabetic())
            && fields[0] != "nan"
        {
            let are_known = fields.iter().zip(COLUMNS).all(|(field, name)| {
                field.to_ascii_lowercase().starts_with(&name[..1])
                    || (name == "theta" && *field == "yaw")
                    || (name == "time" && *field == "stamp")
            });
            let found = text.chars().take(40).collect();
            return if are_known && fields.len() >= 4 {
                Ok(())
            } else {
                Err(TableError::Columns { line, found })
            };
        }
        if fields.len() < COLUMNS.len() {
            return Err(TableError::Short { line, found: fields.len() });
        }
        let mut pose = [0.0; 4];
        for (column, number) in pose.iter_mut().enumerate() {
            let value =
                fields[column].parse().ok().filter(|value: &f64| value.is_finite() && value.abs() < 1e11);
            *number = value.ok_or_else(|| field(line, column, fields[column], "finite number"))?;
        }
        let [time, x, y, theta] = pose;
        let last = self.recording.odometry.last().map_or(f64::NEG_INFINITY, |last| last.time);
        if time < last {
            let (count, _) = self.back.get_or_insert((0, line));
            *count += 1;
            return Ok(());
        }
        self.recording.odometry.push(TimedPose { time, pose: Pose::new(x, y, theta) });
        let mut ranges = Vec::with_capacity(fields.len() - 4);
        for (index, text) in fields[4..].iter().enumerate() {
            let range = if text.is_empty() { Some(f64::INFINITY) } else { text.parse::<f64>().ok() };
            let range =
                range.ok_or_else(|| field(line, index + 4, text, "range in metres, nor inf, nor nan"))?;
            ranges.push(if range > 0.0 { range } else { f64::INFINITY });
        }
        if !ranges.is_empty() {
            let scan = self.scan(ranges);
            self.recording.scans.push(RecordedScan { scan, time });
        }
        Ok(())
    }

    fn comment(&mut self, line: u64, comment: &str) -> Result<(), TableError> {
        let Some((name, value)) = comment.split_once(':') else { return Ok(()) };
        let Some(index) = ["angle_min", "angle_increment"].iter().position(|known| *known == name.trim())
        else {
            return Ok(());
        };
        let word = value.split_whitespace().next().unwrap_or_default();
        let angle =
            word.parse().ok().filter(|angle: &f64| angle.abs() <= 13.0 && (index == 0 || *angle > 0.0));
        let text = comment.chars().take(40).collect();
        self.angles[index] = Some(angle.ok_or(TableError::Angle { line, text })?);
        Ok(())
    }

    fn scan(&self, ranges: Vec<f64>) -> Scan {
        let steps = (ranges.len() - ranges.len() % 2) as f64;
        let (view, middle) = match self.angles {
            [Some(first), Some(step)] => (step * steps, first + step * steps / 2.0),
            _ => (self.view, 0.0),
        };
        Scan { ranges, view, turn: middle + self.turn }
    }

    fn recording(mut self) -> Recording {
        if let Some((count, line)) = self.back {
            let text = format!("line {line}: time runs backwards: left out, {count} lines in all");
            self.recording.warnings.push(LogWarning::Remark { text, is_loss: true });
        }
        self.recording
    }
}

fn field(line: u64, column: usize, field: &str, wanted: &'static str) -> TableError {
    TableError::Field { line, column: column + 1, field: field.chars().take(24).collect(), wanted }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<LaserLog, TableError> {
        read_table(text.as_bytes(), &KnownLaser::default())
    }

    #[test]
    fn a_table_is_a_log() {
        let text = "# angle_min: -0.5\n# angle_increment: 0.5\ntime,x,y,theta,ranges\n0,0,0,0,1.5,inf,2\n0.1;1;0;0\n0.2\t2\t0\t0\t1\t\t3\n";
        let log = read(text).unwrap();
        assert_eq!((log.scans.len(), log.trajectory.len()), (2, 3));
        assert_eq!(log.scans[0].scan.ranges, [1.5, f64::INFINITY, 2.0]);
        assert_eq!((0..3).map(|beam| log.scans[0].scan.bearing(beam)).collect::<Vec<_>>(), [-0.5, 0.0, 0.5]);
        assert_eq!((log.scans[1].odometry.x, log.scans[1].time), (2.0, Some(0.2)));
    }

    /// As some spreadsheets write them.
    #[test]
    fn a_line_ends_as_any_system_ends_it() {
        let text = "time,x,y,theta,ranges\n0,0,0,0,1.5,inf,2\n1,1,0,0,1,1,1\n";
        for end in ["\r\n", "\r"] {
            assert_eq!(read(&text.replace('\n', end)).unwrap(), read(text).unwrap(), "{end:?}");
        }
        let error = read("0,0,0,0,1,2\r1,0,x,0,1,2").unwrap_err().to_string();
        assert_eq!(error, "line 2, column 3: `x` is no finite number");
    }

    #[test]
    fn commas_between_semicolons_are_decimal() {
        let points = read("0.5;1.25;0;0;1.5;2\n0.6;1.5;0;0;1;2").unwrap();
        let commas = read("time;x;y;theta;ranges\n0,5;1,25;0;0;1,5;2\n0,6;1,5;0;0;1;2").unwrap();
        assert_eq!(commas, points);
        let all = read("0;0;0;0;1,5;2,5\n1;0;0;0;1,5;2,5").unwrap();
        assert_eq!(all.scans[1].scan.ranges, [1.5, 2.5]);
        let list = read("0;0;0;0;1.5,2.5\n1;0;0;0;1.5,2.5").unwrap();
        assert_eq!(list, all, "ranges between the same two semicolons");
        assert!(is_table("0,5;1,25;0;0;1,5"));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let told = |text: &str| read(text).unwrap_err().to_string();
        assert_eq!(told("0,0,0,0,1,2\n1,0,x,0,1,2"), "line 2, column 3: `x` is no finite number");
        assert!(told("0,0,0,0,1,two").starts_with("line 1, column 6: `two` is no range"));
        assert!(told("0,0,0").contains("line 1 has 3 fields"));
        assert!(told("name,age,x,y\n").contains("columns are `name,age,x,y`"));
        assert!(told("# angle_increment: 0\n").contains("line 1"));
        assert!(told("").contains("no usable laser scan"));
        let log = read("5,0,0,0,1,2\n4,0,0,0,1,2\n6,0,0,0,1,2").unwrap();
        assert!(log.warnings[0].to_string().starts_with("line 2: time runs backwards"));
    }

    #[test]
    fn tables_are_known_by_their_first_line() {
        assert!(is_table("time,x,y,theta,r0") && is_table("0.1,0,0,0,1.5") && is_table("1;2;3;4;5"));
        assert!(!is_table("FLASER 3 1 1 1") && !is_table("a,b,c") && !is_table("time"));
    }
}
