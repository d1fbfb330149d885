//! Searches that are killed at random moments and go on from their checkpoints, beside those that are not.

use std::error::Error;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use hssh_world::{DriftModel, grid, snake};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

use super::program;
use crate::table::{aligned, grouped};

/// How often each search is killed.
const KILLS: usize = 20;

/// Seconds between two checkpoints.
const EVERY: &str = "0.1";

/// A search through the maps of a snake.
struct Case {
    name: &'static str,
    side: u32,
    measured: bool,
    arguments: &'static [&'static str],
}

const CASES: [Case; 4] = [
    Case {
        name: "count, 5×5 planar, 32 travels",
        side: 5,
        measured: false,
        arguments: &["--search", "count", "--planar", "--travels", "32"],
    },
    Case {
        name: "breadth-first, 5×5 planar, 31 travels",
        side: 5,
        measured: false,
        arguments: &["--search", "breadth-first", "--planar", "--travels", "31"],
    },
    Case {
        name: "proof by preference, 6×6 planar",
        side: 6,
        measured: false,
        arguments: &[
            "--search",
            "proof",
            "--planar",
            "--max-places",
            "36",
            "--closed",
            "--max-nodes",
            "2000000",
        ],
    },
    Case {
        name: "posterior, 8×8, 60,000 hypotheses",
        side: 8,
        measured: true,
        arguments: &["--search", "posterior", "--max-nodes", "60000"],
    },
];

/// `cargo xtask bench kills`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let hssh = program()?;
    println!("Each search killed by SIGKILL at {KILLS} random moments, a checkpoint every {EVERY} s.\n");
    let heads = ["", "hypotheses", "whole s", "in pieces s", "went on", "checkpoint MB", "answer"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let folder = std::env::temp_dir().join(format!("hssh-kills-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let mut is_right = true;
    for case in &CASES {
        let row = case.row(&hssh, &folder)?;
        is_right &= row.last().is_some_and(|word| word == "equal");
        rows.push(row);
    }
    std::fs::remove_dir_all(&folder)?;
    println!("{}", aligned(&rows));
    if is_right { Ok(()) } else { Err("an answer differs".into()) }
}

impl Case {
    fn row(&self, hssh: &Path, folder: &Path) -> Result<Vec<String>, Box<dyn Error>> {
        let (walk, checkpoint) = (folder.join("walk.ron"), folder.join("checkpoint"));
        let world = grid(self.side, self.side, 8.0)?;
        let route = world.route_through(&snake(self.side, self.side))?;
        let exploration = match self.measured {
            true => world.explore_with_odometry(&route, &DriftModel::default(), 3)?,
            false => world.explore(&route)?,
        };
        std::fs::write(&walk, exploration.to_ron())?;
        let search = || {
            let mut search = Command::new(hssh);
            search.arg("map").arg(&walk).args(self.arguments).arg("--json");
            search
        };
        let kept = || {
            let mut search = search();
            search.arg("--checkpoint").arg(&checkpoint).args(["--checkpoint-every", EVERY]);
            search
        };
        let (whole, took) = answer(search())?;
        // A search that a limit stops leaves its checkpoint, and the one before was another.
        let _ = std::fs::remove_file(&checkpoint);

        let mut random = ChaCha8Rng::seed_from_u64(1);
        let (mut went_on, mut most_bytes, mut spent) = (0, 0, Duration::ZERO);
        for _ in 0..KILLS {
            went_on += usize::from(checkpoint.exists());
            let mut child = kept().stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
            let moment = took.mul_f64(0.3 * random.random::<f64>());
            sleep(moment);
            child.kill()?;
            child.wait()?;
            spent += moment;
            most_bytes = most_bytes.max(std::fs::metadata(&checkpoint).map_or(0, |known| known.len()));
        }
        went_on += usize::from(checkpoint.exists());
        let (pieces, last) = answer(kept())?;
        Ok(vec![
            self.name.to_owned(),
            grouped(whole["search"]["nodes"].as_u64().unwrap_or(0)),
            format!("{:.1}", took.as_secs_f64()),
            format!("{:.1}", (spent + last).as_secs_f64()),
            format!("{went_on} of {}", KILLS + 1),
            format!("{:.1}", most_bytes as f64 / 1e6),
            if pieces == whole { "equal" } else { "DIFFERS" }.to_owned(),
        ])
    }
}

/// What a search answers, but for the time that it took, and that.
fn answer(mut search: Command) -> Result<(Value, Duration), Box<dyn Error>> {
    let started = Instant::now();
    let output = search.stderr(Stdio::null()).output()?;
    let took = started.elapsed();
    let mut answer: Value = serde_json::from_slice(&output.stdout)?;
    answer["search"]["seconds"] = Value::Null;
    Ok((answer, took))
}
