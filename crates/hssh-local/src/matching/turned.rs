//! How the laser sits on the robot: where wheels say that it went straight ahead, scans show it going aside if it is turned.

use super::track::Track;
use crate::carmen::{LaserLog, LaserTurn};

/// Stretches of the way are compared that are so long, in metres, and on which the robot turned less, in radians.
const STRETCH: f64 = 0.5;
const STRAIGHT: f64 = 0.05;
/// With fewer stretches nothing is said.
const LEAST: usize = 30;
/// A laser that is turned more, in radians, was mounted to look elsewhere, and is warned of when its log is read.
const MOST: f64 = 0.2;
/// From the median of absolute deviations to the standard deviation.
const DEVIATION: f64 = 1.4826;

impl LaserTurn {
    /// What a tracked log shows: the median over straight stretches of how far the direction in which the scans say that the robot
    /// went is from that of the odometry. `None` if there are few such stretches.
    #[must_use]
    pub fn of(log: &LaserLog, track: &Track) -> Option<Self> {
        let mut angles = Vec::new();
        let mut from = 0;
        for to in 1..track.scans.len() {
            if track.scans[to].travelled - track.scans[from].travelled < STRETCH {
                continue;
            }
            let told = log.scans[from].odometry.between(log.scans[to].odometry);
            let seen = track.scans[from].pose.between(track.scans[to].pose);
            let is_straight = [told, seen]
                .iter()
                .all(|motion| motion.theta.abs() < STRAIGHT && motion.translation().norm() > STRETCH / 2.0);
            if is_straight {
                let (one, other) = (told.translation(), seen.translation());
                angles.push(-one.perp(&other).atan2(one.dot(&other)));
            }
            from = to;
        }
        if angles.len() < LEAST {
            return None;
        }
        let count = angles.len() as f64;
        let angle = middle(&mut angles);
        let mut off: Vec<f64> = angles.iter().map(|one| (one - angle).abs()).collect();
        Some(LaserTurn { angle, sigma: DEVIATION * middle(&mut off) / count.sqrt() })
    }
}

/// By how much the laser is turned, if that is clear and neither said by anybody nor reckoned with.
pub(super) fn unreckoned_turn(log: &LaserLog, track: &Track) -> Option<LaserTurn> {
    let is_asked = !log.is_laser_given && log.laser_turn.is_none() && track.scans.len() == log.scans.len();
    LaserTurn::of(log, track).filter(|turn| is_asked && turn.is_clear() && turn.angle.abs() < MOST)
}

fn middle(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::TrackedScan;
    use hssh_metrics::Pose;

    /// The wheels go along x; a laser turned by 0.03 to the left sees them go that much to the right.
    #[test]
    fn a_turned_laser_goes_aside() {
        let line = |scan: u32| format!("FLASER 3 1 2 1 0 0 0 {} 0 0 {scan} host {scan}\n", f64::from(scan));
        let text: String = (0..40).map(line).collect();
        let log = LaserLog::read(text.as_bytes()).unwrap();
        let scan = |scan: u32| {
            let (sin, cos) = (-0.03_f64).sin_cos();
            let x = f64::from(scan);
            TrackedScan { pose: Pose::new(x * cos, x * sin, 0.0), step: None, travelled: x }
        };
        let mut track = Track { scans: (0..40).map(scan).collect(), lost: Vec::new() };
        let turn = LaserTurn::of(&log, &track).unwrap();
        assert!((turn.angle - 0.03).abs() < 1e-9 && turn.is_clear(), "{turn:?}");
        track.scans.truncate(20);
        assert_eq!(LaserTurn::of(&log, &track), None);
    }
}
