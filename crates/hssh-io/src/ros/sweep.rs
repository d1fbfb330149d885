//! A laser's sweep as a [`Scan`]: its angles as they were meant, its ranges as ROS defines them (REP 117), and turned as its
//! laser is mounted.

use std::f64::consts::TAU;

use hssh_local::Scan;
use nalgebra::{Isometry3, Vector3};

use crate::ros::message::LaserScan;

/// A laser of which the axis leans by more than this from the vertical does not look along the floor: radians.
const LEVEL: f64 = 0.35;
/// No sweep has more beams.
const MOST_BEAMS: usize = 100_000;

/// Where a laser sits on its robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Mount {
    /// Metres ahead of the robot's axis and to its left.
    pub(crate) at: [f64; 2],
    /// Radians that it is turned to the left.
    pub(crate) turn: f64,
    /// Whether it hangs upside down, so that its beams run the other way.
    pub(crate) is_upside_down: bool,
    /// Radians that its axis leans from the vertical.
    pub(crate) lean: f64,
}

impl Mount {
    /// At the axis, looking ahead.
    pub(crate) const USUAL: Mount = Mount { at: [0.0; 2], turn: 0.0, is_upside_down: false, lean: 0.0 };

    /// By the laser's frame in the robot's.
    pub(crate) fn of(pose: &Isometry3<f64>) -> Self {
        let (ahead, up) = (pose.rotation * Vector3::x(), pose.rotation * Vector3::z());
        Mount {
            at: [pose.translation.x, pose.translation.y],
            turn: exact(ahead.y.atan2(ahead.x)),
            is_upside_down: up.z < 0.0,
            lean: up.z.abs().clamp(0.0, 1.0).acos(),
        }
    }

    /// Whether the laser looks along the floor.
    pub(crate) fn is_level(&self) -> bool {
        self.lean <= LEVEL
    }
}

/// Why a sweep cannot be used.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, thiserror::Error)]
pub(crate) enum SweepProblem {
    #[error("has no beams, or more than {MOST_BEAMS}")]
    Beams,
    #[error("has angles that are no numbers, or an angle of 0 between its beams")]
    Angles,
}

/// The scan of a sweep.
pub(crate) fn scan(sweep: &LaserScan, mount: &Mount) -> Result<Scan, SweepProblem> {
    let beams = sweep.ranges.len();
    if !(1..=MOST_BEAMS).contains(&beams) {
        return Err(SweepProblem::Beams);
    }
    let (first, step) = (degrees(sweep.angle_min), degrees(sweep.angle_increment));
    if !first.is_finite() || !step.is_finite() || (step == 0.0 && beams > 1) || first.abs() > 720.0 {
        return Err(SweepProblem::Angles);
    }
    let (nearest, farthest) = (length(sweep.range_min), length(sweep.range_max));
    let range = |range: &f32| {
        let range = length(*range);
        // Infinite, no number, too near, too far: nothing is known along the beam.
        let is_told =
            range > 0.0 && range >= nearest && (range <= farthest || farthest <= 0.0 || farthest.is_nan());
        if is_told { range } else { f64::INFINITY }
    };
    // More than a turn says nothing more.
    let most = if step == 0.0 { 1 } else { (360.0 / step.abs() + 1e-6).floor().max(1.0) as usize };
    let beams = beams.min(most);
    let mut ranges: Vec<f64> = sweep.ranges[..beams].iter().map(range).collect();
    let steps = (beams - beams % 2) as f64;
    let mut middle = first + step * steps / 2.0;
    let is_clockwise = (step < 0.0) != mount.is_upside_down;
    if mount.is_upside_down {
        middle = -middle;
    }
    if is_clockwise {
        ranges.reverse();
        // Of an even number of beams the middle one is the first of the second half, from either end.
        if beams.is_multiple_of(2) {
            middle += step.abs();
        }
    }
    let view = (step.abs() * steps).to_radians();
    let turn = middle.to_radians() + mount.turn;
    let turn = if turn.abs() > TAU / 2.0 { turn.sin().atan2(turn.cos()) } else { turn };
    Ok(Scan { ranges, view, turn })
}

/// Seconds from the stamp of a sweep, which is that of its first beam, to its middle.
pub(crate) fn seconds_to_middle(sweep: &LaserScan) -> f64 {
    let seconds = f64::from(sweep.time_increment) * (sweep.ranges.len().saturating_sub(1)) as f64 / 2.0;
    // What takes longer than that is no sweep, and what is negative no time.
    if (0.0..2.0).contains(&seconds) { seconds } else { 0.0 }
}

/// A length that was rounded to single precision, as the shortest decimal that rounds to it: a laser that says 1.26 m
/// means that, not 1.2599999904632568 m.
pub(crate) fn length(rounded: f32) -> f64 {
    if rounded.is_finite() {
        rounded.to_string().parse().unwrap_or(f64::from(rounded))
    } else {
        f64::from(rounded)
    }
}

/// An angle in radians of single precision as the shortest number of degrees that rounds to it.
fn degrees(rounded: f32) -> f64 {
    let exact = f64::from(rounded).to_degrees();
    let candidates = (0..9).map(|decimals| {
        let scale = 10_f64.powi(decimals);
        (exact * scale).round() / scale
    });
    candidates
        .filter(|degrees| degrees.to_radians() as f32 == rounded)
        .find(|_| rounded.is_finite())
        .unwrap_or(exact)
}

/// An angle without what a quaternion loses of it: to 10⁻¹² rad.
pub(crate) fn exact(angle: f64) -> f64 {
    (angle * 1e12).round() / 1e12
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::ros::message::Header;

    fn sweep(angle_min: f32, angle_increment: f32, ranges: &[f32]) -> LaserScan {
        let header = Header { stamp: 0, frame: String::new() };
        let (range_min, range_max) = (0.1, 10.0);
        LaserScan {
            header,
            angle_min,
            angle_increment,
            time_increment: 0.0,
            range_min,
            range_max,
            ranges: ranges.to_vec(),
        }
    }

    /// However a laser is made and mounted, its beams point where the message says.
    #[test]
    fn beams_point_where_they_are_told_to() {
        for beams in [1, 2, 5, 180, 181, 360] {
            for (first, step) in [(-1.2, 0.01), (0.0, 0.017), (3.0, -0.0171), (-3.1, 0.0175), (2.0, 0.004)] {
                for (roll, yaw) in
                    [(0.0, 0.0), (0.0, 2.5), (std::f64::consts::PI, 0.0), (std::f64::consts::PI, -1.0)]
                {
                    let ranges: Vec<f32> = (0..beams).map(|beam| 1.0 + beam as f32 / 100.0).collect();
                    let pose = Isometry3::from_parts(
                        nalgebra::Translation3::identity(),
                        UnitQuaternion::from_euler_angles(roll, 0.0, yaw),
                    );
                    let scan = scan(&sweep(first, step, &ranges), &Mount::of(&pose)).unwrap();
                    // What is beyond a whole turn is left out.
                    for (beam, &range) in ranges.iter().enumerate().take(scan.ranges.len()) {
                        let angle = f64::from(first) + beam as f64 * f64::from(step);
                        let told = pose.rotation * Vector3::new(angle.cos(), angle.sin(), 0.0);
                        let found =
                            scan.ranges.iter().position(|&found| (found - f64::from(range)).abs() < 1e-6);
                        let found = scan.direction(found.unwrap());
                        assert!(
                            (found - told.xy()).norm() < 1e-4,
                            "{beams} {first} {step} {roll} {yaw} {beam}"
                        );
                    }
                    assert!(beams < 2 || scan.bearing(1) > scan.bearing(0));
                }
            }
        }
    }

    #[test]
    fn ranges_are_as_rep_117_has_them() {
        let told = [1.26, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 0.0, 0.05, 10.0, 10.5, 0.1];
        let read = scan(&sweep(0.0, 0.1, &told), &Mount::USUAL).unwrap().ranges;
        let inf = f64::INFINITY;
        assert_eq!(read, [1.26, inf, inf, inf, inf, inf, 10.0, inf, 0.1]);
    }

    #[test]
    fn round_angles_are_meant() {
        for told in [-90.0, 0.25, 0.5, 1.0, 0.3515625, 135.0, -180.0, 0.36] {
            assert_eq!(degrees(f64::to_radians(told) as f32), told);
        }
        let half =
            scan(&sweep(-std::f32::consts::FRAC_PI_2, f32::to_radians(1.0), &[1.0; 180]), &Mount::USUAL)
                .unwrap();
        assert_eq!((half.view, half.turn), (std::f64::consts::PI, 0.0));
    }

    #[test]
    fn angles_that_are_none_are_refused() {
        assert_eq!(scan(&sweep(0.0, 0.0, &[1.0; 3]), &Mount::USUAL), Err(SweepProblem::Angles));
        assert_eq!(scan(&sweep(f32::NAN, 0.1, &[1.0; 3]), &Mount::USUAL), Err(SweepProblem::Angles));
        assert_eq!(scan(&sweep(0.0, 0.1, &[]), &Mount::USUAL), Err(SweepProblem::Beams));
        assert_eq!(scan(&sweep(0.0, 0.1, &[1.0; 300]), &Mount::USUAL).unwrap().ranges.len(), 62);
    }
}
