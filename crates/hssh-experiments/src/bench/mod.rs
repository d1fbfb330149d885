//! Timings of whole processes and of the structures that carry the search.

mod certificates;
mod closures;
mod faces;
mod graphs;
mod kills;
mod long;
mod memory;
mod online;
mod processes;
mod proof;
mod size;
pub(crate) mod speed;
mod streets;
pub(crate) mod usage;
mod walked;
mod wrong_closures;

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use crate::flags;

/// `cargo xtask bench`.
pub(crate) fn run(flags: &flags::Bench) -> Result<(), Box<dyn Error>> {
    let runs = flags.runs.unwrap_or(5).max(1);
    let limit = Duration::from_secs(flags.seconds.unwrap_or(60));
    let data = std::env::var_os("HSSH_DATA").map(PathBuf::from);
    match flags.name.as_deref() {
        Some("speed") => speed::run(runs),
        Some("faces") => {
            faces::run(runs)?;
            walked::run(data.as_deref(), runs)
        }
        Some("proof") => proof::run(limit),
        Some("graphs") => graphs::run(flags.data.as_deref(), runs),
        Some("closures") => closures::run(runs),
        Some("wrong-closures") => wrong_closures::run(),
        Some("certificates") => certificates::run(),
        Some("kills") => kills::run(),
        Some("memory") => memory::run(),
        Some("processes") => processes::run(),
        Some("size") => size::run(),
        Some("streets") => streets::run(data.as_deref(), limit, flags.svg.as_deref()),
        Some("long") => long::run(limit),
        Some("online") => online::run(flags.data.as_deref().or(data.as_deref())),
        None => {
            speed::run(runs)?;
            faces::run(runs)?;
            proof::run(limit)
        }
        Some(other) => {
            let names = "speed, faces, proof, graphs, closures, wrong-closures, online, certificates, long, kills, memory, processes, size, streets";
            Err(format!("there is no benchmark `{other}`; there are: {names}").into())
        }
    }
}

/// `cargo xtask measure`: what a benchmark starts as a process of its own.
pub(crate) fn measure(flags: &flags::Measure) -> Result<(), Box<dyn Error>> {
    let data = std::env::var_os("HSSH_DATA").map(PathBuf::from);
    match flags.name.split('/').next() {
        Some("long") => long::measure(flags),
        Some("streets") => streets::measure(flags, data.as_deref()),
        _ => speed::measure(flags),
    }
}

/// The program `hssh`, which stands beside this one.
fn program() -> Result<PathBuf, Box<dyn Error>> {
    let program = std::env::current_exe()?.with_file_name("hssh");
    match program.is_file() {
        true => Ok(program),
        false => Err(format!("there is no {}: run `cargo build --release` first", program.display()).into()),
    }
}

/// The middle value, the lower one of two; 0 of nothing.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get((values.len().max(1) - 1) / 2).copied().unwrap_or(0.0)
}
