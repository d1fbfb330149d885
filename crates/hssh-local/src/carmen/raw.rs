//! A log as its messages tell it, before anything is made of it that concerns the log as a whole.

use std::collections::{BTreeMap, BTreeSet};

use hssh_metrics::Pose;

use super::error::{LogError, LogWarning, MessageProblem};
use super::log::{LaserLog, LoggedScan};
use super::message::{LaserKind, LaserMessage, LaserView, Message};
use super::position::LogPosition;
use crate::scan::Scan;

/// All messages of a log.
#[derive(Clone, Default)]
pub(crate) struct RawLog {
    /// The scans in order.
    pub(crate) scans: Vec<RawScan>,
    /// All raw odometry in order, that of the scans included.
    pub(crate) trajectory: Vec<Moment>,
    /// The last value of each parameter that is a finite number.
    pub(crate) parameters: BTreeMap<String, f64>,
    /// How many messages of kinds that are not read, by kind.
    pub(crate) skipped: BTreeMap<String, u64>,
}

/// A scan as its message tells it.
#[derive(Clone)]
pub(crate) struct RawScan {
    pub(crate) kind: LaserKind,
    /// How its laser looks, if the message says so.
    pub(crate) looks: Option<LaserView>,
    pub(crate) ranges: Vec<f64>,
    pub(crate) odd_beams: usize,
    pub(crate) odd_word: Option<String>,
    /// The first of the two poses in the message.
    pub(crate) corrected: Pose,
    /// Its own position in the trajectory.
    pub(crate) moment: usize,
    pub(crate) at: LogPosition,
    pub(crate) time: Option<f64>,
}

/// A pose of raw odometry, and where in the log it stands.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) pose: Pose,
    pub(crate) at: LogPosition,
}

impl RawLog {
    pub(super) fn add(&mut self, message: Message, at: LogPosition) {
        match message {
            Message::Laser(laser) => {
                let LaserMessage { kind, looks, ranges, odd_beams, odd_word, corrected, odometry, time } =
                    laser;
                let last = self.trajectory.last().map_or(Pose::IDENTITY, |last| last.pose);
                let (corrected, pose) =
                    if kind == LaserKind::Raw { (last, last) } else { (corrected, odometry) };
                let moment = self.trajectory.len();
                self.trajectory.push(Moment { pose, at });
                self.scans.push(RawScan {
                    kind,
                    looks,
                    ranges,
                    odd_beams,
                    odd_word,
                    corrected,
                    moment,
                    at,
                    time,
                });
            }
            Message::Odometry(pose) => self.trajectory.push(Moment { pose, at }),
            Message::Parameter { name, value } => {
                if let Some(number) = value.parse().ok().filter(|number: &f64| number.is_finite()) {
                    self.parameters.insert(name.to_ascii_lowercase(), number);
                }
            }
            Message::Other(kind) => *self.skipped.entry(kind).or_default() += 1,
        }
    }

    /// The value of a parameter.
    pub(super) fn parameter(&self, name: &str) -> Option<f64> {
        self.parameters.get(name).copied()
    }

    /// Of messages that tell the same scans, or those of other lasers, the most useful kind is kept; that a laser is not used is said.
    pub(super) fn keep_best_kind(&mut self, warnings: &mut Vec<LogWarning>) {
        let Some(best) = self.scans.iter().map(|scan| scan.kind).max() else { return };
        let rear = self.scans.iter().filter(|scan| scan.kind.is_rear());
        if let Some(other) = rear.clone().next().filter(|_| !best.is_rear()) {
            let (count, other, used) = (rear.count(), other.kind.name(), best.name());
            let text = format!(
                "scans of a second laser, which looks back ({other}), are not used, {count} in all: what the one that looks ahead shows is the map; \
                 --scan {used},{other} merges them"
            );
            warnings.push(LogWarning::Remark { text, is_loss: false });
        }
        for scan in self.scans.iter().filter(|scan| scan.kind != best) {
            *self.skipped.entry(scan.kind.name().to_owned()).or_default() += 1;
        }
        self.keep(best);
    }

    /// Leaves one kind of scans. What is not read says nothing of the way either.
    pub(super) fn keep(&mut self, kind: LaserKind) {
        let gone: BTreeSet<usize> =
            self.scans.iter().filter(|scan| scan.kind != kind).map(|scan| scan.moment).collect();
        if gone.is_empty() {
            return;
        }
        self.scans.retain(|scan| scan.kind == kind);
        for scan in &mut self.scans {
            scan.moment -= gone.range(..scan.moment).count();
        }
        let trajectory = std::mem::take(&mut self.trajectory);
        let kept = trajectory.into_iter().enumerate().filter(|(moment, _)| !gone.contains(moment));
        self.trajectory = kept.map(|(_, moment)| moment).collect();
    }

    /// Leaves out scans of which it is not known how wide they look: those that do not say so, and have neither so many times as many steps
    /// between their beams as most nor such a part of them. Who switches from 180 beams to 181 or 361 looks as wide as before.
    pub(super) fn keep_scans_of_known_view(&mut self, warnings: &mut Vec<LogWarning>) {
        /// So many times as many steps at most.
        const MOST_TIMES: usize = 8;
        let steps = |beams: usize| (beams - beams % 2).max(1);
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for scan in &self.scans {
            *counts.entry(scan.ranges.len()).or_default() += 1;
        }
        let usual = counts.iter().max_by_key(|&(beams, scans)| (scans, beams));
        let expected = usual.map_or(0, |(&beams, _)| beams);
        let is_alike = |beams: usize| {
            let (fewer, more) = (steps(beams.min(expected)), steps(beams.max(expected)));
            more % fewer == 0 && more / fewer <= MOST_TIMES
        };
        self.scans.retain(|scan| {
            let found = scan.ranges.len();
            let is_known = scan.looks.is_some() || is_alike(found);
            if !is_known {
                let problem = MessageProblem::OtherBeamCount { found, expected };
                warnings.push(LogWarning::Message {
                    at: scan.at,
                    kind: scan.kind.name().to_owned(),
                    problem,
                });
            }
            is_known
        });
    }

    /// Says once how many beams are no ranges.
    pub(super) fn tell_odd_beams(&self, warnings: &mut Vec<LogWarning>) {
        let odd = self.scans.iter().filter(|scan| scan.odd_beams > 0);
        let Some(first) = odd.clone().next() else { return };
        warnings.push(LogWarning::OddBeams {
            at: first.at,
            word: first.odd_word.clone().unwrap_or_default(),
            beams: odd.clone().map(|scan| scan.odd_beams as u64).sum(),
            scans: odd.count() as u64,
        });
    }

    /// The log of these messages, of whose scans it is said how each looks, view and turn in radians.
    pub(crate) fn into_log(
        self,
        geometry: impl IntoIterator<Item = (f64, f64)>,
        max_range: f64,
        warnings: Vec<LogWarning>,
    ) -> LaserLog {
        let logged = |(scan, (view, turn)): (RawScan, (f64, f64))| LoggedScan {
            scan: Scan { ranges: came_back(scan.ranges, max_range), view, turn },
            odometry: self.trajectory[scan.moment].pose,
            moment: scan.moment,
            corrected: scan.corrected,
            at: scan.at,
            time: scan.time,
        };
        LaserLog {
            scans: self.scans.into_iter().zip(geometry).map(logged).collect(),
            trajectory: self.trajectory.iter().map(|moment| moment.pose).collect(),
            max_range,
            skipped: self.skipped,
            is_facing_unclear: false,
            is_laser_given: false,
            laser_turn: None,
            warnings,
        }
    }

    /// Why there is no scan to use.
    pub(super) fn why_useless(self, lines: u64, warnings: Vec<LogWarning>) -> LogError {
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
        LogError::NoScans { lines, messages, first_warning: warnings.into_iter().next() }
    }
}

/// Ranges with what did not come back as infinite, which is what is not shorter than the limit, or no length.
fn came_back(ranges: Vec<f64>, limit: f64) -> Vec<f64> {
    let told = |range: f64| if range > 0.0 && range < limit { range } else { f64::INFINITY };
    ranges.into_iter().map(told).collect()
}
