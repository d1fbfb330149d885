//! Measures how often a survey errs, on real logs and on simulated drives, and whether the probabilities of maps are what
//! they say.

mod chain;
mod count;
mod drives;
mod floors;
mod judge;
mod reliability;
mod tables;
mod variant;

use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::time::Instant;

use hssh_local::LaserLog;
use rayon::prelude::*;

use crate::{flags, log};
pub(crate) use chain::Outcome;
use drives::{Driven, Task};
use variant::Variant;

/// Drives if no number is given.
const DRIVES: usize = 500;
/// A wrong map with a greater probability is told one by one.
pub(crate) const CONFIDENT: f64 = 0.9;

/// A real log, changed or not.
struct RealRun {
    name: &'static str,
    variant: Variant,
    outcome: Outcome,
}

/// Prints the tables, or what became of one drive.
///
/// # Errors
/// If a log cannot be read, or the log of the one drive not be made or written.
pub(crate) fn run(flags: &flags::Calibrate) -> Result<(), Box<dyn Error>> {
    if let Some(number) = flags.drive {
        return one(number, flags.out.as_deref());
    }
    let started = Instant::now();
    let logs = on_logs(&flags.data)?;
    println!("{}", tables::of_logs(&logs));
    println!("real logs: {:.0} s\n", started.elapsed().as_secs_f64());
    let started = Instant::now();
    let tasks: Vec<Task> = (0..flags.drives.unwrap_or(DRIVES)).map(Task::new).collect();
    let drives = on_drives(tasks);
    println!("{}", tables::of_rates(&logs, &drives));
    println!("{}", tables::of_rates_without(&logs));
    println!("{}", tables::of_reliability(&drives));
    println!("{}", tables::of_floors(&drives));
    tell_wrong(&drives);
    println!("{} drives: {:.0} s", drives.len(), started.elapsed().as_secs_f64());
    Ok(())
}

/// Every log with every change.
fn on_logs(data: &Path) -> Result<Vec<RealRun>, Box<dyn Error>> {
    let mut logs = Vec::new();
    for name in log::LOGS {
        let path = log::file(data, name);
        if !path.is_file() {
            println!("{name}: skipped, there is no {}", path.display());
            continue;
        }
        let read = LaserLog::read(File::open(path)?)?;
        if read.scans.iter().all(|scan| scan.corrected == scan.odometry) {
            println!("{name}: skipped, nobody corrected its poses");
            continue;
        }
        logs.push((name, read));
    }
    let tasks: Vec<(&'static str, &LaserLog, Variant)> =
        logs.iter().flat_map(|(name, read)| Variant::ALL.map(|variant| (*name, read, variant))).collect();
    let run = |(name, read, variant): (&'static str, &LaserLog, Variant)| RealRun {
        name,
        variant,
        outcome: Outcome::of(variant.of(read)),
    };
    Ok(tasks.into_par_iter().map(run).collect())
}

/// Makes drives, and says on the way what became of each.
fn on_drives(tasks: Vec<Task>) -> Vec<Driven> {
    let run = |task: Task| {
        let driven = task.run();
        eprintln!("{}", account(&driven));
        driven
    };
    tasks.into_par_iter().map(run).collect()
}

/// Tells of confident wrong maps, and why drives have none.
fn tell_wrong(drives: &[Driven]) {
    println!(
        "wrong maps with a probability above {CONFIDENT}; `--drive N --out FILE` writes the log of one:"
    );
    for drive in drives {
        let confident = drive.outcome.map.filter(|map| map.stated > CONFIDENT && !map.verdict.is_right());
        if confident.is_some() {
            println!("  {}", account(drive));
        }
    }
    println!("drives without a map:");
    for drive in drives.iter().filter(|drive| drive.outcome.map.is_none()) {
        println!("  {}", account(drive));
    }
    println!();
}

/// What became of a drive, in a line.
fn account(Driven { task, outcome }: &Driven) -> String {
    let [returns, contradicted, unconfirmed, true_returns] =
        outcome.errors.kinds().map(|count| format!("{}/{}", count.wrong, count.all));
    let map = match (outcome.map, &outcome.problem) {
        (Some(map), _) => {
            let verdict = map.verdict;
            format!(
                "{} places, probability {:.4}, pairs merged {} (up to {:.1} m apart) and split {}",
                map.places, map.stated, verdict.merged, verdict.farthest, verdict.split
            )
        }
        (None, Some(problem)) => format!("no map: {problem}"),
        (None, None) => "no map".to_owned(),
    };
    format!(
        "{}: {} visits, {map}; wrong: returns {returns}, contradicted {contradicted}, unconfirmed {unconfirmed}, true \
         returns {true_returns}",
        task.describe(),
        outcome.visits
    )
}

/// Repeats one drive, and writes its log if asked to.
fn one(number: usize, out: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let task = Task::new(number);
    if let Some(out) = out {
        std::fs::write(out, task.drive()?.to_carmen())?;
    }
    println!("{}", account(&task.run()));
    Ok(())
}
