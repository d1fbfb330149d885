//! How far the tracked motion of a log errs over stretches of the way, and how honest its covariances are.

use hssh_local::{LaserLog, Track};
use hssh_metrics::Pose;

/// Over these stretches of travel, in metres, errors are measured.
const STRETCHES: [f64; 4] = [1.0, 5.0, 20.0, 80.0];

/// The errors over stretches of one length.
pub(super) struct Drift {
    pub(super) name: &'static str,
    pub(super) stretch: f64,
    /// Medians of tracked and of raw motion: metres and radians.
    pub(super) track: [f64; 2],
    pub(super) raw: [f64; 2],
    /// The median χ² of the tracked motion's errors; 2.4 if the covariances are right.
    pub(super) chi2: f64,
}

/// The errors over stretches of each length.
pub(super) fn rows(name: &'static str, log: &LaserLog, track: &Track) -> [Drift; 4] {
    STRETCHES.map(|stretch| row(name, log, track, stretch))
}

fn row(name: &'static str, log: &LaserLog, track: &Track, stretch: f64) -> Drift {
    let (mut ours, mut raw, mut chi2) = (Vec::new(), Vec::new(), Vec::new());
    let mut from = 0;
    for to in 1..track.scans.len() {
        if track.scans[to].travelled - track.scans[from].travelled < stretch {
            continue;
        }
        let (start, end) = (&log.scans[from], &log.scans[to]);
        let truth = start.corrected.between(end.corrected);
        raw.push(truth.between(start.odometry.between(end.odometry)));
        if let Ok(Some(motion)) = track.motion(from, to) {
            let error = truth.between(motion.mean);
            let off = nalgebra::vector![motion.mean.x - truth.x, motion.mean.y - truth.y, error.theta];
            ours.push(error);
            chi2.push(off.dot(&(motion.covariance.information().matrix() * off)));
        }
        from = to;
    }
    Drift { name, stretch, track: sizes(&ours), raw: sizes(&raw), chi2: middle(chi2) }
}

/// The medians of errors: metres and radians.
fn sizes(errors: &[Pose]) -> [f64; 2] {
    let metres = errors.iter().map(|error| error.translation().norm()).collect();
    let radians = errors.iter().map(|error| error.theta.abs()).collect();
    [middle(metres), middle(radians)]
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
