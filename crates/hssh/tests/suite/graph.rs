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
