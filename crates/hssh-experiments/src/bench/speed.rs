//! Complete searches as whole processes: wall and processor time, memory, nodes per second.

use std::error::Error;
use std::process::Command;
use std::time::Instant;

use hssh_search::Mapper;
use hssh_topology::Axioms;
use hssh_world::{grid, snake};
use serde::{Deserialize, Serialize};

use crate::bench::median;
use crate::bench::usage::Usage;
use crate::flags;
use crate::table::{aligned, grouped};

/// A complete search of the snake through a square grid.
struct Case {
    name: &'static str,
    side: u32,
    axioms: Axioms,
    keeps_tree: bool,
}

const CASES: [Case; 3] = [
    Case { name: "exhaustive-4x4", side: 4, axioms: Axioms::PUBLISHED, keeps_tree: false },
    Case { name: "breadth-first-4x4", side: 4, axioms: Axioms::PUBLISHED, keeps_tree: true },
    Case {
        name: "exhaustive-5x5-planar-25",
        side: 5,
        axioms: Axioms { max_genus: Some(0), max_places: Some(25), ..Axioms::PUBLISHED },
        keeps_tree: false,
    },
];

/// What one process reports of itself.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Measurement {
    nodes: u64,
    /// Of the tree; nothing is kept of it by an exhaustive count but its top.
    tree_bytes: u64,
    user_seconds: f64,
    peak_bytes: u64,
}

/// `cargo xtask measure`: one search, then its cost as one line of JSON.
pub(crate) fn measure(flags: &flags::Measure) -> Result<(), Box<dyn Error>> {
    let case = CASES.iter().find(|case| case.name == flags.name);
    let names = CASES.map(|case| case.name).join(", ");
    let case = case.ok_or_else(|| format!("there is no search `{}`; there are: {names}", flags.name))?;
    let world = grid(case.side, case.side, 8.0)?;
    let exploration = world.explore(&world.route_through(&snake(case.side, case.side))?)?;
    let (nodes, tree_bytes) = if case.keeps_tree {
        let mapper = Mapper::builder().axioms(case.axioms).threads(flags.threads).explain(&exploration)?;
        (mapper.tree().len() as u64, mapper.tree().bytes())
    } else {
        let report = Mapper::builder().axioms(case.axioms).threads(flags.threads).count(&exploration)?;
        (report.nodes, report.bytes)
    };
    let Usage { user_seconds, peak_bytes } = Usage::now()?;
    println!("{}", serde_json::to_string(&Measurement { nodes, tree_bytes, user_seconds, peak_bytes })?);
    Ok(())
}

/// A measurement and the seconds from the start of the process to its end.
struct Run {
    wall: f64,
    measurement: Measurement,
}

/// Runs every case in processes of its own, with one and with two threads in turn.
pub(crate) fn run(runs: usize) -> Result<(), Box<dyn Error>> {
    println!("Complete searches as whole processes, medians of {runs} runs.\n");
    let heads = ["", "threads", "nodes", "wall s", "user s", "nodes/s", "peak MB", "tree bytes/node"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let mut ratios = Vec::new();
    for case in &CASES {
        let mut by_threads: [Vec<Run>; 2] = [Vec::new(), Vec::new()];
        for _ in 0..runs {
            for (threads, done) in (1..).zip(&mut by_threads) {
                done.push(process(case, threads)?);
            }
        }
        let [one, two] = &by_threads;
        let pairs = one.iter().zip(two).map(|(one, two)| one.wall / two.wall);
        let ratio = median(pairs.collect());
        ratios.push(format!("{}: two threads are {ratio:.2} times as fast as one", case.name));
        rows.extend((1..).zip(&by_threads).map(|(threads, done)| row(case, threads, done)));
    }
    println!("{}\nMedian of the ratios run by run:\n{}\n", aligned(&rows), ratios.join("\n"));
    Ok(())
}

fn process(case: &Case, threads: usize) -> Result<Run, Box<dyn Error>> {
    let this = std::env::current_exe()?;
    let started = Instant::now();
    let output = Command::new(this).args(["measure", case.name, &threads.to_string()]).output()?;
    let wall = started.elapsed().as_secs_f64();
    if !output.status.success() {
        return Err(format!("{}: {}", case.name, String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(Run { wall, measurement: serde_json::from_slice(&output.stdout)? })
}

fn row(case: &Case, threads: usize, runs: &[Run]) -> Vec<String> {
    let of = |value: fn(&Run) -> f64| median(runs.iter().map(value).collect());
    let nodes = of(|run| run.measurement.nodes as f64);
    let tree = of(|run| run.measurement.tree_bytes as f64);
    let wall = of(|run| run.wall);
    vec![
        case.name.to_owned(),
        threads.to_string(),
        grouped(nodes as u64),
        format!("{wall:.2}"),
        format!("{:.2}", of(|run| run.measurement.user_seconds)),
        grouped((nodes / wall) as u64),
        format!("{:.1}", of(|run| run.measurement.peak_bytes as f64) / 1e6),
        if case.keeps_tree { format!("{:.1}", tree / nodes) } else { "–".to_owned() },
    ]
}
