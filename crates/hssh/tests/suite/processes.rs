//! A count that is spread over processes is the count of one, and a process that dies ends it with a word.
#![cfg(all(unix, feature = "cluster"))]

use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::common::{hssh, root, scratch, snake_walk, text, untimed};

const COUNT: [&str; 5] = ["--json", "--search", "count", "--planar", "--travels"];

#[test]
fn any_number_of_processes_counts_the_same() {
    let walk = snake_walk("processes", "same.ron", 5, false);
    let count = |more: &[&str]| {
        let output = hssh(&[&["map", walk.to_str().unwrap()], &COUNT[..], &["28"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        untimed(&output.stdout)
    };
    let alone = count(&[]);
    for workers in ["1", "2", "3"] {
        assert_eq!(count(&["--workers", workers]), alone);
    }
}

/// The processes that were started by a process.
fn children(of: u32) -> Vec<u32> {
    let output = Command::new("ps").args(["-o", "pid=", "--ppid", &of.to_string()]).output().unwrap();
    text(&output.stdout).split_whitespace().map(|pid| pid.parse().unwrap()).collect()
}

fn wait_for(what: &str, is_there: impl Fn() -> bool) {
    let begun = Instant::now();
    while !is_there() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{what}");
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_process_that_dies_ends_the_count_and_others_go_on_from_the_checkpoint() {
    let walk = snake_walk("processes", "dies.ron", 5, false);
    let checkpoint = scratch("processes").join("dies.checkpoint");
    let _ = std::fs::remove_file(&checkpoint);
    let [walk, kept] = [&walk, &checkpoint].map(|file| file.to_str().unwrap());
    let whole = [&["map", walk], &COUNT[..], &["34"]].concat();
    let spread = [&whole[..], &["--checkpoint", kept, "--checkpoint-every", "0.1"]].concat();
    let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
    program.current_dir(root()).args(&spread).args(["--workers", "3"]);
    let first = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait_for("a checkpoint", || Path::new(kept).exists());
    let helpers = children(first.id());
    assert_eq!(helpers.len(), 2);
    let killed = Command::new("kill").args(["-KILL", &helpers[1].to_string()]).status().unwrap();
    assert!(killed.success());
    let output = first.wait_with_output().unwrap();
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("process of the search died") || said.contains("of the search ended"), "{said}");
    assert!(said.contains("\nhelp: "), "{said}");
    assert!(!said.contains("panicked"), "{said}");
    wait_for("the end of the others", || {
        !Command::new("kill").args(["-0", &helpers[0].to_string()]).status().unwrap().success()
    });

    let resumed = hssh(&[&spread[..], &["--workers", "2"]].concat());
    assert_eq!(resumed.status.code(), Some(0), "{}", text(&resumed.stderr));
    assert!(text(&resumed.stderr).contains("goes on from "), "{}", text(&resumed.stderr));
    assert_eq!(untimed(&resumed.stdout), untimed(&hssh(&whole).stdout));
}

#[test]
fn what_cannot_be_spread_is_refused() {
    let walk = snake_walk("processes", "refused.ron", 5, false);
    let walk = walk.to_str().unwrap();
    let hosts = scratch("processes").join("hosts.txt");
    std::fs::write(&hosts, "127.0.0.1:1\nnowhere\n").unwrap();
    let hosts = hosts.to_str().unwrap();
    for (arguments, words) in [
        (&["--search", "proof", "--workers", "2"][..], "add --search count"),
        (
            &["--search", "count", "--hosts", hosts, "--process", "0"],
            "hosts.txt: line 2: `nowhere` is no address",
        ),
        (&["--search", "count", "--hosts", hosts], "--process"),
        (&["--search", "count", "--workers", "0"], "--workers"),
    ] {
        let output = hssh(&[&["map", walk], arguments].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(words), "{}", text(&output.stderr));
    }
}
