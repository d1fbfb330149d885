//! Scans of several lasers of one robot as scans of one that looks all around from where the first of them sits.
//!
//! A hit of another laser is moved by the odometry to where the robot was when the first one looked.

use hssh_local::{RecordedScan, Scan, TimedPose, scan_around};
use hssh_metrics::Pose;

/// A sweep that was taken longer before or after than this is not of the same moment: seconds.
const TOGETHER: f64 = 0.25;

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
            let seen = |(other, recorded): &(&Other, &'_ RecordedScan)| {
                let [from, to] = [at, other.at].map(|[x, y]| Pose::new(x, y, 0.0));
                from.between(moved(odometry, first.time, recorded.time).compose(to))
            };
            let others: Vec<(&Scan, Pose)> = near.iter().map(|pair| (&pair.1.scan, seen(pair))).collect();
            let around = scan_around(&first.scan, &others);
            RecordedScan { scan: around, time: first.time }
        })
        .collect()
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
