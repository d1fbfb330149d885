//! Reading logs: what is in them, what is wrong with them, and where.

use std::f64::consts::PI;
use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;
use hssh_local::{LaserKind, LaserLog, LaserMount, LogError, LogPosition, LogWarning};
use hssh_metrics::Pose;

/// Three beams are enough to see everything.
const LOG: &str = "\
# a comment
PARAM robot_front_laser_max 20.0 nohost 0
ODOM 0 0 0 0 0 0 0.1 nohost 0.1
FLASER 3 1.5 20.0 2.5 9 9 9 0.5 0 0.1 0.2 nohost 0.2
RLASER 2 1 1 0 0 0 0 0 0 0.2 nohost 0.2
FLASER 3 1.5 0 2.5 9 9 9 1.0 0 0.1 0.3 nohost 0.3
";

pub(super) fn read(text: &str) -> Result<LaserLog, LogError> {
    LaserLog::read(text.as_bytes())
}

fn gzip(text: &str) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(text.as_bytes()).unwrap();
    encoder.finish().unwrap()
}

/// The warnings of a log that is right but for one more line at its end, without that its second laser is not used.
fn warnings(line: &str) -> Vec<String> {
    let log = read(&format!("{LOG}{line}")).unwrap();
    assert_eq!(log.scans.len(), 2, "{line}");
    let mut told: Vec<String> = log.warnings.iter().map(LogWarning::to_string).collect();
    let second = told.iter().position(|warning| warning.starts_with("scans of a second laser"));
    told.remove(second.expect("it is said that it is not used"));
    told
}

#[test]
fn scans_and_raw_odometry_come_out_in_order() {
    let log = read(LOG).unwrap();
    assert_eq!(log.beams(), 3);
    assert_eq!(log.scans[0].scan.ranges, [1.5, f64::INFINITY, 2.5]);
    assert_eq!(log.scans[1].scan.ranges, [1.5, f64::INFINITY, 2.5]);
    assert_eq!(log.scans[0].odometry, Pose::new(0.5, 0.0, 0.1));
    assert_eq!(log.scans[0].corrected, Pose::new(9.0, 9.0, 9.0));
    assert_eq!(log.trajectory.len(), 3);
    assert_eq!((log.scans[0].moment, log.scans[1].moment), (1, 2));
    assert_eq!([log.scans[0].at, log.scans[1].at], [4, 6].map(LogPosition::Line));
    assert_eq!((log.scans[0].time, log.scans[1].time), (Some(0.2), Some(0.3)));
    assert_eq!((log.skipped["#"], log.skipped["RLASER"]), (1, 1));
    assert!(
        matches!(log.warnings[..], [LogWarning::Remark { is_loss: false, .. }]),
        "a second laser is not used"
    );
}

#[test]
fn compressed_or_not_is_all_the_same() {
    assert_eq!(LaserLog::read(&gzip(LOG)[..]).unwrap(), read(LOG).unwrap());
}

#[test]
fn nothing_comes_back_from_fifty_metres_where_the_log_says_nothing() {
    let log = read("FLASER 2 49.9 50 0 0 0 0 0 0 0 h 0\n").unwrap();
    assert_eq!(log.scans[0].scan.ranges, [49.9, f64::INFINITY]);
}

#[test]
fn a_bad_message_is_left_out_with_line_and_word() {
    for (line, expected) in [
        ("FLASER 3 1 1 1x 0 0 0 0 0 0 0 h 0\n", "line 7: FLASER left out: word 5, `1x`, is no finite number"),
        (
            "FLASER 4 1 1 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: the message has 14 words, but 4 beams take 15",
        ),
        (
            "FLASER -1 1 1 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: word 2, `-1`, is no number of beams between 1 and 100000",
        ),
        (
            "FLASER 24 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 0 0 0 1 0 0.1 0 h 0\n",
            "line 7: FLASER left out: the scan has 24 beams, but most scans have 3",
        ),
        ("ODOM 1e15 2 0\n", "line 7: ODOM left out: word 2, `1e15`, is no place where a robot may be"),
        ("ODOM 1 2\n", "line 7: ODOM left out: the message ends after 3 words, 4 are needed"),
    ] {
        assert_eq!(warnings(line), [expected]);
    }
}

#[test]
fn a_log_that_breaks_off_is_used_up_to_there() {
    let broken = warnings("FLASER 3 1 1");
    assert_eq!(broken.len(), 1);
    assert!(broken[0].starts_with("line 7: the log breaks off here"), "{}", broken[0]);

    let whole = gzip(&LOG.repeat(200));
    let log = LaserLog::read(&whole[..whole.len() / 2]).unwrap();
    assert!((1..400).contains(&log.scans.len()));
    // Each of the 200 begins anew.
    let others = log.warnings.iter().filter(|warning| !matches!(warning, LogWarning::Jump { .. }));
    let others: Vec<&LogWarning> = others.collect();
    assert!(
        matches!(others[..], [LogWarning::Remark { .. }, LogWarning::BreaksOff { .. }]),
        "{:?}",
        log.warnings
    );
}

#[test]
fn what_is_no_log_of_a_laser_says_so() {
    assert!(matches!(read(""), Err(LogError::Empty)));
    let refusal = |text: &str| read(text).unwrap_err().to_string();
    assert_eq!(
        refusal("ODOM 0 0 0\nROBOTLASER1 0 0 0\n"),
        "the log has no usable laser scan: 2 lines, among them 1 ODOM; line 2: ROBOTLASER1 left out: the message ends after 4 words, 5 are needed; \
         a log needs FLASER, RAWLASER or ROBOTLASER messages"
    );
    assert!(refusal("FLASER 1 x 0 0 0 0 0 0\n").contains("line 1: FLASER left out: word 3, `x`"));
    assert!(LaserLog::read(&vec![b'a'; 9 << 20][..]).unwrap_err().to_string().contains("no CARMEN log"));
}

/// A log of a straight drive: one scan a line, each with these ranges, from these poses.
fn drive(ranges: &str, poses: &[[f64; 3]]) -> String {
    let beams = ranges.split_whitespace().count();
    let line = |(index, [x, y, theta]): (usize, &[f64; 3])| {
        format!("FLASER {beams} {ranges} 7 8 9 {x} {y} {theta} {index} h {index}\n")
    };
    poses.iter().enumerate().map(line).collect()
}

/// Poses half a metre apart.
fn straight(count: usize) -> Vec<[f64; 3]> {
    (0..count).map(|index| [0.5 * index as f64, 0.0, 0.0]).collect()
}

/// One beam that brought nothing, however a program writes it, is no reason to lose the others.
#[test]
fn a_beam_without_a_range_is_one_that_brought_nothing() {
    for word in ["inf", "nan", "-1.00", "-inf", "1.#QNAN", "null", "NaN"] {
        let log = read(&drive(&format!("1.5 {word} 2.5"), &straight(3))).unwrap();
        assert_eq!(log.scans.len(), 3, "{word}");
        assert!(log.scans.iter().all(|scan| scan.scan.ranges == [1.5, f64::INFINITY, 2.5]), "{word}");
        let warnings: Vec<String> = log.warnings.iter().map(LogWarning::to_string).collect();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].contains("is no range; that beam and 2 others in 3 scans"), "{warnings:?}");
        assert!(!log.warnings[0].is_loss());
    }
}

#[test]
fn a_line_ends_as_any_system_ends_it() {
    let usual = read(LOG).unwrap();
    for end in ["\r\n", "\r"] {
        let log = read(&LOG.replace('\n', end)).unwrap();
        assert_eq!(log, usual, "{end:?}");
        let bad = read(&format!("{LOG}FLASER 3 x\n").replace('\n', end)).unwrap();
        assert!(bad.warnings.iter().any(|warning| warning.to_string().starts_with("line 7: ")), "{end:?}");
    }
}

#[test]
fn messages_in_small_letters_and_behind_a_mark_are_messages() {
    assert_eq!(read(&LOG.to_lowercase()).unwrap().scans, read(LOG).unwrap().scans);
    assert_eq!(read(&LOG.replace('\n', "\r\n")).unwrap().scans, read(LOG).unwrap().scans);
}

/// The scans of which it is not known how they look are left out, not all but those that are like the first.
#[test]
fn the_usual_number_of_beams_counts() {
    let text = format!("FLASER 4 1 1 1 1 0 0 0 0 0 0 0 h 0\n{}", drive("1 2 3 4 5 6 7", &straight(4)));
    let log = read(&text).unwrap();
    assert_eq!((log.scans.len(), log.beams(), log.warnings.len()), (4, 7, 1));
    assert!(log.warnings[0].is_loss());
}

/// A laser that tells its last beam now and then, or every second one only, looks as wide as ever.
#[test]
fn every_scan_has_its_own_beams() {
    let wall = |step: f64, beams: usize| {
        (0..beams).map(|beam| format!("{} ", 2.0 + beam as f64 * step)).collect::<String>()
    };
    let scans = [wall(0.1, 180), wall(0.1, 181), wall(0.2, 90), wall(0.05, 361), wall(0.1, 181)];
    let text: String = scans
        .iter()
        .enumerate()
        .map(|(index, ranges)| {
            format!(
                "FLASER {} {ranges} 7 8 9 {index} 0 0 {index} h {index}\n",
                ranges.split_whitespace().count()
            )
        })
        .collect();
    let log = read(&text).unwrap();
    assert_eq!((log.scans.len(), log.beams()), (5, 181));
    assert!(log.warnings.is_empty(), "{:?}", log.warnings);
    for scan in &log.scans {
        for beam in 0..scan.scan.ranges.len() {
            let degrees = scan.scan.bearing(beam).to_degrees() + 90.0;
            assert!((scan.scan.ranges[beam] - (2.0 + 0.1 * degrees)).abs() < 1e-9, "{degrees}");
        }
    }
}

/// The limit counts wherever it stands, and where it does not stand, the readings tell it.
#[test]
fn the_limit_of_the_laser_is_that_of_the_whole_log() {
    let scans = drive("1.5 8.19 2.5 8.19 8.19 8.19", &straight(10));
    for text in [
        scans.clone(),
        format!("{scans}PARAM robot_front_laser_max 8.0 h 0\n"),
        format!("PARAM robot_front_laser_max 80 h 0\n{scans}"),
    ] {
        let log = read(&text).unwrap();
        let back = log.scans[0].scan.ranges.iter().filter(|range| range.is_finite()).count();
        assert_eq!(back, 2, "{text}");
    }
    let told = read(&scans).unwrap().warnings[0].to_string();
    assert!(told.contains("40 readings are 8.19 m") && told.contains("robot_front_laser_max"), "{told}");
    // Walls at many distances are walls.
    let walls: String = (0..30).map(|beam| format!("{} ", 5.0 + 0.1 * f64::from(beam))).collect();
    assert!(read(&drive(walls.trim(), &straight(10))).unwrap().warnings.is_empty());
}

#[test]
fn nothing_is_made_of_a_log_in_which_nothing_came_back() {
    let refusal = |ranges: &str| read(&drive(ranges, &straight(9))).unwrap_err().to_string();
    assert!(refusal("1500 2500 3200").contains("are the ranges millimetres?"));
    assert!(refusal("80 80 80").contains("robot_front_laser_max"));
    assert!(refusal("inf nan inf").contains("0 of 27 beams"));
}

/// The laser is where the parameter says or, in a log that nobody corrected, where its pose is seen from the robot's.
#[test]
fn the_laser_sits_where_the_log_says() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let scans = drive("1 2 3", &[[0.0, 0.0, 0.0], [1.0, 0.0, quarter]]);
    let by_parameter = read(&format!("{scans}PARAM robot_frontlaser_offset 0.35 h 0\n")).unwrap();
    assert!((by_parameter.scans[0].odometry.x - 0.35).abs() < 1e-12);
    assert!((by_parameter.scans[1].odometry.y - 0.35).abs() < 1e-12);
    assert!(by_parameter.warnings[0].to_string().contains("0.35 m ahead"));

    let told =
        format!("FLASER 2 1 1 0.2 0.1 0 0 0 0 0 h 0\nFLASER 2 1 1 0.9 0.2 {quarter} 1 0 {quarter} 1 h 1\n");
    let by_poses = read(&told).unwrap();
    assert!((by_poses.scans[1].odometry.x - 0.9).abs() < 1e-9, "{:?}", by_poses.scans[1].odometry);
    assert!(read(&scans).unwrap().warnings.is_empty(), "corrected poses are no offset");
}

/// What jumps is bridged by the step before, and said; what a robot may do in the time is no jump.
#[test]
fn the_odometry_may_start_anew() {
    let mut poses = straight(20);
    poses[10..].iter_mut().for_each(|pose| pose[0] -= 25.0);
    let log = read(&drive("1 2 3", &poses)).unwrap();
    assert!(
        log.warnings[0].to_string().contains("line 11: the odometry jumps by 24.5 m"),
        "{:?}",
        log.warnings
    );
    for (index, scan) in log.scans.iter().enumerate() {
        assert!((scan.odometry.x - 0.5 * index as f64).abs() < 1e-9, "{index}: {:?}", scan.odometry);
        assert_eq!(log.trajectory[scan.moment], scan.odometry);
    }
    // A glitch of one line is two jumps.
    let mut poses = straight(20);
    poses[10][0] = 500.0;
    let log = read(&drive("1 2 3", &poses)).unwrap();
    assert_eq!(log.warnings.len(), 2);
    assert!((log.scans[19].odometry.x - 9.5).abs() < 0.6);
    // Absurd numbers are left out, and nothing is lost but the scan.
    for x in ["1e15", "1e308", "-1e9"] {
        let text = drive("1 2 3", &straight(20)).replace(" 5 0 0 10 h", &format!(" {x} 0 0 10 h"));
        let log = read(&text).unwrap();
        assert_eq!((log.scans.len(), log.warnings.len()), (19, 1), "{x}");
    }
}

/// Between dense lines of odometry no robot goes metres, however long it is from scan to scan; and who is suddenly where all counting begins was
/// not driven there, however long that took.
#[test]
fn odometry_that_begins_anew_nearby_is_a_jump() {
    let lines = |scan: u32, x: f64| {
        let odometry: String =
            (0..20).map(|k| format!("ODOM {} 0 0 0 0 0 0 h 0\n", x + 0.025 * f64::from(k))).collect();
        let end = x + 0.5;
        format!("{odometry}FLASER 3 1 2 3 7 8 9 {end} 0 0 {} h 0\n", 3 * scan)
    };
    let dense: String =
        (0..20).map(|scan| lines(scan, 0.5 * f64::from(scan) - if scan < 10 { 0.0 } else { 5.01 })).collect();
    let jumps = |text: &str| {
        let log = read(text).unwrap();
        log.warnings.iter().filter(|warning| matches!(warning, LogWarning::Jump { .. })).count()
    };
    assert_eq!(jumps(&dense), 1);
    let usual: String = (0..20).map(|scan| lines(scan, 0.5 * f64::from(scan))).collect();
    assert_eq!(jumps(&usual), 0);
    let mut poses = straight(20);
    poses[4..].iter_mut().for_each(|pose| pose[0] -= 2.0);
    assert_eq!(jumps(&drive("1 2 3", &poses)), 1);
    poses[4..].iter_mut().for_each(|pose| pose[0] += 0.001);
    assert_eq!(jumps(&drive("1 2 3", &poses)), 0, "it drove back");
}

/// What the user says of the laser's place counts more than the log.
#[test]
fn the_laser_sits_where_it_is_said_to() {
    let log = "PARAM robot_frontlaser_offset 0.2 h 0\nFLASER 2 1 1 5 5 0 5 5 0 0 h 0\nFLASER 2 1 1 6 5 0 6 5 0 1 h 1\n";
    let known = LaserMount { view: None, pose: Some(Pose::new(0.5, 0.1, 0.0)) };
    let log = LaserLog::read_with(log.as_bytes(), &known).unwrap();
    let off = log.scans[0].odometry.between(Pose::new(5.5, 5.1, 0.0));
    assert!(off.translation().norm() < 1e-12);
}

/// Two scans of three beams from −135° in steps of 90°, 0.2 m ahead of the robot's axis.
const ROBOT_LASER: &str = "\
ODOM 1 0 0 0 0 0 0.5 host 0.5
RAWLASER1 0 -2.356194 4.712389 1.570796 30 0.01 0 4 1.5 30.5 2.5 3.5 0 0.6 host 0.6
ROBOTLASER1 0 -2.356194 4.712389 1.570796 30 0.01 0 4 1.5 30.5 2.5 3.5 2 9 9 1.2 0 0 1 0 0 0 0 0.5 0.5 1 0.6 host 0.6
ROBOTLASER1 0 -2.356194 4.712389 1.570796 30 0.01 0 4 1.5 30.5 2.5 3.5 0 2.2 0 0 2 0 0 0 0 0.5 0.5 1 0.7 host 0.7
";

#[test]
fn lasers_that_say_how_they_look_are_believed() {
    let log = read(ROBOT_LASER).unwrap();
    assert_eq!((log.scans.len(), log.skipped["RAWLASER1"]), (2, 1));
    let scan = &log.scans[0].scan;
    assert_eq!(scan.ranges, [1.5, f64::INFINITY, 2.5, 3.5]);
    let bearings: Vec<f64> = (0..4).map(|beam| scan.bearing(beam).to_degrees().round()).collect();
    assert_eq!(bearings, [-135.0, -45.0, 45.0, 135.0]);
    assert!((log.scans[1].odometry.x - 2.2).abs() < 1e-9 && log.scans[1].time == Some(0.7));
    let raw = read(&ROBOT_LASER.replace("ROBOTLASER1", "OTHER")).unwrap();
    assert_eq!((raw.scans.len(), raw.scans[0].odometry.x), (1, 1.0));
    let broken = ROBOT_LASER.replace("2 9 9 1.2", "900 9 9 1.2");
    assert_eq!(read(&broken).unwrap().scans.len(), 1);
}

/// A drive through a room, x from −2 to 4 and y from −2 to 2, with a laser ahead of the axis and one behind it, which see half a turn each; the
/// second one's messages follow those of the first.
fn two_lasers(message: impl Fn(LaserKind, &str, Pose, Pose, f64) -> String) -> String {
    let mounts =
        [(LaserKind::Front, Pose::new(0.3, 0.1, 0.0)), (LaserKind::Rear, Pose::new(-0.25, -0.2, PI))];
    let mut log = String::new();
    for step in 0..60 {
        for (kind, mount) in mounts {
            let time = f64::from(step) * 0.1 + if kind == LaserKind::Rear { 0.04 } else { 0.0 };
            let robot = in_the_room(time);
            let laser = robot.compose(mount);
            let beams = (0..181).map(|beam| wall(laser, f64::to_radians(f64::from(beam) - 90.0)));
            let beams = beams.map(|range| format!("{range:.3}")).collect::<Vec<_>>().join(" ");
            log += &message(kind, &beams, laser, robot, time);
        }
    }
    log
}

fn in_the_room(time: f64) -> Pose {
    Pose::new(0.3 * time, 0.1 * time, 0.4 * time)
}

/// How far a wall of the room is.
fn wall(from: Pose, bearing: f64) -> f64 {
    let (sin, cos) = (from.theta + bearing).sin_cos();
    let walls = [(4.0 - from.x) / cos, (-2.0 - from.x) / cos, (2.0 - from.y) / sin, (-2.0 - from.y) / sin];
    walls.into_iter().filter(|range| *range > 0.0).fold(f64::INFINITY, f64::min)
}

fn flaser(kind: LaserKind, beams: &str, laser: Pose, robot: Pose, time: f64) -> String {
    let poses = format!("{} {} {} {} {} {}", laser.x, laser.y, laser.theta, robot.x, robot.y, robot.theta);
    format!("{} 181 {beams} {poses} {time} nohost {time}\n", kind.name())
}

fn robotlaser(kind: LaserKind, beams: &str, laser: Pose, robot: Pose, time: f64) -> String {
    let name = if kind == LaserKind::Front { "ROBOTLASER1" } else { "ROBOTLASER2" };
    let poses = format!("{} {} {} {} {} {}", laser.x, laser.y, laser.theta, robot.x, robot.y, robot.theta);
    format!(
        "{name} 0 -1.5707963 3.1415926 0.0174532925 30 0.01 0 181 {beams} 0 {poses} 0 0 0 0 0 {time} nohost {time}\n"
    )
}

#[test]
fn two_lasers_see_the_walls_all_around() {
    let front_and_rear = [LaserKind::Front, LaserKind::Rear];
    let robot = [LaserKind::Robot, LaserKind::RobotRear];
    for (text, chosen) in [(two_lasers(flaser), front_and_rear), (two_lasers(robotlaser), robot)] {
        let alone = read(&text).unwrap();
        assert!(
            alone.warnings.iter().any(|warning| warning.to_string().contains("--scan")),
            "a laser is not used"
        );
        let log = LaserLog::read_lasers(text.as_bytes(), &LaserMount::default(), &chosen).unwrap();
        assert_eq!((log.scans.len(), alone.scans.len()), (60, 60));
        let merged = format!("merged with 60 scans of {}, of a laser -0.25 m ahead", chosen[1].name());
        assert!(log.warnings.iter().any(|warning| warning.to_string().starts_with(&merged)), "{merged}");
        for (step, logged) in log.scans.iter().enumerate() {
            let laser = in_the_room(step as f64 * 0.1).compose(Pose::new(0.3, 0.1, 0.0));
            assert!(laser.between(logged.odometry).translation().norm() < 1e-6);
            let hits: Vec<_> = logged.scan.hits(50.0).collect();
            assert!(hits.len() > 300, "{}", hits.len());
            for (beam, hit) in hits {
                let at = laser.translation() + laser.rotation() * hit;
                let off = [at.x + 2.0, 4.0 - at.x, at.y + 2.0, 2.0 - at.y].map(f64::abs);
                // Half a degree of the direction, aslant.
                assert!(off.into_iter().fold(f64::MAX, f64::min) < 0.06, "scan {step}, beam {beam}: {at}");
            }
        }
    }
}

/// Where poses do not tell, the parameter does, whatever its sign; sweeps of another moment are not merged.
#[test]
fn a_rear_laser_sits_where_the_log_says() {
    let chosen = [LaserKind::Front, LaserKind::Rear];
    for said in ["-0.25", "0.25"] {
        let text = format!(
            "PARAM robot_rearlaser_offset {said} nohost 0\nFLASER 3 2 2 2 9 9 9 0 0 0 0.1 nohost 0.1\nRLASER 3 1 1 1 8 8 8 0 0 0 0.1 nohost 0.1\nFLASER 3 2 2 2 9 9 9 0.1 0 0 0.9 nohost 0.9\n"
        );
        let log = LaserLog::read_lasers(text.as_bytes(), &LaserMount::default(), &chosen).unwrap();
        let behind =
            |scan: usize| log.scans[scan].scan.hits(50.0).find(|(_, hit)| hit.x < -0.5 && hit.y.abs() < 0.1);
        assert!((behind(0).unwrap().1.x + 1.25).abs() < 1e-9);
        assert_eq!(behind(1), None);
    }
}

#[test]
fn a_laser_that_is_not_there_is_named() {
    let asked = [LaserKind::Front, LaserKind::RobotRear];
    let error = LaserLog::read_lasers(LOG.as_bytes(), &LaserMount::default(), &asked).unwrap_err();
    assert_eq!(error.to_string(), "the log has no ROBOTLASER2 messages; it has FLASER, RLASER");
}

#[test]
fn a_rear_laser_looks_back() {
    let rear = LOG.replace("FLASER", "RLASER");
    let log = read(&rear).unwrap();
    let middle = log.scans[0].scan.direction(1);
    assert!((middle.x + 1.0).abs() < 1e-9, "{middle}");
}
