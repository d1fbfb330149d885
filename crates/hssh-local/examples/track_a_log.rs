//! Corrects the odometry of a laser log by matching scan with scan: a CARMEN file, or a robot that drives through a hall.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::fmt::Write as _;

use hssh_local::{LaserLog, MatchOptions, track};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).map_or_else(|| Ok(hall()), std::fs::read_to_string)?;
    let log = LaserLog::read(text.as_bytes())?;
    let track = track(&log, &MatchOptions::default(), |_| {});
    let last = track.scans.last().ok_or("there is no scan")?;
    let told = log.scans[log.scans.len() - 1].odometry;
    println!(
        "odometry ends at ({:.2}, {:.2}), scan matching at ({:.2}, {:.2})",
        told.x, told.y, last.pose.x, last.pose.y
    );
    assert_eq!(track.scans.len(), log.scans.len());
    Ok(())
}

/// A hall of 12 m by 8 m, through which the robot drives 4 m; its odometry says 10% more.
fn hall() -> String {
    let mut text = String::new();
    for scan in 0..21 {
        let (x, told) = (2.0 + 0.2 * f64::from(scan), 0.22 * f64::from(scan));
        let range = |beam: i32| {
            let (sin, cos) = f64::from(beam - 90).to_radians().sin_cos();
            let side = if sin > 0.0 { 5.0 } else { 3.0 };
            (side / sin.abs().max(1e-9)).min((12.0 - x) / cos.max(1e-9))
        };
        let ranges: Vec<String> = (0..181).map(|beam| format!("{:.3}", range(beam))).collect();
        let _ = writeln!(text, "FLASER 181 {} {x} 4 0 {told} 0 0 {scan} host {scan}", ranges.join(" "));
    }
    text
}
