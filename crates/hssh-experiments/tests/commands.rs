//! The program as it is called: what it says when something is missing.

use std::process::{Command, Output};

fn experiments(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hssh-experiments")).args(arguments).output().expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_folder_that_is_missing_is_named() {
    let output = experiments(&["grids", "no/such/folder"]);
    assert!(!output.status.success());
    assert!(text(&output.stderr).starts_with("error: cannot read no/such/folder/gridmap"));
}

#[test]
fn a_log_that_is_not_at_hand_is_said_to_be_skipped() {
    let output = experiments(&["log", "no/such/folder"]);
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("aces: skipped, there is no no/such/folder/logs/aces.log.gz"));
}

#[test]
fn an_unknown_command_is_refused() {
    let output = experiments(&["maps"]);
    assert!(!output.status.success());
    assert!(text(&output.stderr).contains("unexpected argument: \"maps\""));
}

#[test]
fn an_experiment_holds_its_published_counts() {
    let output = experiments(&["experiment", "figure-2-4", "--check"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}
