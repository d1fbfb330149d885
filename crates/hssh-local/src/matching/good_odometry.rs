//! Odometry that is far better than it is believed to be until something is known of it, as where a gyroscope corrects it: then scans are
//! believed less where they show little.

use nalgebra::Vector3;

use super::motion::MotionNoise;
use super::options::MatchOptions;
use super::track::Track;
use crate::carmen::LaserLog;

/// Stretches of so many metres are compared…
const STRETCH: f64 = 2.0;
/// …and with fewer of them nothing is said.
const LEAST: usize = 30;
/// Nine of ten errors of a normal distribution are less than so many standard deviations.
const NINE_OF_TEN: f64 = 1.645;
/// Odometry is good if its errors have no more than this part of the standard deviation that they are believed to have…
const GOOD: f64 = 0.35;
/// …and is then believed to have twice that, for the track errs as well, but not less than this part.
const LEAST_PART: f64 = 0.1;

/// The options for a log of which the first track shows that its odometry is far better than they have it; `None` if it is not.
pub(super) fn good_odometry(log: &LaserLog, track: &Track, options: &MatchOptions) -> Option<MatchOptions> {
    if options.worst_odometry.is_some() {
        return None;
    }
    let parts = error_parts(log, track, &options.odometry)?;
    (parts.max() <= GOOD).then(|| {
        let [distance, sideways, heading] = parts.map(|part| (2.0 * part).max(LEAST_PART)).into();
        let believed = options.odometry;
        let odometry = MotionNoise {
            distance: distance * believed.distance,
            sideways: sideways * believed.sideways,
            heading: heading * believed.heading,
            turn: heading * believed.turn,
            floor: (distance.max(sideways) * believed.floor.0, heading * believed.floor.1),
        };
        MatchOptions { odometry, worst_odometry: Some(believed), ..*options }
    })
}

/// How large the errors of odometry are, as parts of what they are believed to be: along the way, across it, and of the heading. `None`
/// if the way is short.
fn error_parts(log: &LaserLog, track: &Track, believed: &MotionNoise) -> Option<Vector3<f64>> {
    let mut errors: [Vec<f64>; 3] = Default::default();
    let mut from = 0;
    for to in 1..track.scans.len() {
        if track.scans[to].travelled - track.scans[from].travelled < STRETCH {
            continue;
        }
        let told = believed.motion(&log.trajectory[log.scans[from].moment..=log.scans[to].moment]);
        let seen = track.scans[from].pose.between(track.scans[to].pose);
        from = to;
        let Some(ahead) = told.mean.translation().try_normalize(1e-6) else { continue };
        let covariance = told.covariance.rotated(-ahead.y.atan2(ahead.x));
        let sigmas = covariance.matrix().diagonal().map(f64::sqrt);
        let off = seen.translation() - told.mean.translation();
        let off = Vector3::new(ahead.dot(&off), ahead.perp(&off), told.mean.between(seen).theta);
        for (axis, errors) in errors.iter_mut().enumerate() {
            errors.push(off[axis].abs() / sigmas[axis]);
        }
    }
    (errors[0].len() >= LEAST).then(|| {
        Vector3::from(errors.map(|mut errors| {
            errors.sort_by(f64::total_cmp);
            errors[errors.len() * 9 / 10] / NINE_OF_TEN
        }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::TrackedScan;
    use hssh_metrics::Pose;

    /// The scans show 40 steps of 2.1 m straight on; the wheels tell them with errors along the way and of the heading.
    fn found(along: f64, heading: f64) -> Option<MatchOptions> {
        let wrong = |scan: u32| if scan.is_multiple_of(2) { 1.0 } else { -1.0 };
        let line = |scan: u32| {
            let x = 2.1 * f64::from(scan) + 0.5 * along * wrong(scan);
            format!("FLASER 3 1 2 1 0 0 0 {x} 0 {} {scan} host {scan}\n", 0.5 * heading * wrong(scan))
        };
        let log = LaserLog::read((0..40).map(line).collect::<String>().as_bytes()).unwrap();
        let scan = |scan: u32| {
            let travelled = 2.1 * f64::from(scan);
            TrackedScan { pose: Pose::new(travelled, 0.0, 0.0), step: None, travelled }
        };
        let track = Track { scans: (0..40).map(scan).collect(), lost: Vec::new() };
        good_odometry(&log, &track, &MatchOptions::default())
    }

    #[test]
    fn what_errs_little_is_believed_and_what_errs_as_expected_is_not() {
        let believed = MatchOptions::default().odometry;
        let good = found(0.004, 0.001).unwrap();
        assert_eq!(good.worst_odometry, Some(believed));
        assert!(good.odometry.distance < 0.3 * believed.distance, "{good:?}");
        assert!(good.odometry.heading < 0.3 * believed.heading, "{good:?}");
        assert_eq!(found(0.15, 0.001), None);
        assert_eq!(found(0.004, 0.1), None);
    }
}
