//! Whoever ends a long command gets what it knows: by Ctrl-C, and by the signals of those who end programs.
#![cfg(unix)]

use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use hssh::world::{grid, snake};

use super::common::{hssh, root, scratch, text};

/// Runs the program, and sends it a signal once it is under way.
fn ended(signal: &str, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
    program.current_dir(root()).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = program.spawn().unwrap();
    sleep(Duration::from_millis(1500));
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    child.wait_with_output().unwrap()
}

#[test]
fn a_search_that_is_ended_shows_what_got_farthest() {
    let world = grid(8, 8, 8.0).unwrap();
    let walk = world.explore(&world.route_through(&snake(8, 8)).unwrap()).unwrap();
    let file = scratch("signals").join("snake.ron");
    std::fs::write(&file, walk.to_ron()).unwrap();
    let search = ["map", file.to_str().unwrap(), "--planar", "--search", "proof"];
    for signal in ["-TERM", "-HUP", "-INT"] {
        let output = ended(signal, &search);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(3), "{said}{}", text(&output.stderr));
        assert!(said.contains("interrupted (") && said.contains("the search stopped early."), "{said}");
        assert!(said.contains("\n  rank"), "{said}");
    }
}

#[test]
fn a_drive_that_is_ended_leaves_its_log() {
    let log = scratch("signals").join("drive.log");
    let file = log.to_str().unwrap();
    let _ = std::fs::remove_file(&log);
    let output =
        ended("-TERM", &["simulate", "--floor", "ring", "--wander", "--travels", "100000", "-o", file]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("the drive was interrupted"));
    let scans = std::fs::read_to_string(&log).unwrap();
    assert!(scans.lines().filter(|line| line.starts_with("FLASER")).count() > 3);
}

#[test]
fn a_survey_that_is_ended_is_one_of_the_scans_so_far() {
    let folder = scratch("signals");
    let (log, found) = (folder.join("long.log"), folder.join("found.ron"));
    let file = log.to_str().unwrap();
    let drive = hssh(&["simulate", "--floor", "figure-eight", "--wander", "--travels", "60", "-o", file]);
    assert!(log.is_file(), "{}", text(&drive.stderr));
    let output = ended("-TERM", &["explore", file, "-o", found.to_str().unwrap()]);
    // A fast machine may be done before.
    if output.status.code() != Some(0) {
        assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains("the survey was interrupted"));
    }
}
