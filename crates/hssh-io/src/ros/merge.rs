//! Scans of several lasers of one robot as scans of one that looks all around from where the first of them sits.
//!
//! A hit of another laser is moved to where the robot was when the first one looked, and lies in the direction in which it is seen from there; of
//! hits in one direction the nearest counts. Where no laser hit anything, nothing is known. What a laser hit that the first one
//! could not have seen, behind a corner of the robot's own width, stays in its direction: the lasers of one robot are near one another.

use std::f64::consts::TAU;

use hssh_local::{RecordedScan, Scan, TimedPose};
use hssh_metrics::Pose;
use nalgebra::Vector2;

/// A sweep that was taken longer before or after than this is not of the same moment: seconds.
const TOGETHER: f64 = 0.25;
/// A merged scan has no more beams.
const MOST_BEAMS: f64 = 3_000.0;

/// What another laser saw, from where it sits: metres ahead of the robot's axis and to its left.
pub(crate) struct Other {
    pub(crate) at: [f64; 2],
    /// In order of their times.
    pub(crate) scans: Vec<RecordedScan>,
}

/// The scans of the laser at `at`, each with what the others saw at about that time.
pub(crate) fn merged(
    scans: &[RecordedScan],
    at: [f64; 2],
    others: &[Other],
    odometry: &[TimedPose],
) -> Vec<RecordedScan> {
    scans
        .iter()
        .map(|first| {
            let near = others.iter().filter_map(|other| Some((other, nearest(&other.scans, first.time)?)));
            let near: Vec<(&Other, &RecordedScan)> = near.collect();
            let lasers = near.iter().map(|(_, recorded)| &recorded.scan).chain([&first.scan]);
            let finest = lasers.map(step).fold(f64::INFINITY, f64::min);
            let beams = 2.0 * (TAU / finest / 2.0).clamp(1.0, MOST_BEAMS / 2.0).round();
            let mut around = Scan { ranges: vec![f64::INFINITY; beams as usize], view: TAU, turn: 0.0 };
            first.scan.hits(f64::INFINITY).for_each(|(_, hit)| add(&mut around, hit));
            for (other, recorded) in near {
                let moved = moved(odometry, first.time, recorded.time);
                let [from, to] = [at, other.at].map(Vector2::from);
                for (_, hit) in recorded.scan.hits(f64::INFINITY) {
                    add(&mut around, moved.translation() + moved.rotation() * (hit + to) - from);
                }
            }
            RecordedScan { scan: around, time: first.time }
        })
        .collect()
}

/// The angle between two beams.
fn step(scan: &Scan) -> f64 {
    scan.view / (scan.ranges.len() - scan.ranges.len() % 2).max(1) as f64
}

/// Adds a point that was hit.
fn add(around: &mut Scan, hit: Vector2<f64>) {
    let beams = around.ranges.len() as f64;
    let beam = ((hit.y.atan2(hit.x) / TAU + 0.5) * beams).round() as usize % around.ranges.len();
    around.ranges[beam] = around.ranges[beam].min(hit.norm());
}

/// The scan whose time is nearest, if it is of the same moment.
fn nearest(scans: &[RecordedScan], time: f64) -> Option<&RecordedScan> {
    let behind = scans.partition_point(|scan| scan.time < time);
    let around = scans[behind.saturating_sub(1)..].iter().take(2);
    let off = |scan: &&RecordedScan| (scan.time - time).abs();
    around.min_by(|one, other| off(one).total_cmp(&off(other))).filter(|scan| off(scan) <= TOGETHER)
}

/// The robot at another time, seen from where it was at a time.
fn moved(odometry: &[TimedPose], time: f64, other: f64) -> Pose {
    match (pose_at(odometry, time), pose_at(odometry, other)) {
        (Some(from), Some(to)) => from.between(to),
        _ => Pose::IDENTITY,
    }
}

/// Where the robot was between two readings, as if it moved evenly.
fn pose_at(odometry: &[TimedPose], time: f64) -> Option<Pose> {
    let behind = odometry.partition_point(|reading| reading.time < time);
    let (before, after) = (odometry.get(behind.checked_sub(1)?)?, odometry.get(behind)?);
    let part = (time - before.time) / (after.time - before.time);
    let step = before.pose.between(after.pose);
    Some(before.pose.compose(Pose::new(part * step.x, part * step.y, part * step.theta)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    /// From a place in a room, x from −2 to 4 and y from −2 to 2, how far a wall is.
    fn range(from: Pose, bearing: f64) -> f64 {
        let (sin, cos) = (from.theta + bearing).sin_cos();
        let walls =
            [(4.0 - from.x) / cos, (-2.0 - from.x) / cos, (2.0 - from.y) / sin, (-2.0 - from.y) / sin];
        walls.into_iter().filter(|range| *range > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// A half-turn laser on a robot that turns and drives.
    fn laser(at: [f64; 2], turn: f64, time: f64) -> RecordedScan {
        let place = robot(time).compose(Pose::new(at[0], at[1], 0.0));
        let mut scan = Scan { ranges: vec![0.0; 181], view: PI, turn };
        scan.ranges = (0..181).map(|beam| range(place, scan.bearing(beam))).collect();
        RecordedScan { scan, time }
    }

    fn robot(time: f64) -> Pose {
        Pose::new(time, 0.3 * time, 0.4 * time)
    }

    #[test]
    fn two_lasers_see_the_walls_all_around() {
        let odometry: Vec<TimedPose> = (-10..20)
            .map(|step| f64::from(step) * 0.05)
            .map(|time| TimedPose { time, pose: robot(time) })
            .collect();
        let (front, rear) = ([0.3, 0.1], [-0.25, -0.2]);
        let first = [laser(front, 0.2, 0.3)];
        let behind = Other { at: rear, scans: [0.1, 0.35, 0.7].map(|time| laser(rear, PI, time)).into() };
        let found = merged(&first, front, &[behind], &odometry);
        let place = robot(0.3).compose(Pose::new(front[0], front[1], 0.0));
        let hits: Vec<_> = found[0].scan.hits(50.0).collect();
        assert!(hits.len() > 300, "{}", hits.len());
        for (beam, hit) in hits {
            let at = place.translation() + place.rotation() * hit;
            let off = [at.x + 2.0, 4.0 - at.x, at.y + 2.0, 2.0 - at.y].map(f64::abs);
            // Half a degree of the direction, aslant.
            assert!(off.into_iter().fold(f64::MAX, f64::min) < 0.06, "beam {beam}: {at}");
        }
        // Both sides are seen, and without the other laser only the first one's.
        assert!(found[0].scan.ranges[10].is_finite());
        let alone = merged(&first, front, &[], &odometry);
        assert!(alone[0].scan.ranges[10].is_infinite());
        assert_eq!(alone[0].scan.hits(50.0).count(), 181);
    }

    #[test]
    fn sweeps_of_another_moment_are_not_merged() {
        let other = Other { at: [0.0; 2], scans: vec![laser([0.0; 2], FRAC_PI_2, 5.0)] };
        let found = merged(&[laser([0.0; 2], 0.0, 0.0)], [0.0; 2], &[other], &[]);
        assert_eq!(found[0].scan.hits(50.0).count(), 181);
    }
}
