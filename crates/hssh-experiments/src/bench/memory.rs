//! What searches take that outgrow their memory, beside what they may take.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use hssh_world::{DriftModel, grid, snake};

use super::program;
use crate::table::{aligned, grouped};

/// What a search may take: MiB.
const LIMITS: [u64; 3] = [200, 500, 1000];

/// Of searches that spill: what they may take, MiB, and for how long they go on then, in seconds.
const SPILLING: (u64, &str) = (200, "60");

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
            let Taken { peak, stop, .. } = case.run(limit, None, &hssh, &folder)?;
            row.extend([format!("{peak:.0}"), format!("{:.2}", peak / limit as f64)]);
            stops.push(stop);
        }
        stops.dedup();
        row.push(stops.join(", "));
        rows.push(row);
    }
    println!("{}", aligned(&rows));

    let (limit, seconds) = SPILLING;
    println!(
        "\nWith {limit} MiB, and the rest in a file (--spill, --max-time {seconds}), against stopping there.\n"
    );
    let heads = ["", "MiB", "of the limit", "hypotheses", "spilling", "MiB", "of the limit", "stopped"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for case in CASES.iter().filter(|case| !case.search.ends_with("breadth-first")) {
        let stopped = case.run(limit, None, &hssh, &folder)?;
        let spilled = case.run(limit, Some(seconds), &hssh, &folder)?;
        let share = |taken: &Taken| format!("{:.2}", taken.peak / limit as f64);
        rows.push(vec![
            case.search.to_owned(),
            format!("{:.0}", stopped.peak),
            share(&stopped),
            grouped(stopped.nodes),
            grouped(spilled.nodes),
            format!("{:.0}", spilled.peak),
            share(&spilled),
            spilled.stop,
        ]);
    }
    std::fs::remove_dir_all(&folder)?;
    println!("{}", aligned(&rows));
    Ok(())
}

/// What a search came to.
struct Taken {
    /// The most memory, MiB.
    peak: f64,
    nodes: u64,
    stop: String,
}

impl Case {
    /// What one search takes; one that spills goes on for so many seconds.
    fn run(
        &self,
        limit: u64,
        spilling: Option<&str>,
        hssh: &Path,
        folder: &Path,
    ) -> Result<Taken, Box<dyn Error>> {
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
        if let Some(seconds) = spilling {
            timed.arg("--spill").arg(folder).args(["--max-time", seconds]);
        }
        let output = timed.output()?;
        let _ = std::fs::remove_file(&checkpoint);
        let said = String::from_utf8_lossy(&output.stderr);
        let kibibytes = said.lines().rev().find_map(|line| line.trim().parse::<f64>().ok());
        let peak = kibibytes.ok_or_else(|| format!("no peak from GNU time:\n{said}"))? / 1024.0;
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout)?;
        let stop = answer["search"]["stop"].as_str().unwrap_or("?").replace('_', " ");
        Ok(Taken { peak, nodes: answer["search"]["nodes"].as_u64().unwrap_or(0), stop })
    }
}
