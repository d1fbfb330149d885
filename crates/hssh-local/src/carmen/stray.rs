//! Odometry lines that do not belong to the odometry of the scans: they count in another unit or from another place.

use std::collections::BTreeSet;

use super::error::LogWarning;
use super::raw::{Moment, RawLog};

/// A line strays from the scans around it that is farther from them than this many metres…
const LEAST: f64 = 2.0;
/// …and this many times as far as they are from each other.
const TIMES: f64 = 10.0;
/// With fewer stretches between scans, nothing is said.
const LEAST_STRETCHES: usize = 8;

impl RawLog {
    /// Leaves out the odometry between scans if along most stretches it strays from that of the scans.
    pub(super) fn drop_stray_lines(&mut self, warnings: &mut Vec<LogWarning>) {
        let moments: Vec<usize> = self.scans.iter().map(|scan| scan.moment).collect();
        let stretches = moments.windows(2).filter(|pair| pair[1] > pair[0] + 1);
        let (mut all, mut stray) = (0, 0);
        for pair in stretches {
            let [from, to] = [pair[0], pair[1]].map(|moment| self.trajectory[moment].pose.translation());
            let apart = |moment: &Moment| {
                let at = moment.pose.translation();
                (at - from).norm().min((at - to).norm())
            };
            let farthest = self.trajectory[pair[0] + 1..pair[1]].iter().map(apart).fold(0.0, f64::max);
            all += 1;
            stray += usize::from(farthest > LEAST.max(TIMES * (to - from).norm()));
        }
        if all < LEAST_STRETCHES || 2 * stray <= all {
            return;
        }
        let kept: BTreeSet<usize> = moments.iter().copied().collect();
        let first = (0..self.trajectory.len()).find(|moment| !kept.contains(moment));
        let at = first.map_or(self.scans[0].at, |first| self.trajectory[first].at);
        let lines = (self.trajectory.len() - kept.len()) as u64;
        warnings.push(LogWarning::StrayOdometry { at, lines });
        let trajectory = std::mem::take(&mut self.trajectory);
        let kept_moments = trajectory.into_iter().enumerate().filter(|(moment, _)| kept.contains(moment));
        self.trajectory = kept_moments.map(|(_, moment)| moment).collect();
        for scan in &mut self.scans {
            scan.moment = kept.range(..scan.moment).count();
        }
    }
}
