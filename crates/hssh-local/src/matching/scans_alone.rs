//! Odometry from scans alone, for robots that tell none: each scan is looked for where the motion before it leads.

use hssh_metrics::{Covariance, Pose, UncertainPose};
use nalgebra::{Matrix3, vector};

use super::options::MatchOptions;
use super::track::Tracker;
use crate::scan::Scan;

/// How fast a robot gets faster or slower, standard deviations: metres and radians per second, each second…
const CHANGE: (f64, f64) = (0.8, 1.6);
/// …and what no step is foreseen better than: metres and radians…
const FLOOR: (f64, f64) = (0.03, 0.03);
/// …or worse than: a wider search finds the wrong place sooner than the right one.
const WORST: (f64, f64) = (0.6, 0.5);
/// After a pause longer than so many seconds nobody knows how the robot moved in it.
const PAUSE: f64 = 3.0;

/// A scan and when it was taken, in seconds.
#[derive(Clone, Copy, Debug)]
pub struct TimedScan<'a> {
    /// The scan.
    pub scan: &'a Scan,
    /// When it was taken: seconds of any clock that does not go back.
    pub time: f64,
}

/// Where each scan was taken, in the frame of the first, by scan matching alone. Along a corridor that looks the same
/// everywhere the robot is taken to keep its speed.
#[must_use]
pub fn odometry_from_scans(scans: &[TimedScan<'_>]) -> Vec<Pose> {
    let mut tracker = Tracker::new(MatchOptions::default());
    let mut poses: Vec<Pose> = Vec::with_capacity(scans.len());
    for (index, now) in scans.iter().enumerate() {
        let motion = foreseen(&scans[..=index], &poses);
        poses.push(tracker.add_moved(now.scan, &motion, None).pose);
    }
    poses
}

/// The motion to the last of the scans, from the poses of those before it: as it was, as far as speeds last.
fn foreseen(scans: &[TimedScan<'_>], poses: &[Pose]) -> UncertainPose {
    let elapsed = |later: usize| (scans[later].time - scans[later - 1].time).max(0.0);
    let last = scans.len() - 1;
    let (mean, seconds) = match last {
        0 => (Pose::IDENTITY, 0.0),
        1 => (Pose::IDENTITY, elapsed(1)),
        _ => {
            let (before, now) = (elapsed(last - 1), elapsed(last));
            let part = if before > 0.0 && now <= PAUSE { (now / before).min(3.0) } else { 0.0 };
            let step = poses[last - 2].between(poses[last - 1]);
            (Pose::new(step.x * part, step.y * part, step.theta * part), now)
        }
    };
    let spread =
        |change: f64, floor: f64, worst: f64| (floor + change * seconds * seconds.min(1.0)).min(worst);
    let metres = spread(CHANGE.0, FLOOR.0, WORST.0).powi(2);
    let radians = spread(CHANGE.1, FLOOR.1, WORST.1).powi(2);
    let covariance = Covariance::new(Matrix3::from_diagonal(&vector![metres, metres, radians]))
        .expect("the floors keep the variances positive");
    UncertainPose { mean, covariance }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A room of 9 m × 6 m, seen all around from a pose in it.
    fn seen(pose: Pose) -> Scan {
        let mut scan = Scan { ranges: vec![0.0; 360], view: std::f64::consts::TAU, turn: 0.0 };
        for beam in 0..360 {
            let (sin, cos) = (pose.theta + scan.bearing(beam)).sin_cos();
            let along = |at: f64, direction: f64, walls: [f64; 2]| {
                ((if direction > 0.0 { walls[1] } else { walls[0] }) - at) / direction
            };
            scan.ranges[beam] = along(pose.x, cos, [-3.0, 6.0]).min(along(pose.y, sin, [-2.0, 4.0]));
        }
        scan
    }

    #[test]
    fn a_robot_without_wheels_is_followed() {
        let way: Vec<Pose> = (0..60)
            .map(|step| f64::from(step) * 0.05)
            .map(|time| Pose::new(0.8 * time, 0.3 * time * time / 3.0, 0.5 * time))
            .collect();
        let scans: Vec<Scan> = way.iter().map(|&pose| seen(pose)).collect();
        let timed: Vec<TimedScan<'_>> = scans
            .iter()
            .enumerate()
            .map(|(step, scan)| TimedScan { scan, time: 0.1 * step as f64 })
            .collect();
        for (found, told) in odometry_from_scans(&timed).into_iter().zip(&way) {
            let off = way[0].between(*told).between(found);
            assert!(off.translation().norm() < 0.05 && off.theta.abs() < 0.02, "{told:?}: {off:?}");
        }
    }
}
