//! Scripted experiments, benchmarks and checks.
#![allow(clippy::print_stdout, clippy::print_stderr)] // a program reports on the terminal

mod aces;
mod bench;
mod branching;
mod causal;
mod ci;
mod experiment;
#[allow(unreachable_pub)] // generated
mod flags;
mod grids;
mod layers;
mod log;
mod noisy;
mod peers;
mod pose_graphs;
mod robot;
mod root;
mod table;
mod tidy;

use std::error::Error;
use std::process::ExitCode;

use flags::{Xtask, XtaskCmd};

fn main() -> ExitCode {
    match run(Xtask::from_env_or_exit().subcommand) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: XtaskCmd) -> Result<(), Box<dyn Error>> {
    match command {
        XtaskCmd::Experiment(flags) => experiment::run(&flags),
        XtaskCmd::Branching(flags) => branching::run(&flags),
        XtaskCmd::Causal(flags) => causal::run(&flags),
        XtaskCmd::Bench(flags) => bench::run(&flags),
        XtaskCmd::Peers(flags) => peers::run(&flags),
        XtaskCmd::Measure(flags) => bench::speed::measure(&flags),
        XtaskCmd::Aces(flags) => {
            let out = flags.out.unwrap_or_else(|| root::fixtures().join("aces.ron"));
            println!("{}", aces::make(&flags.data, &out)?);
            Ok(())
        }
        XtaskCmd::Grids(flags) => grids::run(&flags),
        XtaskCmd::Log(flags) => log::run(&flags.data),
        XtaskCmd::Robot(flags) => robot::run(&flags),
        XtaskCmd::Tidy(_) => tidy::run(),
        XtaskCmd::Ci(_) => ci::run(),
    }
}
