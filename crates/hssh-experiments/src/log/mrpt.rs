//! MRPT's icp-slam and rbpf-slam on the scans and the raw odometry of a log.

use std::error::Error;
use std::fmt::Write;
use std::process::Command;

use hssh_local::LaserLog;
use hssh_metrics::Pose;
use serde::Deserialize;

use crate::root;

/// What one of them makes of a log.
#[derive(Debug, Deserialize)]
pub(super) struct Mrpt {
    pub(super) peer: String,
    /// Processor time.
    pub(super) seconds: f64,
    pub(super) megabytes: f64,
    poses: Vec<[f64; 3]>,
    /// Why there is not one pose for each scan.
    #[serde(default)]
    pub(super) problem: Option<String>,
}

impl Mrpt {
    /// Where it has the scans; none if it did not come to its end.
    pub(super) fn poses(&self) -> Option<Vec<Pose>> {
        let is_whole = self.problem.is_none();
        is_whole.then(|| self.poses.iter().map(|&[x, y, theta]| Pose::new(x, y, theta)).collect())
    }
}

/// Whether both are installed, and what brings a log into their form.
pub(super) fn is_installed() -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let is_there = |program: &&str| std::env::split_paths(&path).any(|folder| folder.join(program).is_file());
    ["icp-slam", "rbpf-slam", "carmen2rawlog", "python3"].iter().all(is_there)
}

/// Runs both, one after the other.
pub(super) fn run(name: &str, log: &LaserLog) -> Result<Vec<Mrpt>, Box<dyn Error>> {
    let file = std::env::temp_dir().join(format!("hssh-mrpt-{}-{name}.log", std::process::id()));
    std::fs::write(&file, text(log))?;
    let output = Command::new("python3").arg(root::scripts().join("mrpt.py")).arg(&file).output();
    std::fs::remove_file(&file)?;
    let output = output?;
    if !output.status.success() {
        return Err(format!("mrpt.py: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    String::from_utf8(output.stdout)?.lines().map(|line| Ok(serde_json::from_str(line)?)).collect()
}

/// The scans with raw odometry only: the laser is where the robot is.
fn text(log: &LaserLog) -> String {
    let step =
        log.scans.first().map_or(1.0, |scan| (scan.scan.bearing(1) - scan.scan.bearing(0)).to_degrees());
    let mut text = format!(
        "PARAM laser_front_laser_resolution {step} host 0\nPARAM robot_front_laser_max {} host 0\n",
        log.max_range
    );
    for (number, logged) in log.scans.iter().enumerate() {
        let _ = write!(text, "FLASER {}", logged.scan.ranges.len());
        for range in &logged.scan.ranges {
            let _ = write!(text, " {}", range.min(log.max_range));
        }
        let Pose { x, y, theta } = logged.odometry;
        let time = logged.time.unwrap_or(number as f64);
        let _ = writeln!(text, " {x} {y} {theta} {x} {y} {theta} {time} host {time}");
    }
    text
}
