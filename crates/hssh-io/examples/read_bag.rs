//! The scans of a ROS bag with the odometry between them, as a laser log.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::path::PathBuf;

use hssh_io::{RecordingOptions, read_bag};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let usual = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/bags/usual");
    let bag = std::env::args().nth(1).map_or_else(|| PathBuf::from(usual), PathBuf::from);
    let read = read_bag(&bag, &RecordingOptions::default())?;
    for used in &read.used {
        println!("{used}");
    }
    println!("{} scans, {} warnings", read.log.scans.len(), read.log.warnings.len());
    assert!(!read.log.scans.is_empty());
    Ok(())
}
