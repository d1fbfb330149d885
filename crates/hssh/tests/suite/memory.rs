//! What the program takes is what it may take.
#![cfg(target_os = "linux")]

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::common::{root, snake_walk, text};

/// MiB.
const MOST: f64 = 100.0;

/// The most memory that was resident of a process so far, in MiB; nothing if it has ended.
fn peak(process: u32) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.split_whitespace().next()?.parse::<f64>().ok()? / 1024.0)
}

#[test]
fn a_search_that_outgrows_its_memory_takes_what_it_may_and_little_more() {
    let file = snake_walk("memory", "walk.ron", 9, false);
    for search in ["breadth-first", "proof"] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
        program.current_dir(root()).arg("map").arg(&file).args(["--planar", "--search", search]);
        program.args(["--max-memory", &format!("{MOST}M")]).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = program.spawn().unwrap();
        let mut most = 0.0;
        while child.try_wait().unwrap().is_none() {
            most = peak(child.id()).unwrap_or(most);
            sleep(Duration::from_millis(2));
        }
        let output = child.wait_with_output().unwrap();
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(3), "{said}");
        assert!(said.contains("stopped by the memory limit"), "{said}");
        assert!((0.9 * MOST..=1.1 * MOST).contains(&most), "{search} took {most} MiB");
    }
}
