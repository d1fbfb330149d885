//! What a log's own numbers contradict is doubted: the view, the turn and the reach of its laser, the unit, the hand and the order of its
//! odometry.

use std::f64::consts::{FRAC_PI_2, PI};

use hssh_local::{LaserLog, LaserMount, LogWarning};
use hssh_metrics::Pose;

use super::carmen::read;

/// A log of a robot that turns on the spot in a room of uneven walls, with a laser that looks so wide, in degrees.
fn turning(view: f64, beams: usize, first: &str) -> String {
    let wall = |bearing: f64| 4.0 + (3.0 * bearing).sin() + 0.6 * (7.0 * bearing).cos();
    let mut log = first.to_owned();
    for step in 0..60_u32 {
        let heading = 0.07 * f64::from(step);
        let beam = |beam: usize| view.to_radians() * (beam as f64 / (beams - beams % 2) as f64 - 0.5);
        let ranges: Vec<String> =
            (0..beams).map(|index| format!("{:.3}", wall(heading + beam(index)))).collect();
        let pose = format!("0 0 {heading:.5}");
        log += &format!("FLASER {beams} {} {pose} {pose} {step} h {step}\n", ranges.join(" "));
    }
    log
}

fn view_doubted(log: &LaserLog) -> Option<(f64, bool)> {
    log.warnings.iter().find_map(|warning| match warning {
        LogWarning::View { seen, is_told, .. } => Some((seen.to_degrees(), *is_told)),
        _ => None,
    })
}

#[test]
fn a_view_that_contradicts_the_turns_is_doubted() {
    for (view, beams) in [(240.0, 240), (270.0, 541), (360.0, 360), (100.0, 101), (120.0, 240)] {
        let log = turning(view, beams, "");
        let (seen, is_told) = view_doubted(&read(&log).unwrap()).unwrap();
        assert!((seen / view - 1.0).abs() < 0.05 && !is_told, "{view}: {seen}");
        let known = LaserMount { view: Some(f64::to_radians(view)), pose: None };
        let known = LaserLog::read_with(log.as_bytes(), &known).unwrap();
        assert_eq!(view_doubted(&known), None, "{view}");
        assert!((known.scans[0].scan.bearing(0).to_degrees() + view / 2.0).abs() < 1e-9);
        let told = read(&turning(view, beams, &format!("PARAM laser_front_laser_fov {view} h 0\n"))).unwrap();
        assert_eq!(view_doubted(&told), None, "{view}");
        assert!(told.scans.iter().zip(&known.scans).all(|(one, other)| one.scan == other.scan), "{view}");
    }
    for beams in [180, 181, 361] {
        assert_eq!(view_doubted(&read(&turning(180.0, beams, "")).unwrap()), None);
    }
    let wrong = read(&turning(180.0, 181, "PARAM laser_front_laser_fov 270 h 0\n")).unwrap();
    assert!(view_doubted(&wrong).is_some_and(|(_, is_told)| is_told));
}

/// A log of a robot that drives ahead in a room with a pillar in each corner, its laser turned by so much.
fn driving(facing: f64, is_mirrored: bool) -> String {
    let pillars = [[7.0, 2.0], [6.0, -3.0], [-6.0, 2.5], [-7.0, -2.0], [1.5, 3.5], [2.5, -3.5]];
    let range = |x: f64, heading: f64| {
        let (s, c) = heading.sin_cos();
        let walls = [(9.0 - x) / c, (-9.0 - x) / c, 4.0 / s, -4.0 / s];
        let pillar = |[px, py]: [f64; 2]| {
            let (along, aside) = (c * (px - x) + s * py, -s * (px - x) + c * py);
            let half = (0.16 - aside * aside).sqrt(); // NaN where the beam misses it
            if along > 0.0 && half.is_finite() { along - half } else { f64::INFINITY }
        };
        let seen = walls.into_iter().filter(|range| *range > 0.0).chain(pillars.map(pillar));
        seen.fold(f64::INFINITY, f64::min)
    };
    let mut log = String::from("PARAM robot_front_laser_max 30 h 0\n");
    for step in 0..40_u32 {
        let x = -4.0 + 0.2 * f64::from(step);
        let mut ranges: Vec<String> = (0..181_u32)
            .map(|beam| format!("{:.3}", range(x, facing + f64::from(beam).to_radians() - FRAC_PI_2)))
            .collect();
        if is_mirrored {
            ranges.reverse();
        }
        log += &format!("FLASER 181 {} {x:.3} 0 0 {x:.3} 0 0 {step} h {step}\n", ranges.join(" "));
    }
    log
}

/// Nobody says that the laser looks back or aside: the scans do, and the odometry is turned with it, unless somebody knows better.
#[test]
fn a_laser_that_looks_elsewhere_is_reckoned_with() {
    let facing = |log: &LaserLog| {
        log.warnings.iter().find_map(|warning| match warning {
            LogWarning::Facing { seen, is_reckoned } => Some((*seen, *is_reckoned)),
            _ => None,
        })
    };
    assert_eq!(facing(&read(&driving(0.0, false)).unwrap()), None);
    for turned in [PI, FRAC_PI_2, -FRAC_PI_2, 0.7, -2.4] {
        let log = driving(turned, false);
        let found = read(&log).unwrap();
        let (seen, is_reckoned) = facing(&found).unwrap();
        assert!(
            Pose::new(0.0, 0.0, seen - turned).theta.abs() < 0.1 && is_reckoned,
            "{seen} is not {turned}"
        );
        let known = LaserMount { view: None, pose: Some(Pose::new(0.0, 0.0, turned)) };
        let known = LaserLog::read_with(log.as_bytes(), &known).unwrap();
        assert_eq!(facing(&known), None, "{turned}");
        for (one, other) in found.scans.iter().zip(&known.scans) {
            let off = one.odometry.between(other.odometry);
            assert!(off.translation().norm() < 1e-9 && off.theta.abs() < 0.1, "{off:?}");
        }
        let ahead = LaserMount { view: None, pose: Some(Pose::IDENTITY) };
        let insisted = LaserLog::read_with(log.as_bytes(), &ahead).unwrap();
        assert!(facing(&insisted).is_some_and(|(_, is_reckoned)| !is_reckoned), "{turned}");
        assert!(insisted.scans.iter().all(|scan| scan.odometry.theta == 0.0));
    }
    assert_eq!(facing(&read(&driving(0.0, true)).unwrap()), None, "straight ahead, a mirror changes nothing");
    // A laser that was mounted by eye is not doubted.
    assert_eq!(facing(&read(&driving(0.1, false)).unwrap()), None);
    // Of a laser that says that it looks back nothing else is expected.
    assert_eq!(facing(&read(&driving(PI, false).replace("FLASER", "RLASER")).unwrap()), None);
}

/// Odometry in feet, or of wheels that are taken for twice as large.
#[test]
fn odometry_of_another_length_is_doubted() {
    for factor in [3.28, 2.0, 0.7] {
        let scaled = |line: &str| {
            let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
            if words[0] == "FLASER" {
                for word in [183, 186] {
                    words[word] = format!("{:.4}", factor * words[word].parse::<f64>().unwrap());
                }
            }
            words.join(" ") + "\n"
        };
        let log: String = driving(0.0, false).lines().map(scaled).collect();
        let warnings = read(&log).unwrap().warnings;
        let seen = warnings.iter().find_map(|warning| match warning {
            LogWarning::OdometryScale { seen } => Some(*seen),
            _ => None,
        });
        assert!(seen.is_some_and(|seen| (0.8..1.25).contains(&(seen * factor))), "{factor}: {warnings:?}");
    }
}

/// Between two bare walls, nothing tells ahead from back.
#[test]
fn a_bare_corridor_does_not_tell_where_the_laser_looks() {
    let range = |bearing: f64| (1.2 / bearing.sin().abs()).min(8.0);
    let scan: Vec<String> =
        (0..181_u32).map(|beam| format!("{:.3}", range(f64::from(beam).to_radians() - FRAC_PI_2))).collect();
    let mut log = String::from("PARAM robot_front_laser_max 8 h 0\n");
    for step in 0..60_u32 {
        let x = 0.2 * f64::from(step);
        log += &format!("FLASER 181 {} {x:.3} 0 0 {x:.3} 0 0 {step} h {step}\n", scan.join(" "));
    }
    assert!(read(&log).unwrap().is_facing_unclear);
    assert!(!read(&driving(0.0, false)).unwrap().is_facing_unclear);
    assert!(!read(&turning(180.0, 181, "")).unwrap().is_facing_unclear, "it hardly drove");
}

/// A laser that is mounted upside down: its beams come from left to right. They are put in order, and it is said that the odometry may be the one
/// that is mirrored; unless it is known to be.
#[test]
fn beams_in_the_other_order_are_doubted() {
    let usual = turning(180.0, 181, "");
    let mirrored = reworded(&usual, |_, words| words[2..183].reverse());
    let (found, expected) = (read(&mirrored).unwrap(), read(&usual).unwrap());
    assert!(found.warnings.contains(&LogWarning::Mirrored { is_reckoned: true }));
    assert!(found.scans.iter().zip(&expected.scans).all(|(one, other)| one.scan == other.scan));
}

/// The words of a log's scans, each changed by its number and put together again.
fn reworded(log: &str, mut change: impl FnMut(usize, &mut Vec<String>)) -> String {
    let mut scan = 0;
    let line = |line: &str| {
        let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        if words[0] == "FLASER" {
            change(scan, &mut words);
            scan += 1;
        }
        words.join(" ") + "\n"
    };
    log.lines().map(line).collect()
}

fn turns_doubted(log: &str) -> bool {
    read(log).unwrap().warnings.iter().any(|warning| matches!(warning, LogWarning::TurnsApart { .. }))
}

/// A gyroscope that is not connected, one that tells degrees for radians, and odometry that comes with the scans of long ago.
#[test]
fn turns_that_odometry_does_not_tell_are_doubted() {
    let log = turning(180.0, 181, "");
    assert!(!turns_doubted(&log) && !turns_doubted(&driving(0.0, false)));
    let frozen = reworded(&log, |scan, words| {
        words[186] = format!("0.0{scan:02}");
        words[188] = "0".to_owned();
    });
    assert!(turns_doubted(&frozen));
    let wide = reworded(&turning(270.0, 541, "PARAM laser_front_laser_fov 270 h 0\n"), |scan, words| {
        words[546] = format!("0.0{scan:02}");
        words[548] = "1.5".to_owned();
    });
    assert!(turns_doubted(&wide));
    // Now and then it turns at once; told four scans late.
    let heading = |scan: usize| if scan.is_multiple_of(10) { 0.3 } else { 0.0 };
    let mut told = [0.0; 60];
    for scan in 1..60 {
        told[scan] = told[scan - 1] + heading(scan);
    }
    let wall = |bearing: f64| 4.0 + (3.0 * bearing).sin() + 0.6 * (7.0 * bearing).cos();
    let late = |by: usize| {
        reworded(&log, |scan, words| {
            for beam in 0..181 {
                words[2 + beam] = format!("{:.3}", wall(told[scan] + (beam as f64).to_radians() - FRAC_PI_2));
            }
            words[188] = format!("{:.4}", told[scan.saturating_sub(by)]);
        })
    };
    assert!(!turns_doubted(&late(0)));
    assert!(turns_doubted(&late(4)));
}

/// A laser that looks all around sees the same in a corridor whichever way the robot looks: no half turn is seen where there is none.
#[test]
fn half_a_turn_in_a_corridor_is_no_turn() {
    let mut log = String::from("PARAM robot_front_laser_max 12 h 0\nPARAM laser_front_laser_fov 360 h 0\n");
    for step in 0..120_u32 {
        let (x, heading) = (0.2 * f64::from(step), 0.02 * f64::from(step % 7));
        let beam = |beam: u32| {
            let bearing = f64::from(beam).to_radians() - PI + heading;
            let scatter = 0.02 * f64::from(beam * beam + 31 * step).sin();
            format!("{:.3}", (1.2 / bearing.sin().abs() + scatter).min(12.0))
        };
        let ranges: Vec<String> = (0..360).map(beam).collect();
        log += &format!(
            "FLASER 360 {} {x:.3} 0 {heading} {x:.3} 0 {heading} {step} h {step}\n",
            ranges.join(" ")
        );
    }
    assert!(!turns_doubted(&log));
    assert_eq!(view_doubted(&read(&log).unwrap()), None);
}

#[test]
fn a_laser_that_repeats_itself_on_the_way_is_doubted() {
    let log = driving(0.0, false);
    let repeats = |log: &str| {
        read(log).unwrap().warnings.iter().find_map(|warning| match warning {
            LogWarning::ScansRepeat { scans, metres, .. } => Some((*scans, (metres * 10.0).round() / 10.0)),
            _ => None,
        })
    };
    assert_eq!(repeats(&log), None);
    let mut stuck: Vec<String> = Vec::new();
    let hung = reworded(&log, |scan, words| match scan {
        10 => stuck = words[2..183].to_vec(),
        11..20 => words[2..183].clone_from_slice(&stuck),
        _ => {}
    });
    assert_eq!(repeats(&hung), Some((10, 1.8)));
    // A robot that waits sees the same for long.
    let waits = reworded(&log, |scan, words| {
        if scan > 30 {
            words[2..183].clone_from_slice(&stuck);
            for word in [183, 186] {
                words[word] = "2.2".to_owned();
            }
        }
    });
    assert_eq!(repeats(&waits), None);
}

/// Ten times too fast: decimetres, or milliseconds that are none.
#[test]
fn robots_that_are_too_fast_for_a_building_are_doubted() {
    let speed = |log: &str| {
        read(log).unwrap().warnings.iter().find_map(|warning| match warning {
            LogWarning::TooFast { speed } => Some(*speed),
            _ => None,
        })
    };
    let log = driving(0.0, false);
    assert_eq!(speed(&log), None);
    let times = |seconds: f64| {
        reworded(&log, |scan, words| {
            for word in [189, 191] {
                words[word] = format!("{}", seconds * scan as f64);
            }
        })
    };
    assert_eq!(speed(&times(0.05)), None);
    assert!(speed(&times(0.005)).is_some_and(|speed| (speed - 40.0).abs() < 0.1));
    assert_eq!(speed(&times(0.0)), None, "a clock that stands still tells no speed");
}

#[test]
fn odometry_lines_in_another_unit_are_left_out() {
    let log = driving(0.0, false);
    let with_lines = |factor: f64| -> String {
        let line = |line: &str| {
            let x = line.split(' ').nth(183).and_then(|x| x.parse::<f64>().ok());
            let odometry = x.map(|x| format!("ODOM {} 0 0 0 0 0 0 h 0\n", factor * (x + 0.1)));
            line.to_owned() + "\n" + &odometry.unwrap_or_default()
        };
        log.lines().map(line).collect()
    };
    let usual = read(&with_lines(1.0)).unwrap();
    assert_eq!(usual.trajectory.len(), 80);
    let stray = read(&with_lines(1000.0)).unwrap();
    assert!(
        matches!(stray.warnings[..], [LogWarning::StrayOdometry { lines: 40, .. }]),
        "{:?}",
        stray.warnings
    );
    let alone = read(&log).unwrap();
    assert_eq!((stray.trajectory, stray.scans[39].moment), (alone.trajectory, 39));
}

/// Around a square of 8 m with rounded corners, always ahead.
fn around(change: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<LogWarning> {
    let mut log = String::from("PARAM robot_front_laser_max 30 h 0\n");
    let (mut x, mut y, mut heading) = (0.0_f64, 0.0_f64, 0.0_f64);
    for step in 0..80_u32 {
        heading += if step % 20 > 14 { FRAC_PI_2 / 5.0 } else { 0.0 };
        (x, y) = (x + 0.4 * heading.cos(), y + 0.4 * heading.sin());
        let [x, y, theta] = change([x, y, heading]);
        log += &format!("FLASER 3 1 2 {} 0 0 0 {x:.3} {y:.3} {theta:.4} {step} h {step}\n", 1 + step % 2);
    }
    read(&log).unwrap().warnings
}

#[test]
fn odometry_that_is_mirrored_is_doubted() {
    let is_doubted = |change: fn([f64; 3]) -> [f64; 3]| around(change).contains(&LogWarning::OtherHanded);
    assert!(!is_doubted(|pose| pose));
    assert!(!is_doubted(|[x, y, theta]| [x, y, theta + 1.0]), "headings from elsewhere");
    assert!(!is_doubted(|[x, y, theta]| [-x, -y, theta]), "it drives backward");
    assert!(is_doubted(|[x, y, theta]| [x, -y, theta]));
    assert!(is_doubted(|[x, y, theta]| [y, x, theta]));
    assert!(is_doubted(|[x, y, theta]| [x, y, FRAC_PI_2 - theta]), "of a compass");
}

#[test]
fn scans_in_no_order_are_refused() {
    let lines: Vec<String> = driving(0.0, false).lines().map(str::to_owned).collect();
    let in_order = |order: fn(usize) -> usize| {
        let scans: Vec<String> = (0..40).map(|scan| lines[1 + order(scan)].clone()).collect();
        read(&format!("{}\n{}\n", lines[0], scans.join("\n")))
    };
    assert!(in_order(|scan| scan).is_ok() && in_order(|scan| 39 - scan).is_ok());
    let refusal = in_order(|scan| scan * 17 % 40).unwrap_err().to_string();
    assert!(refusal.contains("sort the log by time"), "{refusal}");
}

/// Ranges as good as chance: sines of growing steps.
#[test]
fn ranges_that_scatter_are_doubted() {
    let is_doubted = |sigma: f64| {
        let scattered = reworded(&driving(0.0, false), |scan, words| {
            for (beam, word) in words[2..183].iter_mut().enumerate() {
                let number = (181 * scan + beam) as f64;
                let chance: f64 =
                    [1.0_f64, 2.3, 3.7, 5.1].iter().map(|step| (step * step * number * number).sin()).sum();
                *word = format!("{:.3}", word.parse::<f64>().unwrap() + sigma * chance / 2.0_f64.sqrt());
            }
        });
        read(&scattered).unwrap().warnings.iter().any(|warning| matches!(warning, LogWarning::Noisy { .. }))
    };
    assert_eq!([0.0, 0.05, 0.3].map(is_doubted), [false, false, true]);
}

#[test]
fn a_place_that_no_laser_has_is_not_used() {
    let log = driving(0.0, false);
    for (name, value) in [("offset", "350"), ("side_offset", "-200"), ("angular_offset", "180")] {
        let odd = read(&format!("PARAM robot_frontlaser_{name} {value} h 0\n{log}")).unwrap();
        assert!(matches!(odd.warnings[..], [LogWarning::OddParameter { .. }]), "{name}: {:?}", odd.warnings);
        assert_eq!(odd.trajectory, read(&log).unwrap().trajectory);
    }
}

#[test]
fn a_limit_far_below_the_ranges_is_doubted() {
    let scan = |step: u32| {
        let ranges: Vec<String> =
            (0..90_u32).map(|beam| format!("{:.2}", 1.0 + 0.1 * f64::from((beam + step) % 90))).collect();
        format!("FLASER 90 {} 0 0 0 0 0 0 {step} h {step}\n", ranges.join(" "))
    };
    let scans: String = (0..30).map(scan).collect();
    let is_doubted = |said: &str| {
        let log = read(&format!("PARAM robot_front_laser_max {said} h 0\n{scans}")).unwrap();
        log.warnings.iter().any(|warning| matches!(warning, LogWarning::LimitDoubted { .. }))
    };
    assert_eq!([is_doubted("5.0"), is_doubted("9.8"), is_doubted("50")], [true, false, false]);
}
