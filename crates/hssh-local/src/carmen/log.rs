//! A whole log in memory: its scans, and the raw trajectory between them.

use std::collections::BTreeMap;
use std::io::Read;

use hssh_metrics::Pose;

use super::error::{LogError, LogWarning};
use super::mount::LaserMount;
use super::position::LogPosition;
use super::raw::{self, RawLog, RawScan};
use super::reader::LogReader;
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
    /// The scans in order; at least one. Those of a text all have the same number of beams.
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
    /// What was passed over.
    pub warnings: Vec<LogWarning>,
}

impl LaserLog {
    /// Reads a log, plain or gzip. Messages that cannot be used are left out with a warning; a log that
    /// breaks off is used up to there.
    ///
    /// # Errors
    /// If the source cannot be read, is no text, is empty, has no usable scan, or if hardly a beam came back.
    pub fn read(source: impl Read) -> Result<Self, LogError> {
        LaserLog::read_with(source, &LaserMount::default())
    }

    /// Reads a log as [`read`](Self::read) does, knowing of the laser what the log does not say, or says wrongly.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with(source: impl Read, known: &LaserMount) -> Result<Self, LogError> {
        let mut reader = LogReader::new(source)?;
        let mut raw = RawLog::default();
        while let Some(message) = reader.next_message()? {
            raw.add(message, LogPosition::Line(reader.line()));
        }
        let (lines, mut warnings) = (reader.line(), reader.into_warnings());
        if raw.scans.is_empty() {
            return Err(raw.why_useless(lines, warnings));
        }
        raw.keep_best_kind();
        raw.keep_usual_scans(&mut warnings);
        raw.tell_odd_beams(&mut warnings);
        let (view, turn, is_told) = raw.view(known);
        raw.check_view(view, is_told, &mut warnings);
        raw.move_to_laser(known, &mut warnings);
        raw.bridge_jumps(&mut warnings);
        let max_range = raw.limit(&mut warnings)?;
        let is_facing_unclear = raw.check_facing(view, max_range, &mut warnings);
        warnings.sort_by_key(LogWarning::position);
        let logged = |scan: RawScan| LoggedScan {
            scan: Scan { ranges: raw::came_back(scan.ranges, max_range), view, turn },
            odometry: raw.trajectory[scan.moment].pose,
            moment: scan.moment,
            corrected: scan.corrected,
            at: scan.at,
            time: scan.time,
        };
        Ok(LaserLog {
            scans: raw.scans.into_iter().map(logged).collect(),
            trajectory: raw.trajectory.into_iter().map(|moment| moment.pose).collect(),
            max_range,
            skipped: raw.skipped,
            is_facing_unclear,
            warnings,
        })
    }

    /// The log as if it ended with its scan number `scans`, counted from 1.
    #[must_use]
    pub fn beginning(&self, scans: usize) -> Self {
        let scans = self.scans[..scans.min(self.scans.len())].to_vec();
        let moments = scans.last().map_or(0, |last| last.moment + 1);
        LaserLog { scans, trajectory: self.trajectory[..moments].to_vec(), ..self.clone() }
    }

    /// Number of beams of a scan.
    #[must_use]
    pub fn beams(&self) -> usize {
        self.scans.first().map_or(0, |scan| scan.scan.ranges.len())
    }
}
