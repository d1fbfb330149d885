//! hssh, GTSAM and g2o on the same pose graphs, from the same poses, to the same accuracy.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use hssh_metrics::{GraphFile, Options, Solution, chordal_poses, solve};
use serde::Deserialize;

use crate::campus::campus;
use crate::flags;
use crate::pose_graphs::{PUBLIC, Timing, folder, read, time};
use crate::root;
use crate::table::aligned;

/// Everybody stops when χ² falls by less than this part of itself.
const TOLERANCE: f64 = 1e-6;

/// One line of what the script prints.
#[derive(Debug, Deserialize)]
struct Peer {
    peer: String,
    iterations: usize,
    best: f64,
    median: f64,
    chi2: f64,
}

/// `cargo xtask peers`.
pub(crate) fn run(flags: &flags::Peers) -> Result<(), Box<dyn Error>> {
    let runs = flags.runs.unwrap_or(9).max(1);
    let starts = std::env::temp_dir().join(format!("hssh-peers-{}", std::process::id()));
    fs::create_dir_all(&starts)?;
    let compared = compare(&starts, flags, runs);
    fs::remove_dir_all(&starts)?;
    println!(
        "Pose graphs from chordal poses until χ² falls by less than {TOLERANCE:.0e} of itself: times of one solve,"
    );
    println!(
        "without reading the file, of {runs} runs on one thread. The last columns are the peer's best time over"
    );
    println!(
        "hssh's: from the same poses, and with the chordal poses, which only hssh computes, in hssh's time.\n"
    );
    println!("{}", aligned(&compared?));
    Ok(())
}

fn compare(starts: &Path, flags: &flags::Peers, runs: usize) -> Result<Vec<Vec<String>>, Box<dyn Error>> {
    let heads = ["", "program", "iterations", "χ²", "best ms", "median ms", "× same start", "× from edges"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let graphs: Vec<(String, GraphFile)> = match flags.campus {
        Some(poses) => vec![(format!("campus-{poses}.g2o"), campus(poses))],
        None => {
            let folder = folder(flags.data.as_deref())?;
            let named = |(name, _): &(&str, _)| Ok(((*name).to_owned(), read(&folder, name)?));
            PUBLIC.iter().map(named).collect::<Result<_, Box<dyn Error>>>()?
        }
    };
    for (name, mut file) in graphs {
        let name = name.as_str();
        let chordal = time(runs, || chordal_poses(&file.graph));
        file.graph.set_poses(chordal_poses(&file.graph)?)?;
        let (ours, solved) = measure(&file, runs)?;
        rows.push(row(name, "hssh", solved.iterations, solved.chi2, ours, ["1.0".to_owned(), "".to_owned()]));
        let whole = Timing { best: ours.best + chordal.best, median: ours.median + chordal.median };
        rows.push(row(
            "",
            "hssh, from edges",
            solved.iterations,
            solved.chi2,
            whole,
            ["".to_owned(), "1.0".to_owned()],
        ));

        let start = starts.join(name).with_extension("g2o");
        fs::write(&start, file.to_g2o())?;
        for Peer { peer, iterations, best, median, chi2 } in peers(&start, flags, runs)? {
            let times = [best / ours.best, best / whole.best].map(|times| format!("{times:.1}"));
            rows.push(row("", &peer, iterations, chi2, Timing { best, median }, times));
        }
    }
    Ok(rows)
}

fn measure(file: &GraphFile, runs: usize) -> Result<(Timing, Solution), Box<dyn Error>> {
    let options = Options { tolerance: TOLERANCE, ..Options::default() };
    Ok((time(runs, || solve(&file.graph, &options)), solve(&file.graph, &options)?))
}

/// What the script measures of one file, with each of the interpreters.
fn peers(start: &Path, flags: &flags::Peers, runs: usize) -> Result<Vec<Peer>, Box<dyn Error>> {
    let default = [PathBuf::from("python3")];
    let interpreters = if flags.python.is_empty() { &default[..] } else { &flags.python[..] };
    let script = root::scripts().join("peers.py");
    let mut measured = Vec::new();
    for interpreter in interpreters {
        let output = Command::new(interpreter)
            .arg(&script)
            .arg(start)
            .args(["--runs", &runs.to_string(), "--tolerance", &TOLERANCE.to_string()])
            .env("OMP_NUM_THREADS", "1")
            .output()
            .map_err(|error| format!("{}: {error}", interpreter.display()))?;
        let complaints = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            return Err(format!("{} {}: {complaints}", interpreter.display(), script.display()).into());
        }
        eprint!("{complaints}");
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            measured.push(serde_json::from_str(line)?);
        }
    }
    Ok(measured)
}

fn row(
    name: &str,
    program: &str,
    iterations: usize,
    chi2: f64,
    timing: Timing,
    times: [String; 2],
) -> Vec<String> {
    let milliseconds = |seconds: f64| format!("{:.3}", 1e3 * seconds);
    let [same, edges] = times;
    vec![
        name.to_owned(),
        program.to_owned(),
        iterations.to_string(),
        format!("{chi2:.4}"),
        milliseconds(timing.best),
        milliseconds(timing.median),
        same,
        edges,
    ]
}
