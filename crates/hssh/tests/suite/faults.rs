//! Inputs as users have them, with what is wrong in them, and what is right to say: a table that `cargo xtask faults` prints.
//!
//! Each is a neighbor of a fault that users of such programs reported: a mark before the first record, another unit, a laser
//! that is mounted otherwise.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;
use std::process::Output;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::common::{hssh, root, scratch, text};

/// What is to come of an input.
struct Fault {
    /// What is wrong with it, or with what is asked.
    case: &'static str,
    /// The arguments, `FILE` being the input.
    arguments: &'static str,
    input: Vec<u8>,
    exit: i32,
    /// What the first line has to contain, of standard output or, with exit 2, of standard error.
    says: &'static str,
}

fn fault(
    case: &'static str,
    arguments: &'static str,
    input: impl Into<Vec<u8>>,
    exit: i32,
    says: &'static str,
) -> Fault {
    Fault { case, arguments, input: input.into(), exit, says }
}

/// The lines with something done to the words of each.
fn edited(log: &str, mut edit: impl FnMut(&mut Vec<String>)) -> String {
    let line = |line: &str| {
        let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        edit(&mut words);
        words.join(" ") + "\n"
    };
    log.lines().map(line).collect()
}

/// The log with other raw odometry.
fn driven(log: &str, mut change: impl FnMut([f64; 3]) -> [f64; 3]) -> String {
    edited(log, |words| {
        let first = match words[0].as_str() {
            "FLASER" => 186,
            "ODOM" => 1,
            _ => return,
        };
        let pose = [0, 1, 2].map(|offset| words[first + offset].parse().unwrap());
        for (offset, number) in change(pose).into_iter().enumerate() {
            words[first + offset] = format!("{number:.5}");
        }
    })
}

/// The log with other beams: those of each scan, from right to left.
fn seen(log: &str, mut change: impl FnMut(Vec<String>) -> Vec<String>) -> String {
    edited(log, |words| {
        if words[0] == "FLASER" {
            let beams = change(words.splice(2..183, []).collect());
            words[1] = beams.len().to_string();
            words.splice(2..2, beams);
        }
    })
}

/// The log with another limit of ranges.
fn seen_to(log: &str, limit: f64) -> String {
    log.replace("robot_front_laser_max 30.00", &format!("robot_front_laser_max {limit}"))
}

fn graphs() -> Vec<Fault> {
    let read = |name: &str| std::fs::read_to_string(root().join("fixtures/graphs").join(name)).unwrap();
    let (laps, toro) = (read("two-laps.g2o"), read("two-laps-toro.graph"));
    let whole = "33 poses, 37 edges, of which 5 close loops";
    let unknown = laps.clone() + "EDGE_SE2_WHATEVER 0 5 1 0 0 1 0 0 1 0 1\n";
    let offset = laps.clone() + "EDGE_SE2_OFFSET 0 5 0 0 1 0 0 1 0 0 1 0 1\n";
    let percent = format!("% made by some program\n{laps}");
    let turned = "EDGE_SE2 0 1 1 0 90 1 0 0 1 0 1\nEDGE_SE2 1 0 1 0 -90 1 0 0 1 0 1\n";
    let says_nothing = "EDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\nEDGE_SE2 1 2 1 0 0 0 0 0 0 0 0\n";
    vec![
        fault("a comment behind a percent sign", "graph FILE", percent, 0, whole),
        fault("turns in degrees", "graph FILE", turned, 0, "DOUBTFUL: line 1 turns by 90 rad"),
        fault("no information at all", "graph FILE", says_nothing, 0, "DOUBTFUL: every measurement"),
        fault("mark before TORO", "graph FILE", format!("\u{feff}{toro}"), 0, whole),
        fault("CR line ends", "graph FILE", laps.replace('\n', "\r\n"), 0, whole),
        fault("records in lower case", "graph FILE", laps.to_lowercase(), 0, whole),
        fault("an edge of no known kind", "graph FILE", unknown.clone(), 0, "PARTIAL: 1 record"),
        fault("the same, strictly", "graph FILE --strict", unknown, 2, "EDGE_SE2_WHATEVER"),
        fault("an edge between sensors", "graph FILE", offset, 0, "PARTIAL: 1 record"),
        fault("two fixed poses", "graph FILE", laps + "FIX 5\nFIX 0\n", 0, "poses 0, 5 fixed by the file"),
        fault("packed by bzip2", "graph FILE", &b"BZh91AY&SY\x01\x02\x03"[..], 2, "compressed by bzip2"),
    ]
}

fn logs(ring: &str) -> Vec<Fault> {
    let map = "map FILE --planar";
    let limit = "PARAM robot_front_laser_max 30.00";
    let right = "posterior with proof: proved the best map (4 of 4 travels explained)";
    let scaled = |factor: f64| driven(ring, |[x, y, theta]| [factor * x, factor * y, theta]);
    let times = |factor: f64| {
        let longer = |word: String| (factor * word.parse::<f64>().unwrap()).to_string();
        seen(ring, |beams| beams.into_iter().map(longer).collect())
    };
    let times_at_most = |reach: f64| {
        let seen = |word: String| format!("{:.3}", word.parse::<f64>().unwrap().min(reach));
        seen_to(&self::seen(ring, |beams| beams.into_iter().map(seen).collect()), reach)
    };
    // A sum of sines of the number of a reading: as good as chance, and the same each time.
    let mut reading = 0.0;
    let scattered = seen(ring, |beams| {
        let mut scatter = |word: String| {
            reading += 1.0;
            let chance: f64 =
                [1.0_f64, 2.3, 3.7, 5.1].iter().map(|step| (step * step * reading * reading).sin()).sum();
            format!("{:.3}", (word.parse::<f64>().unwrap() + 0.2 * chance).max(0.02))
        };
        beams.into_iter().map(&mut scatter).collect()
    });
    let mut lines: Vec<&str> = ring.lines().collect();
    let behind = lines.len() - 1;
    for (index, other) in (1..lines.len()).map(|index| (index, 1 + index * index * 7_919 % behind)) {
        lines.swap(index, other);
    }
    let shuffled = lines.join("\n");
    let mirrored = |mut beams: Vec<String>| {
        beams.reverse();
        beams
    };
    let right_half = seen(ring, |beams| beams[..91].to_vec());
    let aside = format!("PARAM laser_front_laser_fov 90 h 0\n{right_half}");
    let odd = |word: &'static str| {
        seen(ring, move |mut beams| {
            beams[97] = word.to_owned();
            beams
        })
    };
    let mut scans = 0;
    let cut = edited(ring, |words| {
        scans += usize::from(words[0] == "FLASER");
        if words[0] == "FLASER" && scans % 3 == 0 {
            words[1] = "90".to_owned();
        }
    });
    let lower = ring.replace("FLASER", "flaser").replace("ODOM", "odom");
    let unlimited = ring.lines().skip(1).map(|line| format!("{line}\n")).collect::<String>();
    let late = format!("{unlimited}{limit} nohost 0\n");
    let half = &ring.as_bytes()[..ring.len() / 3];
    vec![
        fault(
            "a second laser that is not there",
            "map FILE --scan FLASER,RLASER",
            ring,
            2,
            "the log has no RLASER messages; it has FLASER",
        ),
        fault(
            "a laser by a topic's name",
            "map FILE --scan /front",
            ring,
            2,
            "go by the names of their messages: FLASER, ROBOTLASER1, RAWLASER1, RLASER, ROBOTLASER2",
        ),
        fault("messages in lower case", map, lower, 0, right),
        fault("no limit of range", map, unlimited, 0, right),
        fault("the limit at the end", map, late, 0, right),
        fault(
            "a limit of centimetres",
            map,
            ring.replace(limit, "PARAM robot_front_laser_max 3000"),
            0,
            right,
        ),
        fault(
            "a limit far too short",
            map,
            ring.replace(limit, "PARAM robot_front_laser_max 3"),
            0,
            "DOUBTFUL",
        ),
        fault("ranges in centimetres", map, times(100.0), 2, "are the ranges centimetres?"),
        fault("ranges in decimetres", map, times(10.0), 0, "DOUBTFUL: the log says that nothing comes back"),
        fault(
            "ranges twice as long",
            map,
            times(2.0),
            0,
            "DOUBTFUL: the walls come toward the robot about 2",
        ),
        fault("ranges half as long", map, times(0.5), 0, "DOUBTFUL: the walls come toward the robot about 2"),
        fault(
            "a laser that sees two metres",
            map,
            times_at_most(2.0),
            0,
            "DOUBTFUL: the laser sees no farther",
        ),
        fault("ranges that scatter", map, scattered, 0, "DOUBTFUL: the ranges of neighboring beams scatter"),
        fault("scans in no order", map, shuffled, 2, "the scans are in no order"),
        fault("ranges in millimetres", map, times(1000.0), 2, "millimetres"),
        fault("a word among the beams", map, odd("abc"), 0, right),
        fault("-1.#IND among the beams", map, odd("-1.#IND"), 0, right),
        fault("beams missing in a third", map, cut, 0, "PARTIAL: 176 of 530 scans"),
        fault("broken off", map, half, 0, "PARTIAL: line"),
        fault("upside down", map, seen(ring, mirrored), 0, "DOUBTFUL: the walls turn with the robot"),
        fault(
            "looks to the right",
            "map FILE --planar",
            aside.clone(),
            0,
            "posterior with proof: proved the best map",
        ),
        // Half a view misses a way out at times: what is asked here is that nothing is doubted.
        fault(
            "the same, told",
            "map FILE --planar --laser-pose=0,0,-45",
            aside,
            0,
            "posterior with proof: proved the best map",
        ),
        fault("a view too wide", "map FILE --planar --fov 270", ring, 0, "DOUBTFUL: the walls do not turn"),
        fault("looks back", map, driven(ring, |[x, y, theta]| [-x, -y, theta]), 0, right),
        fault("x and y exchanged", map, driven(ring, |[x, y, theta]| [y, x, theta]), 0, "DOUBTFUL"),
        fault(
            "turns to the other side",
            map,
            driven(ring, |[x, y, theta]| [x, y, -theta]),
            0,
            "DOUBTFUL: the odometry moves to the right",
        ),
        fault(
            "turns in degrees",
            map,
            driven(ring, |[x, y, theta]| [x, y, theta.to_degrees()]),
            0,
            "DOUBTFUL",
        ),
        fault(
            "y to the other side",
            map,
            driven(ring, |[x, y, theta]| [x, -y, theta]),
            0,
            "DOUBTFUL: the odometry moves to the right",
        ),
        fault(
            "headings of a compass",
            map,
            driven(ring, |[x, y, theta]| [x, y, FRAC_PI_2 - theta]),
            0,
            "DOUBTFUL",
        ),
        fault("odometry in feet", map, scaled(3.281), 0, "as if the odometry were feet"),
        fault("odometry in inches", map, scaled(39.37), 0, "DOUBTFUL"),
        fault("odometry in kilometres", map, scaled(0.001), 0, "DOUBTFUL"),
        fault("wheels of twice the size", map, scaled(2.0), 0, "DOUBTFUL: the walls come toward"),
        fault("wheels of half the size", map, scaled(0.5), 0, "DOUBTFUL: the walls come toward"),
        fault("odometry in millimetres", map, scaled(1000.0), 2, "is the odometry in metres and radians?"),
        fault("no odometry", map, driven(ring, |_| [0.0; 3]), 0, "DOUBTFUL: the log has no odometry"),
    ]
}

/// Once round a square of corridors, and one travel more: turns and variances as they are written.
fn square(turn: &str, variances: &str) -> String {
    let corners = [
        ("south-west", "\"0+ @90\", \"1+ @0\", \"0- @-90 closed\", \"1- @180 closed\""),
        ("south-east", "\"0+ @90\", \"1+ @0 closed\", \"0- @-90 closed\", \"1- @180\""),
        ("north-east", "\"0+ @90 closed\", \"1+ @0 closed\", \"0- @-90\", \"1- @180\""),
        ("north-west", "\"0+ @90 closed\", \"1+ @0\", \"0- @-90\", \"1- @180 closed\""),
    ];
    let ways = [("1+", "1-", 8, 0), ("0+", "0-", 0, 8), ("1-", "1+", -8, 0), ("0-", "0+", 0, -8)];
    let mut text = "(stars: {".to_owned();
    for (name, ends) in corners {
        let _ = write!(text, "\"{name}\": [{ends}], ");
    }
    text += "}, start: \"south-west\", travels: [";
    for travel in 0..5 {
        let (exit, entry, x, y) = ways[travel % 4];
        let star = corners[(travel + 1) % 4].0;
        let odometry = format!("(x: {x}, y: {y}, theta: {turn}, covariance: [{variances}])");
        let _ =
            write!(text, "(exit: \"{exit}\", entry: \"{entry}\", star: \"{star}\", odometry: {odometry}), ");
    }
    text + "])"
}

fn explorations() -> Vec<Fault> {
    let (map, usual) = ("map FILE", "0.04, 0.04, 0.001");
    let right = "posterior with proof: proved the best map (5 of 5 travels explained)";
    let doubtful = "DOUBTFUL: travel 1: theta is";
    vec![
        fault("turns in radians", map, square("0.01", usual), 0, right),
        fault("turns of a right angle in degrees", map, square("90", usual), 0, doubtful),
        fault("the same to the other side", map, square("-90", usual), 0, doubtful),
        fault("half turns in degrees", map, square("180", usual), 0, doubtful),
        fault("small turns in degrees", map, square("2.5", usual), 0, doubtful),
        fault("a turn beyond all angles", map, square("1e308", usual), 2, "as no robot measures"),
        fault("square degrees", map, square("0", "0.04, 0.04, 4"), 0, "square degrees"),
        fault("square decimetres", map, square("0", "400, 400, 0.001"), 0, "square metres"),
        fault(
            "millimetres",
            map,
            square("0.01", "4e4, 4e4, 0.001").replace("8,", "8000,").replace("8)", "8000)"),
            0,
            "DOUBTFUL: travel 1: half of the travels are longer than 8000 m",
        ),
        fault("a variance below none", map, square("0", "-0.04, 0.04, 0.001"), 2, "not positive definite"),
    ]
}

fn maps() -> Vec<Fault> {
    let floor = root().join("fixtures/grids/floor.png");
    let yaml = |resolution: &str, rest: &str| {
        format!(
            "image: {}\nresolution: {resolution}\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n{rest}",
            floor.display()
        )
    };
    let saved = yaml("0.1", "negate: 0\n");
    let utf16: Vec<u8> = format!("\u{feff}{saved}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let flat = saved.replace("[0, 0, 0]", "[0, 0]");
    vec![
        fault("a description in UTF-16", "stars FILE", utf16, 0, "2 regions, 5 places"),
        fault(
            "an origin of two numbers",
            "stars FILE",
            flat,
            2,
            "the number of numbers is 2, but `origin` has three",
        ),
        fault(
            "no space behind colons",
            "stars FILE",
            saved.replace(": ", ":"),
            2,
            "with a space behind the colon",
        ),
        fault(
            "a mode of no name",
            "stars FILE",
            saved + "mode: Trinery\n",
            2,
            "the `mode` is `Trinery`, expected one of trinary",
        ),
        fault("negate in a word", "stars FILE", yaml("0.1", "negate: false\n"), 0, "2 regions, 5 places"),
        fault("negate in capitals", "stars FILE", yaml("0.1", "negate: False\n"), 0, "2 regions, 5 places"),
        fault("negate of two", "stars FILE", yaml("0.1", "negate: 2\n"), 2, "negate"),
        fault("a resolution of none", "stars FILE", yaml("0", "negate: 0\n"), 2, "resolution"),
        fault("a resolution of .nan", "stars FILE", yaml(".nan", "negate: 0\n"), 2, "resolution"),
        fault(
            "cells ten times too large",
            "stars FILE",
            yaml("1", "negate: 0\n"),
            0,
            "DOUBTFUL: half of the rooms",
        ),
        fault("cells ten times too small", "stars FILE", yaml("0.01", "negate: 0\n"), 0, "DOUBTFUL: no room"),
        fault("a cell of a kilometre", "stars FILE", yaml("1e3", "negate: 0\n"), 2, "from 0.001 to 100"),
    ]
}

/// The file of each input, and what the program makes of it. Several are run at once: a log takes seconds.
fn outputs(faults: &[Fault]) -> Vec<(String, Output)> {
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(fault) = faults.get(index) else { return done };
            let file = scratch("faults").join(format!("{index}.input"));
            std::fs::write(&file, &fault.input).unwrap();
            let file = file.to_string_lossy().into_owned();
            let arguments: Vec<&str> =
                fault.arguments.split(' ').map(|word| if word == "FILE" { &file } else { word }).collect();
            let output = hssh(&arguments);
            done.push((index, (file, output)));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let mut done: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap()).collect()
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, output)| output).collect()
}

/// Prints the table, and every line of it is right.
#[test]
fn what_is_wrong_with_an_input_is_said_first() {
    let log = scratch("faults").join("ring.log");
    let name = log.to_string_lossy().into_owned();
    assert_eq!(hssh(&["simulate", "--floor", "ring", "-o", &name]).status.code(), Some(0));
    let ring = std::fs::read_to_string(&log).unwrap();
    let mut wrong = String::new();
    let faults: Vec<Fault> =
        graphs().into_iter().chain(logs(&ring)).chain(explorations()).chain(maps()).collect();
    for (fault, (file, output)) in faults.iter().zip(outputs(&faults)) {
        let said = text(if fault.exit == 2 { &output.stderr } else { &output.stdout });
        let first = said.lines().next().unwrap_or_default();
        let is_right = output.status.code() == Some(fault.exit) && first.contains(fault.says);
        let told: String = first.replace(&file, "FILE").chars().take(80).collect();
        println!("{:<34} {:<6} {told}", fault.case, if is_right { "right" } else { "WRONG" });
        if !is_right {
            let (code, errors) = (output.status.code(), text(&output.stderr));
            let _ = writeln!(wrong, "{}: {code:?}: {first}\n{errors}", fault.case);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
