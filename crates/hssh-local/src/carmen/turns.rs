//! Whether the scans turn when the odometry does: where its heading is missing, or comes too late, they do not.

use hssh_metrics::Pose;

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};
use super::view::shift;

/// Scans count that turned by at least so many radians since one of the scans before…
const LEAST_TURN: f64 = 0.15;
/// …no farther back than this many.
const WITHIN: usize = 6;
/// The odometry says the same if it is off by no more than this part of the turn.
const OFF: f64 = 0.5;
/// With fewer turns, nothing is said…
const LEAST_TURNS: usize = 8;
/// …and it is doubted if it says otherwise of more than this part of them.
const MOST_OFF: f64 = 0.5;
/// More scans than this say no more, nor do more beams of a scan.
const MOST_SCANS: usize = 300;
const MOST_BEAMS: usize = 181;

impl RawLog {
    /// Warns if scans turn where the odometry does not, with that view in radians. Where it does not move at all, there is none, which is told
    /// once the log is tracked.
    pub(super) fn check_turns(&self, view: f64, warnings: &mut Vec<LogWarning>) {
        let first = self.trajectory.first().map_or(Pose::IDENTITY, |first| first.pose);
        if self.trajectory.iter().all(|moment| moment.pose == first) {
            return;
        }
        let turn = |first: usize| {
            let one = &self.scans[first];
            let beams = one.ranges.len();
            let thinned = beams.div_ceil(MOST_BEAMS).max(1);
            let step = thinned as f64 * view / (beams - beams % 2).max(1) as f64;
            let some = |scan: &RawScan| scan.ranges.iter().step_by(thinned).copied().collect::<Vec<f64>>();
            let ranges = some(one);
            let others = self.scans[first + 1..].iter().take(WITHIN);
            let mut seen = others.filter_map(|other| Some((other, step * shift(&ranges, &some(other))?)));
            let (other, seen) = seen.find(|(_, seen)| seen.abs() >= LEAST_TURN)?;
            Some((seen - self.step(one, other).theta).abs() > OFF * seen.abs())
        };
        let firsts = (0..self.scans.len()).step_by(self.scans.len().div_ceil(MOST_SCANS).max(1));
        let turns: Vec<bool> = firsts.filter_map(turn).collect();
        let off = turns.iter().filter(|is_off| **is_off).count();
        if turns.len() >= LEAST_TURNS && off as f64 > MOST_OFF * turns.len() as f64 {
            warnings.push(LogWarning::TurnsApart { off: off as u64, turns: turns.len() as u64 });
        }
    }

    /// How the odometry moved between two scans.
    pub(super) fn step(&self, one: &RawScan, other: &RawScan) -> Pose {
        self.trajectory[one.moment].pose.between(self.trajectory[other.moment].pose)
    }
}
