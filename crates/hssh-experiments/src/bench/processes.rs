//! Searches by threads and by processes of one machine: time, and hypotheses a second.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use hssh_world::{DriftModel, grid, snake};

use super::program;
use crate::table::{aligned, grouped};

/// A search through the maps of a snake.
struct Case {
    name: &'static str,
    side: u32,
    measured: bool,
    arguments: &'static [&'static str],
}

const CASES: [Case; 7] = [
    Case {
        name: "count, 5×5, 25 places",
        side: 5,
        measured: false,
        arguments: &["--search", "count", "--max-places", "25"],
    },
    Case {
        name: "count, 6×6, 36 places, 28 travels",
        side: 6,
        measured: false,
        arguments: &["--search", "count", "--max-places", "36", "--travels", "28"],
    },
    Case {
        name: "breadth-first, 5×5, 31 travels",
        side: 5,
        measured: false,
        arguments: &["--search", "breadth-first", "--travels", "31"],
    },
    Case {
        name: "proof, 6×6, 36 places, closed",
        side: 6,
        measured: false,
        arguments: &["--search", "proof", "--max-places", "36", "--closed", "--max-nodes", "2000000"],
    },
    Case {
        name: "posterior, 8×8",
        side: 8,
        measured: true,
        arguments: &["--search", "posterior", "--max-nodes", "150000"],
    },
    Case {
        name: "posterior level by level, 6×6, 17 travels",
        side: 6,
        measured: true,
        arguments: &["--search", "posterior-breadth-first", "--travels", "17"],
    },
    Case {
        name: "posterior proof, 8×8",
        side: 8,
        measured: true,
        arguments: &["--search", "posterior-proof", "--max-nodes", "60000"],
    },
];

/// Who searches.
const MEANS: [(&str, &[&str]); 5] = [
    ("1 thread", &["--threads", "1"]),
    ("2 threads", &["--threads", "2"]),
    ("1 process", &["--workers", "1"]),
    ("2 processes", &["--workers", "2"]),
    ("4 processes", &["--workers", "4"]),
];

/// `cargo xtask bench processes`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let hssh = program()?;
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    println!("Planar searches as whole programs, processes connected over loopback; {cores} cores.\n");
    let heads = ["", "by", "hypotheses", "wall s", "user s", "a second", "a user second"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let folder = std::env::temp_dir().join(format!("hssh-processes-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    for case in &CASES {
        let mut counted = None;
        for (means, arguments) in MEANS {
            let (nodes, wall, user) = case.search(arguments, &hssh, &folder)?;
            if *counted.get_or_insert(nodes) != nodes {
                return Err(format!("{} by {means}: {nodes} hypotheses", case.name).into());
            }
            let rate = |seconds: f64| grouped((nodes as f64 / seconds) as u64);
            rows.push(vec![
                case.name.to_owned(),
                means.to_owned(),
                grouped(nodes),
                format!("{wall:.1}"),
                format!("{user:.1}"),
                rate(wall),
                rate(user),
            ]);
        }
    }
    std::fs::remove_dir_all(&folder)?;
    println!("{}", aligned(&rows));
    Ok(())
}

impl Case {
    /// How many hypotheses were made, and what that took: elapsed seconds, and those of all processes.
    fn search(&self, means: &[&str], hssh: &Path, folder: &Path) -> Result<(u64, f64, f64), Box<dyn Error>> {
        let walk = folder.join("walk.ron");
        let world = grid(self.side, self.side, 8.0)?;
        let route = world.route_through(&snake(self.side, self.side))?;
        let exploration = match self.measured {
            true => world.explore_with_odometry(&route, &DriftModel::default(), 3)?,
            false => world.explore(&route)?,
        };
        std::fs::write(&walk, exploration.to_ron())?;
        let mut timed = Command::new("/usr/bin/time");
        timed.args(["--format", "%e %U"]).arg(hssh).arg("map").arg(&walk);
        timed.args(["--json", "--planar"]).args(self.arguments).args(means);
        let output = timed.output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        let times = said.lines().last().and_then(|line| line.split_once(' '));
        let (wall, user) = times.ok_or_else(|| format!("no times from GNU time:\n{said}"))?;
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout)?;
        let nodes = answer["search"]["nodes"].as_u64().ok_or("no count")?;
        Ok((nodes, wall.trim().parse()?, user.trim().parse()?))
    }
}
