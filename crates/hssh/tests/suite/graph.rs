//! `hssh graph` as a user runs it: what it prints and writes, and what it says of graphs that are none.

use std::process::Output;

use serde_json::Value;

use super::common::{self, hssh, hssh_reading, root, scratch};

fn graph(arguments: &[&str]) -> Output {
    hssh(&[&["graph"], arguments].concat())
}

/// The session without the line of times.
fn session(arguments: &[&str]) -> String {
    let session = common::session(&[&["graph"], arguments].concat());
    let lines = session.lines().filter(|line| !line.starts_with("  time "));
    lines.map(|line| format!("{line}\n")).collect()
}

fn answer(arguments: &[&str]) -> Value {
    let output = graph(&[arguments, &["--json"]].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}

const TWO_LAPS: &str = "fixtures/graphs/two-laps.g2o";
const TORO: &str = "fixtures/graphs/two-laps-toro.graph";
const WRONG: &str = "fixtures/graphs/two-wrong-closures.g2o";

#[test]
fn the_main_job() {
    let sessions = [
        session(&[TWO_LAPS]),
        session(&[WRONG, "--graduated"]),
        session(&[WRONG, "--robust", "dcs"]),
        session(&["fixtures/graphs/disconnected.g2o"]),
        session(&["fixtures/graphs/contradictory.g2o"]),
        session(&["fixtures/graphs/zero-information.g2o"]),
        session(&[TWO_LAPS, "--method", "linearize-once", "--start", "odometry"]),
        session(&[TWO_LAPS, "--method", "relaxation", "--max-iterations", "3"]),
    ];
    insta::assert_snapshot!(sessions.join("\n"));
}

#[test]
fn says_what_is_wrong() {
    let mut files: Vec<_> = std::fs::read_dir(root().join("fixtures/graphs/malformed"))
        .unwrap()
        .map(|entry| format!("fixtures/graphs/malformed/{}", entry.unwrap().file_name().to_string_lossy()))
        .collect();
    files.sort();
    let mut sessions: Vec<String> = files.iter().map(|file| session(&[file])).collect();
    assert!(sessions.iter().all(|session| session.ends_with("exit 2\n") && session.contains("error: ")));
    sessions.extend([
        session(&["no-such-file.g2o"]),
        session(&["fixtures"]),
        session(&[WRONG, "--start", "file"]),
        session(&[WRONG, "--robust", "huber", "--method", "relaxation"]),
        session(&[WRONG, "--robust", "huber", "--graduated"]),
        session(&[TWO_LAPS, "--tolerance", "0"]),
        session(&[TWO_LAPS, "--g2o", "no/such/folder/out.g2o", "--max-iterations", "2"]),
    ]);
    insta::assert_snapshot!(sessions.join("\n"));
}

/// Methods and starts are different ways to one minimum.
#[test]
fn every_way_leads_to_the_same_minimum() {
    let expected = answer(&[TWO_LAPS])["chi2"].as_f64().unwrap();
    for method in ["gauss-newton", "levenberg-marquardt", "safeguarded", "relaxation"] {
        for start in ["best", "chordal", "file", "odometry"] {
            let found = answer(&[TWO_LAPS, "--method", method, "--start", start, "--tolerance", "1e-10"]);
            let chi2 = found["chi2"].as_f64().unwrap();
            assert!((chi2 - expected).abs() < 1e-5 * expected, "{method} {start}: {chi2} {expected}");
            assert_eq!(found["finished"], true, "{method} {start}");
        }
    }
    let from_toro = answer(&[TORO])["chi2"].as_f64().unwrap();
    assert!((from_toro - expected).abs() < 1e-9 * expected, "the two formats say the same");
}

/// The file with two wrong closures more than the other gives, without them, the other's answer.
#[test]
fn wrong_closures_are_found_and_make_no_difference() {
    let right = answer(&[TWO_LAPS]);
    let screened = answer(&[WRONG, "--graduated"]);
    let refused: Vec<_> = screened["doubted"].as_array().unwrap().iter().map(|edge| &edge["from"]).collect();
    assert_eq!(refused, [30, 26]);
    let (chi2, expected) = (screened["chi2"].as_f64().unwrap(), right["chi2"].as_f64().unwrap());
    assert!((chi2 - expected).abs() < 1e-6 * expected, "{chi2} {expected}");
    assert!(answer(&[WRONG])["chi2"].as_f64().unwrap() > 100.0 * expected);
}

#[test]
fn what_it_writes_is_what_it_found() {
    let folder = scratch("graph");
    let file = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let (g2o, svg, dot) = (file("out.g2o"), file("out.svg"), file("out.dot"));
    let output = graph(&[WRONG, "--graduated", "--g2o", &g2o, "--svg", &svg, "--dot", &dot]);
    assert_eq!(output.status.code(), Some(0));
    let again = answer(&[&g2o]);
    let chi2 = |value: &Value| value.as_f64().unwrap();
    assert!((chi2(&again["file_chi2"]) - chi2(&again["chi2"])).abs() < 1e-9, "it was at the minimum");
    assert_eq!(again["edges"], 37, "the two refused closures are left out");
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(svg.trim_end().ends_with("</svg>") && svg.contains("refused, 2"));
    let dot = std::fs::read_to_string(dot).unwrap();
    assert_eq!(dot.matches("->").count(), 2 * 37);
}

#[test]
fn reads_standard_input() {
    let output = hssh_reading(TORO, &["graph", "-", "--json"]);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answer["edges"], 37);
}

/// A file of which something that matters is not in the answer says so first, and --strict refuses it.
#[test]
fn an_answer_that_leaves_out_a_measurement_says_so_first() {
    let file = scratch("graph").join("partial.g2o");
    let whole = std::fs::read_to_string(root().join(TWO_LAPS)).unwrap();
    std::fs::write(&file, format!("{whole}EDGE_RANGE 0 3 1.5 10\nPARAMS_SE2OFFSET 0 0 0 0\n")).unwrap();
    let file = file.to_string_lossy().into_owned();
    let said = common::text(&graph(&[&file]).stdout);
    assert!(said.starts_with("PARTIAL: 1 record of the file is not in this answer: `EDGE_RANGE`"), "{said}");
    assert!(answer(&[&file])["partial"].as_str().unwrap().contains("EDGE_RANGE"));
    let refused = graph(&[&file, "--strict"]);
    assert_eq!((refused.status.code(), refused.stdout.len()), (Some(2), 0));
    assert!(common::text(&refused.stderr).contains("EDGE_RANGE"));
    assert_eq!(graph(&[TWO_LAPS, "--strict"]).status.code(), Some(0));
}

/// Closures that the file holds for doubtful are believed if they fit, and refused if they do not.
#[test]
fn doubtful_closures_are_decided() {
    let file = scratch("graph").join("switchable.g2o");
    let text = std::fs::read_to_string(root().join(WRONG)).unwrap();
    let doubtful = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["EDGE_SE2", from, to, ..] if from.parse::<i64>().unwrap() + 1 != to.parse::<i64>().unwrap() => {
                format!("EDGE_SE2_SWITCHABLE {from} {to} 900 {}\n", words[3..].join(" "))
            }
            _ => format!("{line}\n"),
        }
    };
    std::fs::write(&file, text.lines().map(doubtful).collect::<String>()).unwrap();
    let [ours, graduated] =
        [vec![file.to_str().unwrap()], vec![WRONG, "--graduated"]].map(|flags| answer(&flags));
    assert!((ours["chi2"].as_f64().unwrap() - graduated["chi2"].as_f64().unwrap()).abs() < 1e-6, "{ours}");
    assert_eq!(ours["doubted"].as_array().unwrap().len(), 2);
    assert!(ours["remarks"][0].as_str().unwrap().contains("doubtful"));
}

/// What the file fixes and what is held for want of anything else are told apart, part by part.
#[test]
fn every_part_says_what_holds_it() {
    let file = scratch("graph").join("parts.g2o");
    let edge = "1 0 0 100 0 0 100 0 100";
    std::fs::write(&file, format!("EDGE_SE2 0 1 {edge}\nEDGE_SE2 5 6 {edge}\nFIX 6\nEDGE_SE2 8 9 {edge}\n"))
        .unwrap();
    let found = answer(&[file.to_str().unwrap()]);
    assert_eq!(
        (&found["parts"], &found["fixed"], &found["held"]),
        (&3.into(), &serde_json::json!([6]), &serde_json::json!([0, 8]))
    );
    let said = common::text(&graph(&[file.to_str().unwrap()]).stdout);
    assert!(
        said.contains("in 3 parts that no edge joins; pose 6 fixed by the file, poses 0, 8 held"),
        "{said}"
    );
}

/// A chain cannot contradict itself, whatever rounding leaves.
#[test]
fn a_chain_has_nothing_to_contradict() {
    let file = scratch("graph").join("chain.g2o");
    let edges = (0..30).map(|pose| format!("EDGE_SE2 {pose} {} 1.1 0.3 0.7 400 0 0 400 0 2500\n", pose + 1));
    std::fs::write(&file, edges.collect::<String>()).unwrap();
    let said = common::text(&graph(&[file.to_str().unwrap()]).stdout);
    assert!(said.contains("0 expected") && !said.contains("contradict"), "{said}");
}

/// What too few measurements hold is refused by name.
#[test]
fn what_floats_is_named() {
    let file = scratch("graph").join("floating.g2o");
    std::fs::write(&file, "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 1 2 1 0 0 100 0 0 100 0 0\n")
        .unwrap();
    let refused = graph(&[file.to_str().unwrap()]);
    assert_eq!(refused.status.code(), Some(2));
    let said = common::text(&refused.stderr);
    assert!(said.contains("the poses 2 could move"), "{said}");
}

/// Dead reckoning that has drifted by more than a radian refuses no right closure for good.
#[test]
fn a_kernel_gets_away_from_drifted_dead_reckoning() {
    let file = scratch("graph").join("drifted.g2o");
    let (lap, turn, drift) = (100, std::f64::consts::TAU / 100.0, 0.004);
    let edge = |from: usize, to: usize, x: f64, theta: f64| {
        format!("EDGE_SE2 {from} {to} {x} 0 {theta} 400 0 0 400 0 10000\n")
    };
    let mut text: String = (0..4 * lap).map(|pose| edge(pose, pose + 1, 1.0, turn + drift)).collect();
    text.extend((0..3 * lap).step_by(5).map(|pose| edge(pose, pose + lap, 0.0, 0.0)));
    std::fs::write(&file, text).unwrap();
    let found = answer(&[file.to_str().unwrap(), "--robust", "dcs"]);
    assert_eq!(found["doubted"].as_array().unwrap().len(), 0, "{}", found["chi2"]);
    assert!(found["chi2"].as_f64().unwrap() < 200.0, "{}", found["chi2"]);
}
