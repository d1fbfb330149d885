//! A search that is spread over processes has the answer of one, and a process that dies ends it with a word.
#![cfg(all(unix, feature = "cluster"))]

use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::common::{hssh, root, scratch, snake_walk, text, untimed};

const COUNT: [&str; 5] = ["--json", "--search", "count", "--planar", "--travels"];

/// By name: whether the walk is measured, its side, and the search.
const SEARCHES: [(&str, bool, u32, &[&str]); 6] = [
    ("breadth-first", false, 4, &["--planar"]),
    ("cyclic", false, 4, &["--planar", "--max-places", "16"]),
    ("proof", false, 4, &["--planar", "--closed"]),
    ("posterior", true, 5, &["--max-nodes", "8000"]),
    ("posterior-breadth-first", true, 4, &["--planar", "--travels", "14", "--max-nodes", "8000"]),
    ("posterior-proof", true, 4, &["--planar", "--best", "3", "--max-nodes", "8000"]),
];

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

#[test]
fn any_number_of_processes_finds_the_same() {
    for (search, measured, side, options) in SEARCHES {
        let walk = snake_walk("processes", &format!("{search}.ron"), side, measured);
        let found = |more: &[&str]| {
            let output = hssh(
                &[&["map", walk.to_str().unwrap(), "--json", "--search", search], options, more].concat(),
            );
            assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
            untimed(&output.stdout)
        };
        let alone = found(&[]);
        for workers in ["1", "2", "3"] {
            assert_eq!(found(&["--workers", workers]), alone, "{search} by {workers}");
        }
    }
}

/// Addresses of this machine that nobody uses now.
fn free_addresses(count: usize) -> String {
    let held: Vec<TcpListener> = (0..count).map(|_| TcpListener::bind("127.0.0.1:0").unwrap()).collect();
    held.iter().map(|listener| format!("{}\n", listener.local_addr().unwrap())).collect()
}

#[test]
fn a_process_with_another_exploration_is_refused() {
    for search in ["count", "proof"] {
        let hosts = scratch("processes").join(format!("other-{search}.txt"));
        std::fs::write(&hosts, free_addresses(2)).unwrap();
        let start = |process: &str, travels: &str| {
            let walk = snake_walk("processes", &format!("other-{search}-{process}.ron"), 4, false);
            let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
            program.current_dir(root()).arg("map").arg(walk).args([
                "--planar",
                "--search",
                search,
                "--travels",
                travels,
            ]);
            program.arg("--hosts").arg(&hosts).args(["--process", process]);
            program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
        };
        let mut other = start("1", "20");
        let output = start("0", "22").wait_with_output().unwrap();
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("process 1 was given another exploration"), "{said}");
        other.kill().unwrap();
        other.wait().unwrap();
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

/// One of three processes is killed, and two go on from the checkpoint.
fn survives_a_loss(name: &str, whole: &[&str]) {
    let checkpoint = scratch("processes").join(format!("{name}.checkpoint"));
    let _ = std::fs::remove_file(&checkpoint);
    let kept = checkpoint.to_str().unwrap();
    let spread = [whole, &["--checkpoint", kept, "--checkpoint-every", "0.1"]].concat();
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
    assert!(text(&resumed.stderr).contains("goes on from "), "{}", text(&resumed.stderr));
    let alone = hssh(whole);
    assert_eq!(resumed.status.code(), alone.status.code(), "{}", text(&resumed.stderr));
    assert_eq!(untimed(&resumed.stdout), untimed(&alone.stdout));
}

#[test]
fn a_process_that_dies_ends_the_count_and_others_go_on_from_the_checkpoint() {
    let walk = snake_walk("processes", "dies.ron", 5, false);
    survives_a_loss("count", &[&["map", walk.to_str().unwrap()], &COUNT[..], &["34"]].concat());
}

#[test]
fn a_process_that_dies_ends_the_search_and_others_go_on_from_the_checkpoint() {
    let walk = snake_walk("processes", "dies-too.ron", 5, false);
    let topology =
        ["map", walk.to_str().unwrap(), "--json", "--planar", "--search", "breadth-first", "--travels", "31"];
    survives_a_loss("topology", &topology);
    let walk = snake_walk("processes", "dies-measured.ron", 8, true);
    let posterior =
        ["map", walk.to_str().unwrap(), "--json", "--search", "posterior", "--max-nodes", "60000"];
    survives_a_loss("posterior", &posterior);
}

#[test]
fn what_cannot_be_spread_is_refused() {
    let walk = snake_walk("processes", "refused.ron", 5, false);
    let walk = walk.to_str().unwrap();
    let hosts = scratch("processes").join("hosts.txt");
    std::fs::write(&hosts, "127.0.0.1:1\nnowhere\n").unwrap();
    let hosts = hosts.to_str().unwrap();
    for (arguments, words) in [
        (&["--search", "best-first", "--workers", "2"][..], "choose another --search"),
        (&["--readings", "--workers", "2"], "leave out --readings"),
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
