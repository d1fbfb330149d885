//! A robot's drive through a floor, its log changed as the bytes say: whatever happens to scans and odometry, what is made of it
//! is finite, agrees with itself and reads back.
//!
//! Any bytes are no log, and no log with places in it: so the drives are simulated once, and the bytes are changes to one of them.

#![no_main]

use std::sync::OnceLock;

use hssh::answer::Answer;
use hssh::pipeline::{Input, MappingOptions, map};
use hssh_causal::Exploration;
use hssh_world::robot::{Laser, RobotOptions, Strategy, drive};
use hssh_world::{floor_plan, grid};
use libfuzzer_sys::fuzz_target;

/// Rows and columns of the floors that are driven through, and metres between their crossings.
const FLOORS: [(u32, u32, f64); 3] = [(2, 2, 12.0), (2, 3, 10.0), (1, 4, 9.0)];

/// Metres from which on nothing comes back.
const LIMIT: f64 = 20.0;

/// More messages than this take too long.
const MOST: usize = 400;

/// So little that the search takes no time.
const OPTIONS: &str = "(search: (threads: 1), limits: (nodes: 200, seconds: 1, mebibytes: 64))";

/// A message of a log.
#[derive(Clone)]
struct Message {
    odometry: [f64; 3],
    time: f64,
    scan: Option<Vec<f64>>,
}

/// What the robot logged on each floor.
fn drives() -> &'static [Vec<Message>] {
    static DRIVES: OnceLock<Vec<Vec<Message>>> = OnceLock::new();
    DRIVES.get_or_init(|| {
        let laser = Laser { beams: 61, max_range: LIMIT, ..Laser::default() };
        let options = RobotOptions { laser, scan_distance: 0.5, scan_turn: 0.3, ..RobotOptions::default() };
        let drive = |(rows, columns, spacing)| {
            let world = grid(rows, columns, spacing).expect("a grid with rows and columns is a world");
            let plan = floor_plan(&world, 2.4, 0.1).expect("corridors have a width");
            let driven = drive(&plan, None, Strategy::Cover, &options, 1).expect("the floor has places");
            let logged = driven.moments.into_iter().filter(|moment| moment.scan.is_some()).map(|moment| {
                let odometry = [moment.odometry.x, moment.odometry.y, moment.odometry.theta];
                Message { odometry, time: moment.time, scan: moment.scan }
            });
            logged.collect()
        };
        FLOORS.map(drive).into()
    })
}

/// Seven bytes: what is done, from where on, to how many messages, to which beams, and how much.
fn change(log: &mut Vec<Message>, bytes: &[u8; 7]) {
    let [what, from, count, first, beams, much, exponent] = *bytes;
    if log.is_empty() {
        return;
    }
    let from = usize::from(from) * log.len() / 256;
    let range = from..(from + 1 + usize::from(count)).min(log.len());
    let (sign, size) = (if much >= 128 { -1.0 } else { 1.0 }, f64::from(much % 128) / 16.0);
    let amount = sign * size * 10_f64.powi(i32::from(exponent % 8) - 3);
    let mut each_beam = |alter: &dyn Fn(f64) -> f64| {
        for scan in log[range.clone()].iter_mut().filter_map(|message| message.scan.as_mut()) {
            let first = usize::from(first) * scan.len() / 256;
            let chosen = scan.iter_mut().skip(first).take(1 + usize::from(beams));
            chosen.for_each(|range| *range = alter(*range));
        }
    };
    match what % 20 {
        0 => each_beam(&|range| range + amount),
        1 => each_beam(&|range| range * amount),
        2 => each_beam(&|_| amount),
        3 => each_beam(&|_| f64::INFINITY),
        4 => each_beam(&|_| f64::NAN),
        5 => each_beam(&|range| range.min(amount)),
        6 => log[range].iter_mut().for_each(|message| message.odometry[0] += amount),
        7 => log[from..].iter_mut().for_each(|message| message.odometry[1] += amount),
        8 => log[from..].iter_mut().for_each(|message| message.odometry[2] += amount),
        9 => {
            let still = log[from].odometry;
            log[range].iter_mut().for_each(|message| message.odometry = still);
        }
        10 => {
            let [x, y, _] = log[from].odometry;
            for Message { odometry, .. } in &mut log[range] {
                *odometry = [x + amount * (odometry[0] - x), y + amount * (odometry[1] - y), odometry[2]];
            }
        }
        11 => drop(log.drain(range)),
        12 => log[range].reverse(),
        13 => {
            let again = log[range].to_vec();
            log.extend(again);
        }
        14 => {
            // What was seen elsewhere is seen here.
            let elsewhere = log[(from + usize::from(first) + 1) % log.len()].scan.clone();
            log[range].iter_mut().for_each(|message| message.scan.clone_from(&elsewhere));
        }
        15 => {
            log[range].iter_mut().filter_map(|message| message.scan.as_mut()).for_each(|scan| scan.reverse())
        }
        16 => {
            let turn = usize::from(beams);
            for scan in log[range].iter_mut().filter_map(|message| message.scan.as_mut()) {
                let turn = turn % scan.len().max(1);
                scan.rotate_left(turn);
            }
        }
        17 => {
            let kept = 1 + usize::from(beams);
            log[range]
                .iter_mut()
                .filter_map(|message| message.scan.as_mut())
                .for_each(|scan| scan.truncate(kept));
        }
        18 => log[range].iter_mut().for_each(|message| message.scan = None),
        _ => log[from..].iter_mut().for_each(|message| message.time += amount),
    }
    log.truncate(MOST);
}

/// The log as a robot of the 2000s would have written it.
fn text(log: &[Message]) -> String {
    let mut text = format!("PARAM robot_front_laser_max {LIMIT} nohost 0\n");
    for Message { odometry: [x, y, theta], time, scan } in log {
        let stamp = format!("{time} nohost {time}");
        text += &match scan {
            None => format!("ODOM {x} {y} {theta} 0 0 0 {stamp}\n"),
            Some(scan) => {
                let beams: String = scan.iter().map(|range| format!(" {range:.3}")).collect();
                format!("FLASER {}{beams} {x} {y} {theta} {x} {y} {theta} {stamp}\n", scan.len())
            }
        };
    }
    text
}

fuzz_target!(|bytes: &[u8]| {
    let Some((&drive, changes)) = bytes.split_first() else { return };
    let mut log = drives()[usize::from(drive) % FLOORS.len()].clone();
    let (changes, _) = changes.as_chunks();
    changes.iter().take(12).for_each(|bytes| change(&mut log, bytes));
    let text = text(&log);
    if std::env::var_os("PRINT").is_some() {
        println!("{text}");
    }
    let options = MappingOptions::from_ron(OPTIONS).expect("these are options");
    let Ok(input) = Input::from_log("fuzz", text.as_bytes(), &options) else { return };

    let surveyed = input.as_surveyed().expect("it was made of a log");
    let survey = &surveyed.survey;
    assert!(survey.track.scans.iter().all(|scan| scan.pose.is_finite()));
    assert!(survey.graph.poses().iter().all(|pose| pose.is_finite()) && survey.graph.chi2().is_finite());
    assert_eq!(survey.travels.len() + 1, survey.visits.len());
    for visit in &survey.visits {
        assert!(visit.frame.is_finite() && visit.scans.0 <= visit.scans.1);
        assert!(visit.scans.1 < surveyed.log.scans.len());
    }
    let exploration = input.as_exploration().to_ron();
    assert_eq!(Exploration::from_ron(&exploration).expect("what was seen reads back").to_ron(), exploration);
    if let Ok(mapped) = map(&input, &options, &Default::default()) {
        let json = mapped.answer.to_json();
        assert_eq!(Answer::from_json(&json).expect("an answer reads back").to_json(), json);
    }
});
