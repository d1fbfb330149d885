//! Whether scans stand in the order in which they were taken.

use hssh_metrics::Pose;

use super::error::LogError;
use super::raw::RawLog;

/// With fewer scans nothing is said.
const LEAST: usize = 20;
/// Metres from one scan to the next that a robot may have driven, whatever it is like.
const NEAR: f64 = 1.0;
/// Scans are in no order if from one to the next it is this part as far as from one to any other.
const AS_FAR: f64 = 0.4;
/// From a scan to the one that it is paired with, times its number.
const STRIDE: usize = 7_919;

impl RawLog {
    /// # Errors
    /// If from one scan to the next it is about as far as from any to any: they were shuffled, or are of several drives.
    pub(crate) fn check_order(&self) -> Result<(), LogError> {
        let scans = self.scans.len();
        if scans < LEAST {
            return Ok(());
        }
        let pose = |scan: usize| -> Pose { self.trajectory[self.scans[scan].moment].pose };
        let apart = |one: usize, other: usize| pose(one).between(pose(other)).translation().norm();
        let next = middle((1..scans).map(|scan| apart(scan - 1, scan)));
        // Some pairs that stand in no order.
        let any = middle((0..scans).map(|scan| apart(scan, (scan * STRIDE + scans / 3) % scans)));
        if next > NEAR && next > AS_FAR * any {
            return Err(LogError::OutOfOrder { next, any });
        }
        Ok(())
    }
}

fn middle(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
