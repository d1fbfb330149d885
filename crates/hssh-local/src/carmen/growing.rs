//! Reading logs: those that are still being written, of which what has come so far is a log at any time, and whole ones.

use std::io::Read;

use hssh_metrics::Pose;

use super::error::{LogError, LogWarning};
use super::log::LaserLog;
use super::message::{LaserKind, Message};
use super::mount::LaserMount;
use super::others::OtherLaser;
use super::position::LogPosition;
use super::raw::RawLog;
use super::reader::LogReader;

/// The messages of a log in order, as far as they have come.
#[derive(Clone)]
pub struct GrowingLog {
    raw: RawLog,
    known: LaserMount,
    /// Whose scans are used, those of the first with what the others see; none for those that are of most use.
    chosen: Vec<LaserKind>,
    lines: u64,
    warnings: Vec<LogWarning>,
}

impl GrowingLog {
    /// A log without messages yet, of whose laser something may be known that the log will not say, or will say wrongly.
    #[must_use]
    pub fn new(known: LaserMount) -> Self {
        GrowingLog { raw: RawLog::default(), known, chosen: Vec::new(), lines: 0, warnings: Vec::new() }
    }

    /// The same of the scans in messages of these kinds: of several, merged to what one laser would see all around from where the first sits.
    #[must_use]
    pub fn of_lasers(self, chosen: &[LaserKind]) -> Self {
        GrowingLog { chosen: chosen.to_vec(), ..self }
    }

    /// Adds what a reader read last, and what it passed over before; nothing but the latter at its end.
    pub fn add(&mut self, message: Option<Message>, reader: &mut LogReader<'_>) {
        self.lines = reader.line();
        self.warnings.append(&mut reader.take_warnings());
        if let Some(message) = message {
            self.raw.add(message, LogPosition::Line(self.lines));
        }
    }

    /// How many laser messages have come.
    #[must_use]
    pub fn scans(&self) -> usize {
        self.raw.scans.len()
    }

    /// The log as if it ended here, without the doubts that only a whole log is worth: whether the laser looks as wide and where it is
    /// taken to look.
    ///
    /// # Errors
    /// If it has no usable scan, or if hardly a beam came back.
    pub fn log(&self) -> Result<LaserLog, LogError> {
        self.clone().made(false)
    }

    /// The log, which is whole.
    ///
    /// # Errors
    /// If it has no usable scan, or if hardly a beam came back.
    pub fn into_log(self) -> Result<LaserLog, LogError> {
        self.made(true)
    }

    fn made(self, is_whole: bool) -> Result<LaserLog, LogError> {
        let GrowingLog { mut raw, known, chosen, lines, mut warnings } = self;
        let is_laser_given = known.pose.is_some();
        if raw.scans.is_empty() {
            return Err(raw.why_useless(lines, warnings));
        }
        let others = raw.choose(&chosen, &mut warnings)?;
        raw.keep_scans_of_known_view(&mut warnings);
        raw.tell_odd_beams(&mut warnings);
        let (geometry, is_told) = raw.geometry(&known);
        let looks = |scan: usize| geometry[scan];
        let view = looks(0).0;
        if is_whole {
            let before = warnings.len();
            raw.check_handed(&mut warnings);
            raw.check_view(view, is_told, &mut warnings);
            if warnings.len() == before {
                raw.check_turns(view, &mut warnings);
            }
            raw.check_repeats(&mut warnings);
            raw.check_speed(&mut warnings);
            raw.check_order()?;
        }
        raw.drop_stray_lines(&mut warnings);
        let robot: Vec<Pose> = raw.scans.iter().map(|scan| raw.trajectory[scan.moment].pose).collect();
        let mut mount = raw.move_to_laser(&known, &mut warnings);
        raw.bridge_jumps(&mut warnings);
        let max_range = raw.limit(looks, &mut warnings)?;
        let mut is_facing_unclear = false;
        if is_whole {
            let facing = raw.face(looks, max_range, is_laser_given, &mut warnings);
            is_facing_unclear = facing.is_unclear;
            mount = mount.compose(facing.turn);
            raw.check_pace(looks, max_range, &mut warnings);
            raw.check_noise(looks, max_range, &mut warnings);
        }
        let others = others
            .into_iter()
            .map(|other| OtherLaser::new(other, &mut warnings))
            .collect::<Result<Vec<_>, _>>()?;
        warnings.sort_by_key(LogWarning::position);
        let log =
            LaserLog { is_facing_unclear, is_laser_given, ..raw.into_log(geometry, max_range, warnings) };
        Ok(if others.is_empty() { log } else { log.seen_around(&robot, mount, &others) })
    }
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
        LaserLog::read_lasers(source, known, &[])
    }

    /// Reads the scans in messages of some kinds: of several, merged to what one laser would see all around from where the first sits. If none
    /// is given, those that are of most use.
    ///
    /// # Errors
    /// As [`read`](Self::read), and if the log has no messages of one of these kinds.
    pub fn read_lasers(
        source: impl Read,
        known: &LaserMount,
        chosen: &[LaserKind],
    ) -> Result<Self, LogError> {
        let mut reader = LogReader::new(source)?;
        let mut growing = GrowingLog::new(*known).of_lasers(chosen);
        loop {
            let message = reader.next_message()?;
            let is_end = message.is_none();
            growing.add(message, &mut reader);
            if is_end {
                return growing.into_log();
            }
        }
    }
}
