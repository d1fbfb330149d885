//! Surveys and maps real laser logs, compares what comes out with what is known of the buildings, and refuses what is
//! worse than it should be.

mod drift;
mod figures;
mod table;

use std::error::Error;
use std::path::{Path, PathBuf};

use hssh_local::{MatchOptions, track};
use hssh_metrics::Pose;

use crate::score::Relations;
use figures::{Figures, Mapping};

/// The logs.
pub(crate) const LOGS: [&str; 6] = ["aces", "intel", "freiburg-079", "belgioioso", "freiburg-101", "fhw"];
/// Those with relations that were verified by hand, and the names of these.
const VERIFIED: [(&str, &str); 2] = [("intel", "intel"), ("freiburg-079", "fr079")];

/// A log under its file.
pub(crate) fn file(data: &Path, name: &str) -> PathBuf {
    data.join(format!("logs/{name}.log.gz"))
}

/// Prints what comes out of each log in the folder that contains `logs/` and `relations/`.
///
/// # Errors
/// If a file cannot be read, or something is worse than it should be.
pub(crate) fn run(data: &Path) -> Result<(), Box<dyn Error>> {
    let (mut all, mut verified, mut drifts) = (Vec::new(), Vec::new(), Vec::new());
    for name in LOGS {
        let path = file(data, name);
        if !path.is_file() {
            println!("{name}: skipped, there is no {}", path.display());
            continue;
        }
        let mapping = Mapping::of(&path).map_err(|error| format!("{name}: {error}"))?;
        let tracked = track(mapping.log(), &MatchOptions::default(), |_| ());
        let track: Vec<Pose> = tracked.scans.iter().map(|scan| scan.pose).collect();
        all.push(Figures::of(name, &mapping, &track));
        drifts.extend(drift::rows(name, mapping.log(), &tracked));
        verified.extend(relations(data, name, &mapping, &track)?);
    }
    println!("{}", table::of_logs(&all));
    println!("{}", table::of_relations(&verified));
    println!("{}", table::of_drift(&drifts));
    let faults: Vec<String> = all.iter().flat_map(Figures::faults).collect();
    if faults.is_empty() { Ok(()) } else { Err(faults.join("; ").into()) }
}

/// How far the trajectories of a log are from relations that were verified by hand.
struct Verified {
    name: &'static str,
    relations: usize,
    /// Of raw odometry, the track and the closed track: metres and radians; the last is not there without a survey.
    errors: [Option<[f64; 2]>; 3],
}

fn relations(
    data: &Path,
    name: &'static str,
    mapping: &Mapping,
    track: &[Pose],
) -> Result<Option<Verified>, Box<dyn Error>> {
    let known = VERIFIED.iter().find(|(log, _)| *log == name);
    let file_of = |known: &(&str, &str)| data.join(format!("relations/{}.odom.relations", known.1));
    let Some(path) = known.map(file_of).filter(|path| path.is_file()) else { return Ok(None) };
    let relations = Relations::read(&path, &file(data, name), mapping.log())?;
    let closed = mapping.closed();
    let trajectories = [Some(mapping.raw()), Some(track.to_vec()), closed];
    let errors = trajectories.map(|poses| poses.map(|poses| relations.errors(&poses)));
    Ok(Some(Verified { name, relations: relations.len(), errors }))
}
