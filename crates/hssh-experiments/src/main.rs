//! Scripted experiments, benchmarks and measurements: what `cargo xtask` runs but for the checks.
#![allow(clippy::print_stdout, clippy::print_stderr)] // a program reports on the terminal

mod aces;
mod bench;
mod branching;
mod calibrate;
mod campus;
mod causal;
mod experiment;
#[allow(unreachable_pub)] // generated
mod flags;
mod grids;
mod log;
mod noisy;
mod peers;
mod pose_graphs;
mod readings;
mod robot;
mod root;
mod score;
mod table;
mod theory;
mod trials;
mod wrong_closures;

use std::error::Error;
use std::process::ExitCode;

use flags::{Experiments, ExperimentsCmd};

fn main() -> ExitCode {
    match run(Experiments::from_env_or_exit().subcommand) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: ExperimentsCmd) -> Result<(), Box<dyn Error>> {
    match command {
        ExperimentsCmd::Experiment(flags) => experiment::run(&flags),
        ExperimentsCmd::Branching(flags) => branching::run(&flags),
        ExperimentsCmd::Causal(flags) => causal::run(&flags),
        ExperimentsCmd::Bench(flags) => bench::run(&flags),
        ExperimentsCmd::Peers(flags) => peers::run(&flags),
        ExperimentsCmd::WrongClosures(flags) => wrong_closures::run(&flags),
        ExperimentsCmd::Measure(flags) => bench::measure(&flags),
        ExperimentsCmd::Aces(flags) => {
            let out = flags.out.unwrap_or_else(|| root::fixtures().join("aces.ron"));
            println!("{}", aces::make(&flags.data, &out)?);
            Ok(())
        }
        ExperimentsCmd::Grids(flags) => grids::run(&flags),
        ExperimentsCmd::Log(flags) => log::run(&flags),
        ExperimentsCmd::Calibrate(flags) => calibrate::run(&flags),
        ExperimentsCmd::Readings(flags) => readings::run(&flags),
        ExperimentsCmd::Trials(flags) => trials::run(&flags),
        ExperimentsCmd::Robot(flags) => robot::run(&flags),
        ExperimentsCmd::Theory(flags) => theory::run(&flags),
    }
}
