//! A search that was killed goes on from its checkpoint, and ends with the answer of one that was not.
#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::common::{hssh, root, scratch, snake_walk, text, untimed};

/// How often each search is killed.
const KILLS: u32 = 20;

/// Kills a search with SIGKILL at moments that are anywhere, and begins again with the same command each time.
fn killed(arguments: &[&str], checkpoint: &Path, whole: Duration) -> Value {
    let _ = std::fs::remove_file(checkpoint);
    let started = |arguments: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
        program.current_dir(root()).args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        program.spawn().unwrap()
    };
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    for _ in 0..KILLS {
        let mut child = started(arguments);
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        // At most so late that a few runs together do not come to the end.
        let share = (random >> 33) as f64 / f64::from(1_u32 << 31);
        sleep(whole.mul_f64(0.4 * share));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let output = hssh(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(!checkpoint.exists(), "what came to its end leaves no checkpoint");
    untimed(&output.stdout)
}

fn survives_kills(name: &str, side: u32, measured: bool, search: &[&str]) {
    let file = snake_walk("checkpoints", &format!("{name}.ron"), side, measured);
    let checkpoint = scratch("checkpoints").join(format!("{name}.checkpoint"));
    let [file, kept] = [&file, &checkpoint].map(|file| file.to_str().unwrap());
    let arguments = [&["map", file, "--json"], search].concat();
    let started = Instant::now();
    let whole = hssh(&arguments);
    let took = started.elapsed();
    assert_eq!(whole.status.code(), Some(0), "{}", text(&whole.stderr));
    let kept = [&arguments[..], &["--checkpoint", kept, "--checkpoint-every", "0.01"]].concat();
    assert_eq!(killed(&kept, &checkpoint, took), untimed(&whole.stdout));
}

#[test]
fn a_count_goes_on_after_it_was_killed() {
    survives_kills("count", 5, false, &["--search", "count", "--planar", "--travels", "32"]);
}

#[test]
fn a_search_level_by_level_goes_on_after_it_was_killed() {
    survives_kills("breadth-first", 5, false, &["--search", "breadth-first", "--planar", "--travels", "21"]);
}

#[test]
fn a_search_by_posterior_goes_on_after_it_was_killed() {
    survives_kills("posterior", 6, true, &["--search", "posterior", "--travels", "46"]);
}

#[test]
fn a_search_that_reckons_with_errors_goes_on_after_it_was_killed() {
    survives_kills("readings", 4, true, &["--readings", "--planar", "--travels", "24"]);
    let readings = scratch("checkpoints").join("readings.checkpoint.readings");
    assert!(!readings.exists(), "what came to its end leaves no checkpoint");
}

#[test]
fn a_search_that_is_stopped_says_how_to_go_on() {
    let file = snake_walk("checkpoints", "stopped.ron", 5, false);
    let checkpoint = scratch("checkpoints").join("stopped.checkpoint");
    let _ = std::fs::remove_file(&checkpoint);
    let [file, kept] = [&file, &checkpoint].map(|file| file.to_str().unwrap());
    let search = |most: &str| {
        hssh(&["map", file, "--planar", "--search", "proof", "--checkpoint", kept, "--max-nodes", most])
    };
    let stopped = search("2000");
    assert_eq!(stopped.status.code(), Some(3));
    assert!(text(&stopped.stderr).contains("the same command goes on from "), "{}", text(&stopped.stderr));
    let more = search("4000");
    assert!(text(&more.stderr).contains("goes on from "), "{}", text(&more.stderr));

    let other = hssh(&["map", file, "--search", "proof", "--checkpoint", kept]);
    let said = text(&other.stderr);
    assert_eq!(other.status.code(), Some(2), "{said}");
    assert!(said.contains("stopped.checkpoint: it is of a search with other options"), "{said}");
    assert!(said.contains("\nhelp: give another file"), "{said}");
    assert!(checkpoint.exists(), "what was refused stays");

    let whole = std::fs::read(&checkpoint).unwrap();
    std::fs::write(&checkpoint, &whole[..whole.len() / 2]).unwrap();
    let damaged = search("4000");
    assert_eq!(damaged.status.code(), Some(2));
    assert!(text(&damaged.stderr).contains("it is damaged"), "{}", text(&damaged.stderr));
    let output = hssh(&["map", file, "--checkpoint", file]);
    assert!(text(&output.stderr).contains("hssh does not write over what it reads"));
}
