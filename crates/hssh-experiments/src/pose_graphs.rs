//! The public pose graphs: where they are, what their best known optima are, and how solves are timed.

use std::error::Error;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use hssh_metrics::{GraphFile, read_pose_graph};

use crate::bench::median;

/// File and χ² at the best known optimum; none is published for the TORO file.
pub(crate) const PUBLIC: [(&str, Option<f64>); 8] = [
    ("MIT.g2o", Some(41.163269)),
    ("CSAIL.g2o", Some(40.555129)),
    ("CSAIL_P_toro.graph", None),
    ("intel.g2o", Some(45.004696)),
    ("manhattan.g2o", Some(3549.0368)),
    ("input_M3500b_g2o.g2o", Some(2054.7159)),
    ("ring.g2o", Some(11.163101)),
    ("noisyToyGraph.txt", Some(0.13665202)),
];

/// The folder with the graphs: below the one given, or below HSSH_DATA.
pub(crate) fn folder(data: Option<&Path>) -> Result<PathBuf, Box<dyn Error>> {
    let data = data.map(Path::to_owned).or_else(|| std::env::var_os("HSSH_DATA").map(PathBuf::from));
    let folder =
        data.ok_or("give the folder that contains `posegraph/`, or set HSSH_DATA")?.join("posegraph");
    if folder.is_dir() { Ok(folder) } else { Err(format!("there is no folder {}", folder.display()).into()) }
}

/// A graph with an anchor for each component.
pub(crate) fn read(folder: &Path, name: &str) -> Result<GraphFile, Box<dyn Error>> {
    let path = folder.join(name);
    let located = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let reader = BufReader::new(File::open(&path).map_err(|error| located(&error))?);
    let mut file = read_pose_graph(reader).map_err(|error| located(&error))?;
    file.graph.anchor_components();
    Ok(file)
}

/// Seconds of one call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    pub(crate) best: f64,
    pub(crate) median: f64,
}

/// The least time of which the clock is a fair measure.
const SHORTEST: Duration = Duration::from_millis(2);

/// Times a call, after one that does not count; short ones are repeated within each run.
pub(crate) fn time<T>(runs: usize, mut call: impl FnMut() -> T) -> Timing {
    let started = Instant::now();
    std::hint::black_box(call());
    let once = started.elapsed().max(Duration::from_nanos(1));
    let repetitions = SHORTEST.as_nanos().div_ceil(once.as_nanos()).max(1) as u32;
    let mut seconds = Vec::new();
    for _ in 0..runs.max(1) {
        let started = Instant::now();
        for _ in 0..repetitions {
            std::hint::black_box(call());
        }
        seconds.push(started.elapsed().as_secs_f64() / f64::from(repetitions));
    }
    Timing { best: seconds.iter().copied().fold(f64::INFINITY, f64::min), median: median(seconds) }
}
