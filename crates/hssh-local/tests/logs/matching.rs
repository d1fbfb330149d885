//! Scan matching: it undoes the errors of odometry where walls tell, and knows where they do not.

use hssh_local::{LaserLog, MatchOptions, Track, TrackedScan, track, track_calibrated};
use hssh_metrics::Pose;

use crate::simulator::{Walls, around, drive, log};

/// Tracks a robot whose odometry turns 2° too much every metre and runs 5% too long.
fn tracked(walls: &Walls, poses: &[Pose]) -> Track {
    tracked_by(walls, poses, &MatchOptions::default())
}

fn tracked_by(walls: &Walls, poses: &[Pose], options: &MatchOptions) -> Track {
    let mut odometry = vec![Pose::IDENTITY];
    for pair in poses.windows(2) {
        let step = pair[0].between(pair[1]);
        let length = step.translation().norm();
        let wrong = Pose::new(1.05 * step.x, 1.05 * step.y, step.theta + 0.035 * length);
        odometry.push(odometry[odometry.len() - 1].compose(wrong));
    }
    let text = log(walls, poses, &odometry);
    track(&LaserLog::read(text.as_bytes()).unwrap(), options, |_| ())
}

fn error(track: &Track, poses: &[Pose]) -> Pose {
    let truth = poses[0].between(poses[poses.len() - 1]);
    truth.between(track.scans[track.scans.len() - 1].pose)
}

#[test]
fn in_a_building_with_corners_the_way_is_found() {
    let walls =
        around(&[[[-2.0, -2.0], [10.0, 2.0]], [[6.0, -2.0], [10.0, 12.0]], [[-2.0, -8.0], [1.0, 2.0]]]);
    let poses = drive(&[[0.0, 0.0], [8.0, 0.0], [8.0, 9.0]], 0.5);
    let error = error(&tracked(&walls, &poses), &poses);
    // Odometry alone is off by about 34° and several metres.
    assert!(error.translation().norm() < 0.15, "{error:?}");
    assert!(error.theta.abs() < 0.02, "{error:?}");
}

/// In an endless corridor nothing tells how far the robot went: odometry decides, and the covariance
/// says that nothing was learned. The walls give the rest.
#[test]
fn along_a_corridor_odometry_decides() {
    let walls = around(&[[[-40.0, -1.0], [60.0, 1.0]]]);
    let poses = drive(&[[0.0, 0.0], [12.0, 0.0]], 0.5);
    let track = tracked(&walls, &poses);
    let motion = track.motion(0, poses.len() - 1).unwrap().unwrap();
    assert!((motion.mean.x - 1.05 * 12.0).abs() < 0.05, "{:?}", motion.mean);
    // Odometry alone would have turned by 24°.
    assert!(motion.mean.y.abs() < 0.25 && motion.mean.theta.abs() < 0.04, "{:?}", motion.mean);
    let variances = motion.covariance.matrix().diagonal();
    let odometry = MatchOptions::default().odometry;
    let alone = odometry.distance.powi(2) * 12.6;
    assert!(variances.x > alone, "{variances} must not be less than {alone}");
    assert!(variances.z < 0.1 * odometry.heading.powi(2) * 12.6, "{variances}");
}

/// Doorways on both sides tell how far the robot goes, ahead as well as backward: what comes into view beside the robot, and was behind the laser
/// before, does not speak for standing still.
#[test]
fn who_drives_backward_goes_as_far_as_ahead() {
    let mut boxes = vec![[[-4.0, -1.0], [44.0, 1.0]]];
    for (left, right) in
        [(1.0, 3.5), (7.0, 9.5), (14.5, 12.0), (20.0, 19.0), (25.5, 27.0), (33.0, 31.0), (38.5, 40.0)]
    {
        boxes.push([[left, 1.0], [left + 1.0, 2.0]]);
        boxes.push([[right, -2.5], [right + 1.5, -1.0]]);
    }
    let walls = around(&boxes);
    let ahead = drive(&[[0.0, 0.0], [40.0, 0.0]], 0.75);
    let backward: Vec<Pose> = ahead.iter().rev().copied().collect();
    for poses in [ahead, backward] {
        let track = tracked(&walls, &poses);
        let gone = track.scans[poses.len() - 1].travelled;
        let truth = (poses[0].x - poses[poses.len() - 1].x).abs();
        assert!((gone - truth).abs() < 0.03 * truth, "{gone} instead of {truth}");
    }
}

/// After half a turn on the spot between two scans nothing is in sight that was before: how far the robot turned is known as well as odometry tells,
/// and no better.
#[test]
fn what_was_never_in_sight_tells_nothing() {
    let walls = around(&[[[-9.0, -2.0], [9.0, 2.0]], [[2.0, -6.0], [4.0, 2.0]]]);
    let heading = |step: u32| if step > 6 { std::f64::consts::PI } else { 0.0 };
    let poses: Vec<Pose> = (0..13).map(|step| Pose::new(0.0, 0.0, heading(step))).collect();
    let track = tracked_by_exact_wheels(&walls, &poses);
    assert_eq!(track.lost, [7]);
    let turn = track.scans[7].step.expect("it is not the first");
    assert!(turn.covariance.matrix()[(2, 2)].sqrt() > 0.2, "{turn:?}");
}

fn tracked_by_exact_wheels(walls: &Walls, poses: &[Pose]) -> Track {
    let read = LaserLog::read(log(walls, poses, poses).as_bytes()).unwrap();
    track(&read, &MatchOptions::default(), |_| ())
}

/// Nobody says that the laser is turned by 2°; wheels and scans together do, and what it did to the track is undone.
#[test]
fn a_turned_laser_is_reckoned_with() {
    let turn = 0.035;
    let walls =
        around(&[[[-2.0, -1.5], [26.0, 1.5]], [[6.0, -1.5], [8.0, 8.0]], [[22.0, -1.5], [26.0, 14.0]]]);
    let robot = drive(&[[0.0, 0.0], [24.0, 0.0], [24.0, 12.0]], 0.25);
    let laser: Vec<Pose> = robot.iter().map(|pose| pose.compose(Pose::new(0.0, 0.0, turn))).collect();
    let odometry: Vec<Pose> =
        robot.iter().map(|pose| Pose::new(1.01 * pose.x, 1.01 * pose.y, pose.theta)).collect();
    let text = log(&walls, &laser, &odometry);
    let read = LaserLog::read(text.as_bytes()).unwrap();
    let options = MatchOptions::default();
    let untold = error(&track(&read, &options, |_| ()), &laser).translation().norm();
    let (turned, found) = track_calibrated(read.clone(), &options, |_| ());
    let told = error(&found, &laser).translation().norm();
    let seen = turned.laser_turn.expect("it is clear").angle;
    assert!((seen - turn).abs() < 0.005, "{seen}");
    assert!(told < 0.5 * untold, "{told} {untold}");
    // Who says how the laser sits is believed.
    let given = LaserLog { is_laser_given: true, ..read };
    assert_eq!(track_calibrated(given, &options, |_| ()).0.laser_turn, None);
}

#[test]
fn a_robot_that_sees_nothing_goes_by_odometry() {
    let poses = drive(&[[0.0, 0.0], [3.0, 0.0]], 0.5);
    // One wall, farther away than what is matched.
    let far: Walls = vec![[[25.0, -3.0], [25.0, 3.0]]];
    let track = tracked_by(
        &far,
        &poses,
        &MatchOptions { reach: 20.0, farthest_reach: 20.0, ..MatchOptions::default() },
    );
    let last = track.scans[track.scans.len() - 1];
    assert!((last.travelled - 3.15).abs() < 1e-6, "{last:?}");
}

/// The wheels turned backwards for one step: odometry has it the wrong way round.
#[test]
fn a_reversed_step_is_found_out() {
    let walls =
        around(&[[[-2.0, -2.0], [14.0, 2.0]], [[10.0, -2.0], [14.0, 12.0]], [[2.0, -4.0], [4.0, 2.0]]]);
    let poses = drive(&[[0.0, 0.0], [12.0, 0.0], [12.0, 9.0]], 0.25);
    for reversed in [10, 25, 60] {
        let mut odometry = vec![Pose::IDENTITY];
        for (index, pair) in poses.windows(2).enumerate() {
            let step = pair[0].between(pair[1]);
            let sign = if index == reversed { -1.0 } else { 1.0 };
            let step = Pose::new(sign * step.x, sign * step.y, step.theta);
            odometry.push(odometry[odometry.len() - 1].compose(step));
        }
        let read = LaserLog::read(log(&walls, &poses, &odometry).as_bytes()).unwrap();
        let off = |options: MatchOptions| error(&track(&read, &options, |_| ()), &poses);
        // Who believes the wheels more is led astray, and finds it out.
        let trusting = MatchOptions { hits_per_observation: 5.0, ..MatchOptions::default() };
        let believed = off(MatchOptions { slip: None, ..trusting });
        assert!(believed.translation().norm() > 0.3, "{reversed}: {believed:?} without looking for it");
        for found in [off(trusting), off(MatchOptions::default())] {
            assert!(found.translation().norm() < 0.1 && found.theta.abs() < 0.02, "{reversed}: {found:?}");
        }
    }
}

/// Over a lawn, 14 m from corner to corner, with wheels that err by so much with each step, twice to one side and twice to the other: by how many
/// metres and radians the track is off at worst.
fn over_a_lawn(walls: &Walls, error: f64) -> (f64, f64) {
    let poses = drive(&[[0.0, 0.0], [14.0, 0.0]], 0.7);
    let mut odometry = vec![Pose::IDENTITY];
    for (step, pair) in poses.windows(2).enumerate() {
        let wrong = Pose { theta: if step % 4 < 2 { error } else { -error }, ..pair[0].between(pair[1]) };
        odometry.push(odometry[step].compose(wrong));
    }
    let log = LaserLog::read(log(walls, &poses, &odometry).as_bytes()).unwrap();
    let track = track(&log, &MatchOptions::default(), |_| ());
    let off = |(scan, pose): (&TrackedScan, &Pose)| pose.between(scan.pose);
    let offs: Vec<Pose> = track.scans.iter().zip(&poses).map(off).collect();
    let worst = |of: fn(&Pose) -> f64| offs.iter().map(of).fold(0.0, f64::max);
    (worst(|off| off.translation().norm()), worst(|off| off.theta.abs()))
}

/// A house so far away that it jumps by metres when the robot seems to turn.
#[test]
fn a_far_house_holds_the_heading_of_who_crosses_a_lawn() {
    let house = around(&[[[24.0, -12.0], [34.0, -3.0]], [[22.0, 3.0], [34.0, 13.0]]]);
    let (metres, radians) = over_a_lawn(&house, 0.1);
    assert!(metres < 0.2 && radians < 0.01, "{metres} {radians}");
}

/// Five trunks, of which a scan shows a few hits each, and nothing else.
#[test]
fn trunks_hold_the_heading_where_nothing_else_does() {
    let trunk = |[x, y]: [f64; 2]| [[x - 0.25, y - 0.25], [x + 0.25, y + 0.25]];
    let trunks = [[12.0, 6.0], [18.0, -5.0], [24.0, 4.0], [27.0, -9.0], [9.0, -8.0]].map(trunk);
    let (metres, radians) = over_a_lawn(&around(&trunks), 0.03);
    assert!(metres < 0.3 && radians < 0.03, "{metres} {radians}");
}
