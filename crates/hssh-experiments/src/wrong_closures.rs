//! Wrong closures in pose graphs: how far off the poses are with graduated non-convexity, with dynamic covariance scaling,
//! without either, and with GTSAM's graduated non-convexity.

use std::error::Error;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use hssh_local::{ClosingOptions, LaserLog, MatchOptions, close_loops, track};
use hssh_metrics::{
    Edge, GraphFile, Kernel, Options, Pose, PoseGraph, PoseId, odometry_poses, screen_closures,
    solve_from_anywhere, solve_robustly,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;

use crate::flags;
use crate::pose_graphs::{folder, read};
use crate::root;
use crate::score::root_mean_square;
use crate::table::aligned;

/// Logs of which all scans are in one graph, and public graphs.
const LOGS: [&str; 2] = ["aces", "intel"];
const GRAPHS: [&str; 3] = ["intel.g2o", "CSAIL.g2o", "manhattan.g2o"];
/// Of all closures, the parts that are wrong.
const PARTS: [f64; 3] = [0.1, 0.3, 0.5];
/// One right closure in a hundred has a larger χ².
const THRESHOLD: f64 = 11.34;
/// Wrong closures say that the robot was back within so many metres.
const NEAR: f64 = 2.0;

/// What the script prints.
#[derive(Debug, Deserialize)]
struct Screened {
    poses: Vec<[f64; 3]>,
    accepted: Vec<bool>,
}

/// `cargo xtask wrong-closures`.
///
/// # Errors
/// If a file cannot be read, or a graph cannot be solved.
pub(crate) fn run(flags: &flags::WrongClosures) -> Result<(), Box<dyn Error>> {
    let graphs = folder(flags.data.as_deref())?;
    let mut all = Vec::new();
    for name in LOGS {
        let path = graphs.with_file_name("logs").join(format!("{name}.log.gz"));
        all.push((format!("{name}, all scans"), of_scans(&path)?));
    }
    for name in GRAPHS {
        all.push((name.to_owned(), read(&graphs, name)?.graph));
    }
    let heads = [
        "",
        "poses",
        "closures",
        "wrong",
        "none",
        "DCS",
        "GNC",
        "taken/refused",
        "GTSAM's GNC",
        "taken/refused",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (seed, (name, graph)) in (0..).zip(&all) {
        for part in PARTS {
            let row = row(name, graph, part, seed, flags.python.as_deref());
            let row = row.map_err(|error| format!("{name}, {part}: {error}"))?;
            eprintln!("{}", row.join("  "));
            rows.push(row);
        }
    }
    println!(
        "Root mean square distance in metres from the poses of the graph without wrong closures, where the two fit best,"
    );
    println!(
        "from dead reckoning; taken/refused: wrong closures that were believed, right ones that were not."
    );
    println!("{}", aligned(&rows));
    Ok(())
}

/// The graph of all scans of a log.
fn of_scans(path: &Path) -> Result<PoseGraph, Box<dyn Error>> {
    let file = File::open(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let log = LaserLog::read(file)?;
    let track = track(&log, &MatchOptions::default(), |_| ());
    Ok(close_loops(&log, &track, &ClosingOptions::default(), |_| ())?.graph)
}

fn row(
    name: &str,
    graph: &PoseGraph,
    part: f64,
    seed: u64,
    python: Option<&Path>,
) -> Result<Vec<String>, Box<dyn Error>> {
    let options = Options::default();
    let right = solve_from_anywhere(graph, &options)?.poses;
    let (mut spoiled, wrong) = spoiled(graph, &right, part, seed)?;
    let suspects: Vec<bool> = spoiled.edges().iter().map(is_suspect).collect();
    let start = odometry_poses(&spoiled)?;
    spoiled.set_poses(start)?;
    let off = |poses: &[Pose]| format!("{:.3}", root_mean_square(poses, &right));
    let plain = solve_from_anywhere(&spoiled, &options)?.poses;
    let kernel = |edge: &Edge| is_suspect(edge).then_some(Kernel::DynamicCovarianceScaling(THRESHOLD.sqrt()));
    let scaled = solve_robustly(&spoiled, kernel, &options)?.poses;
    let screened = screen_closures(&spoiled, is_suspect, THRESHOLD, &options)?;
    let judged = |accepted: &[bool]| {
        let (mut taken, mut refused) = (0, 0);
        for ((&is_accepted, &is_wrong), &is_suspect) in accepted.iter().zip(&wrong).zip(&suspects) {
            taken += usize::from(is_suspect && is_accepted && is_wrong);
            refused += usize::from(is_suspect && !is_accepted && !is_wrong);
        }
        format!("{taken}/{refused}")
    };
    let mut row = vec![name.to_owned(), graph.poses().len().to_string()];
    row.push((suspects.iter().filter(|&&suspect| suspect).count()).to_string());
    row.push(format!("{:.0} %", 100.0 * part));
    row.extend([off(&plain), off(&scaled), off(&screened.solution.poses), judged(&screened.accepted)]);
    match python.map(|python| of_gtsam(&spoiled, &suspects, python)).transpose()? {
        Some(found) => {
            let poses: Vec<Pose> = found.poses.iter().map(|&[x, y, theta]| Pose::new(x, y, theta)).collect();
            row.extend([off(&poses), judged(&found.accepted)]);
        }
        None => row.extend(["–".to_owned(), "–".to_owned()]),
    }
    Ok(row)
}

/// Whether an edge may be wrong: all may that do not lead from a pose to the next.
fn is_suspect(edge: &Edge) -> bool {
    edge.to.0 != edge.from.0 + 1
}

/// The graph with so many wrong closures that they are that part of all, and which edges are wrong.
fn spoiled(
    graph: &PoseGraph,
    right: &[Pose],
    part: f64,
    seed: u64,
) -> Result<(PoseGraph, Vec<bool>), Box<dyn Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(1000 * seed + (100.0 * part) as u64);
    let mut spoiled = graph.clone();
    let true_ones: Vec<Edge> = graph.edges().iter().filter(|edge| is_suspect(edge)).copied().collect();
    let mut wrong = vec![false; graph.edges().len()];
    let count = (true_ones.len() as f64 * part / (1.0 - part)).round() as usize;
    let poses = right.len() as u32;
    while wrong.len() < graph.edges().len() + count {
        let (from, to) = (random.random_range(0..poses), random.random_range(0..poses));
        let (from, to) = (from.min(to), from.max(to));
        let told = Pose::new(
            random.random_range(-NEAR..NEAR),
            random.random_range(-NEAR..NEAR),
            random.random_range(-std::f64::consts::PI..std::f64::consts::PI),
        );
        let truth = right[from as usize].between(right[to as usize]);
        // What is nearly right is not wrong.
        if to <= from + 1 || truth.between(told).translation().norm() < NEAR {
            continue;
        }
        let like = true_ones[random.random_range(0..true_ones.len())];
        spoiled.add_edge(Edge { from: PoseId(from), to: PoseId(to), relative_pose: told, ..like })?;
        wrong.push(true);
    }
    Ok((spoiled, wrong))
}

/// What GTSAM makes of it.
fn of_gtsam(graph: &PoseGraph, suspects: &[bool], python: &Path) -> Result<Screened, Box<dyn Error>> {
    let path = std::env::temp_dir().join(format!("hssh-wrong-closures-{}.g2o", std::process::id()));
    fs::write(&path, GraphFile::from(graph.clone()).to_g2o())?;
    let suspects: Vec<String> = suspects.iter().map(|&suspect| u8::from(suspect).to_string()).collect();
    let script: PathBuf = root::scripts().join("gnc.py");
    let output = Command::new(python)
        .arg(&script)
        .arg(&path)
        .args([suspects.concat(), THRESHOLD.to_string()])
        .output();
    fs::remove_file(&path)?;
    let output = output.map_err(|error| format!("{}: {error}", python.display()))?;
    if !output.status.success() {
        return Err(format!("{}: {}", script.display(), String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}
