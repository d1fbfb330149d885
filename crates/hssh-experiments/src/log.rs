//! Surveys and maps real laser logs, compares what comes out with what is known of the buildings, and refuses what is
//! worse than it should be.

mod building;
mod by_hand;
mod drift;
mod figures;
mod mrpt;
mod table;
mod tours;

use std::error::Error;
use std::path::{Path, PathBuf};

use hssh_local::{LaserLog, MatchOptions, track_calibrated};
use hssh_metrics::Pose;

use crate::bench::usage::Usage;
use crate::flags;
use crate::score::{Relations, Revisits, root_mean_square};
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
pub(crate) fn run(flags: &flags::Log) -> Result<(), Box<dyn Error>> {
    let data = flags.data.as_path();
    let with_mrpt = flags.mrpt && mrpt::is_installed();
    if flags.mrpt && !with_mrpt {
        println!("MRPT (icp-slam, rbpf-slam, carmen2rawlog; Debian: mrpt-apps) or python3 is not installed");
    }
    let (mut all, mut compared, mut drifts) = (Vec::new(), Vec::new(), Vec::new());
    let (mut buildings, mut found_by_hand) = (Vec::new(), Vec::new());
    for name in LOGS {
        let path = file(data, name);
        if !path.is_file() {
            println!("{name}: skipped, there is no {}", path.display());
            continue;
        }
        let mapping = Mapping::of(&path).map_err(|error| format!("{name}: {error}"))?;
        let started = Usage::now()?.user_seconds;
        let (_, tracked) = track_calibrated(mapping.log().clone(), &MatchOptions::default(), |_| ());
        let tracking = Usage::now()?.user_seconds - started;
        let track: Vec<Pose> = tracked.scans.iter().map(|scan| scan.pose).collect();
        all.push(Figures::of(name, &mapping, &track));
        buildings.extend(mapping.answer().and_then(|answer| building::Building::of(name, answer)));
        if let Some(answer) = mapping.answer() {
            found_by_hand.extend(by_hand::ByHand::of(name, answer)?);
        }
        drifts.extend(drift::rows(name, mapping.log(), &tracked));
        let known = relations(data, name, &mapping)?;
        let truth: Vec<Pose> = mapping.log().scans.iter().map(|scan| scan.corrected).collect();
        let mut compare = |by: &str, poses: Option<Vec<Pose>>, cost: Option<[f64; 2]>| {
            compared.push(Compared::new(name, by, mapping.log(), &truth, poses, known.as_ref(), cost));
        };
        compare("raw odometry", Some(mapping.raw()), None);
        compare("track", Some(track), Some([tracking, 0.0]));
        compare("hssh", mapping.closed(), Some([mapping.seconds(), mapping.megabytes()]));
        compare("reference", Some(truth.clone()), None);
        if with_mrpt {
            for ran in mrpt::run(name, mapping.log())? {
                if let Some(problem) = &ran.problem {
                    println!("{name}: {}: {problem}", ran.peer);
                }
                compare(&ran.peer, ran.poses(), Some([ran.seconds, ran.megabytes]));
            }
        }
    }
    println!("{}", table::of_logs(&all));
    println!("{}", table::of_compared(&compared));
    println!("{}", table::of_drift(&drifts));
    println!("{}", building::table(&buildings));
    println!("{}", by_hand::table(&found_by_hand));
    let plans = data.join("gridmap/rooms");
    match plans.is_dir() {
        true => println!("{}", tours::report(&plans)?),
        false => println!("no tours of floor plans: there is no {}", plans.display()),
    }
    let faults: Vec<String> = all.iter().flat_map(Figures::faults).collect();
    if faults.is_empty() { Ok(()) } else { Err(faults.join("; ").into()) }
}

/// A trajectory of a log beside others.
struct Compared {
    log: &'static str,
    by: String,
    /// Root mean square distance from the corrected poses, metres.
    off: Option<f64>,
    /// Mean error of the relative positions of scans that are back, metres.
    close: Option<f64>,
    /// How far hits at revisits lie from one another's, metres.
    blur: Option<f64>,
    /// Mean error against relations that were verified by hand: metres and radians.
    relations: Option<[f64; 2]>,
    /// Seconds of processor time, and peak memory in MB; 0 where it is not measured.
    cost: Option<[f64; 2]>,
}

impl Compared {
    fn new(
        log: &'static str,
        by: &str,
        logged: &LaserLog,
        truth: &[Pose],
        poses: Option<Vec<Pose>>,
        relations: Option<&Relations>,
        cost: Option<[f64; 2]>,
    ) -> Self {
        let (poses, revisits) = (poses.as_deref(), Revisits::new(truth));
        Compared {
            log,
            by: by.to_owned(),
            off: poses.map(|poses| root_mean_square(poses, truth)),
            close: poses.and_then(|poses| revisits.close_error(poses)).map(|error| error[0]),
            blur: poses.and_then(|poses| revisits.blur(logged, poses)),
            relations: relations.zip(poses).map(|(relations, poses)| relations.errors(poses)),
            cost,
        }
    }
}

/// The relations of a log, if there are any.
fn relations(data: &Path, name: &str, mapping: &Mapping) -> Result<Option<Relations>, Box<dyn Error>> {
    let known = VERIFIED.iter().find(|(log, _)| *log == name);
    let file_of = |known: &(&str, &str)| data.join(format!("relations/{}.odom.relations", known.1));
    let Some(path) = known.map(file_of).filter(|path| path.is_file()) else { return Ok(None) };
    Ok(Some(Relations::read(&path, &file(data, name), mapping.log())?))
}
