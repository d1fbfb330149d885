//! Whether laser and odometry go on together: a scan that is told again and again while the robot drives is no news, and no robot drives
//! through a building as fast as odometry in other units says.

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};

/// A laser that repeats itself is one that does so over that many metres.
const REPEATED: f64 = 1.0;
/// In a building no robot drives faster, in metres per second.
const FASTEST: f64 = 8.0;
/// Steps that are shorter, in metres, are none.
const LEAST_STEP: f64 = 0.02;
/// With fewer steps, nothing is said of speeds.
const LEAST_STEPS: usize = 8;

impl RawLog {
    /// Warns of stretches along which all scans are the same to the last digit, and others are not.
    pub(crate) fn check_repeats(&self, warnings: &mut Vec<LogWarning>) {
        let mut from = 0;
        for to in 1..=self.scans.len() {
            if self.scans.get(to).is_some_and(|scan| scan.ranges == self.scans[from].ranges) {
                continue;
            }
            let (first, last) = (&self.scans[from], &self.scans[to - 1]);
            let metres = self.step(first, last).translation().norm();
            if metres > REPEATED && to - from < self.scans.len() && varies(first) {
                warnings.push(LogWarning::ScansRepeat { at: first.at, scans: (to - from) as u64, metres });
            }
            from = to;
        }
    }

    /// Warns if the robot drives as fast as none does.
    pub(crate) fn check_speed(&self, warnings: &mut Vec<LogWarning>) {
        let speed = |pair: &[RawScan]| {
            let seconds = pair[1].time? - pair[0].time?;
            let metres = self.step(&pair[0], &pair[1]).translation().norm();
            (seconds > 0.0 && metres > LEAST_STEP).then_some(metres / seconds)
        };
        let mut speeds: Vec<f64> = self.scans.windows(2).filter_map(speed).collect();
        if speeds.len() < LEAST_STEPS {
            return;
        }
        speeds.sort_by(f64::total_cmp);
        let usual = speeds[speeds.len() / 2];
        if usual > FASTEST {
            warnings.push(LogWarning::TooFast { speed: usual });
        }
    }
}

/// Whether a scan shows more than one and the same range: where nothing comes back, all scans are alike.
fn varies(scan: &RawScan) -> bool {
    scan.ranges.iter().any(|range| *range != scan.ranges[0])
}
