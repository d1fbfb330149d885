//! Scripted experiments, benchmarks and checks.

mod aces;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["aces", data] => match aces::make(Path::new(data), Path::new("fixtures/aces.ron")) {
            Ok(table) => {
                #[allow(clippy::print_stdout)] // a program reports on the terminal
                {
                    println!("{table}");
                }
                ExitCode::SUCCESS
            }
            Err(error) => {
                #[allow(clippy::print_stderr)] // a program reports on the terminal
                {
                    eprintln!("error: {error}");
                }
                ExitCode::FAILURE
            }
        },
        _ => ExitCode::FAILURE,
    }
}
