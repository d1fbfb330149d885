//! What searches take that outgrow their memory, beside what they may take.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use hssh_world::{DriftModel, grid, snake};

use super::program;
use crate::table::aligned;

/// What a search may take: MiB.
const LIMITS: [u64; 3] = [200, 500, 1000];

/// A search that grows beyond all of them.
struct Case {
    search: &'static str,
    side: u32,
    /// How much more the odometry errs than usual; nothing if there is none.
    noise: Option<f64>,
    arguments: &'static [&'static str],
}

const CASES: [Case; 8] = [
    Case { search: "breadth-first", side: 6, noise: None, arguments: &[] },
    Case { search: "best-first", side: 9, noise: None, arguments: &["--closed"] },
    Case { search: "cyclic", side: 9, noise: None, arguments: &[] },
    Case { search: "proof", side: 9, noise: None, arguments: &[] },
    Case { search: "posterior", side: 12, noise: Some(40.0), arguments: &["--rest", "1e-300"] },
    Case { search: "posterior-breadth-first", side: 6, noise: Some(1.0), arguments: &[] },
    Case { search: "posterior-best-first", side: 12, noise: Some(40.0), arguments: &["--closed"] },
    Case { search: "posterior-proof", side: 12, noise: Some(40.0), arguments: &[] },
];

/// `cargo xtask bench memory`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let hssh = program()?;
    println!(
        "The most that the program takes (MiB, by GNU time) with --max-memory, and in parts of that; a checkpoint is left.\n"
    );
    let mut rows = vec![vec![String::new()]];
    rows[0].extend(LIMITS.iter().flat_map(|limit| [format!("{limit} MiB"), String::new()]));
    rows[0].push("stopped".to_owned());
    let folder = std::env::temp_dir().join(format!("hssh-memory-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    for case in &CASES {
        let mut row = vec![case.search.to_owned()];
        let mut stops = Vec::new();
        for limit in LIMITS {
            let (peak, stop) = case.peak(limit, &hssh, &folder)?;
            row.extend([format!("{peak:.0}"), format!("{:.2}", peak / limit as f64)]);
            stops.push(stop);
        }
        stops.dedup();
        row.push(stops.join(", "));
        rows.push(row);
    }
    std::fs::remove_dir_all(&folder)?;
    println!("{}", aligned(&rows));
    Ok(())
}

impl Case {
    /// The most that one search takes, in MiB, and why it stopped.
    fn peak(&self, limit: u64, hssh: &Path, folder: &Path) -> Result<(f64, String), Box<dyn Error>> {
        let (walk, checkpoint) = (folder.join("walk.ron"), folder.join("checkpoint"));
        let world = grid(self.side, self.side, 8.0)?;
        let route = world.route_through(&snake(self.side, self.side))?;
        let exploration = match self.noise {
            Some(noise) => world.explore_with_odometry(&route, &DriftModel::default().scaled(noise), 3)?,
            None => world.explore(&route)?,
        };
        std::fs::write(&walk, exploration.to_ron())?;
        let mut timed = Command::new("/usr/bin/time");
        timed.args(["--format", "%M"]).arg(hssh).arg("map").arg(&walk);
        timed
            .args(["--json", "--search", self.search, "--max-memory", &limit.to_string()])
            .args(self.arguments);
        timed.arg("--checkpoint").arg(&checkpoint);
        let output = timed.output()?;
        let _ = std::fs::remove_file(&checkpoint);
        let said = String::from_utf8_lossy(&output.stderr);
        let kibibytes = said.lines().rev().find_map(|line| line.trim().parse::<f64>().ok());
        let peak = kibibytes.ok_or_else(|| format!("no peak from GNU time:\n{said}"))? / 1024.0;
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout)?;
        Ok((peak, answer["search"]["stop"].as_str().unwrap_or("?").replace('_', " ")))
    }
}
