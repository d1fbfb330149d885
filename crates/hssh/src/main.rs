//! The `hssh` program: explorations in, ranked maps and pictures out.
//!
//! Exit codes: 0 something was found, 1 nothing is consistent, 2 the input is bad, 3 a limit or an
//! interruption stopped the search.

mod arguments;
mod command;
mod failure;
mod input;
mod live;
mod output;
mod progress;
mod terminal;

use std::process::ExitCode;

use arguments::{Arguments, Command};
use clap::Parser;
use tracing_subscriber::filter::LevelFilter;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let level = std::env::var("HSSH_LOG").ok().map(|level| level.parse::<LevelFilter>());
    let most = level.clone().and_then(Result::ok).unwrap_or(LevelFilter::WARN);
    tracing_subscriber::fmt().with_max_level(most).with_writer(std::io::stderr).init();
    if let Some(Err(error)) = level {
        tracing::warn!("HSSH_LOG is no level: {error}");
    }
    let done = match arguments.command {
        Command::Map(options) => command::map::run(&options),
        Command::Live(options) => command::live::run(&options),
        Command::Check(options) => command::check::run(&options),
        Command::Explain(options) => command::explain::run(&options),
        Command::Graph(options) => command::graph::run(&options),
        Command::Stars(options) => command::stars::run(&options),
        Command::Export(options) => command::export::run(&options),
        Command::Track(options) => command::track::run(&options),
        Command::Explore(options) => command::explore::run(&options),
        Command::Simulate(options) => command::simulate::run(&options),
        Command::Verify(options) => command::verify::run(&options),
        Command::Options(options) => command::print_options(&options),
        Command::Completions(options) => command::shell::print_completions(&options),
        Command::Man(options) => command::shell::print_man(&options),
    };
    match done {
        Ok(status) => status.into(),
        Err(failure) => {
            failure.print();
            failure.exit_code()
        }
    }
}
