//! The checks of this repository; every other command goes on to `hssh-experiments`.
#![allow(clippy::print_stdout, clippy::print_stderr)] // a program reports on the terminal

mod ci;
mod experiments;
mod faults;
mod layers;
mod page;
mod python;
mod reported;
mod root;
mod tidy;

use std::env;
use std::error::Error;
use std::ffi::OsString;
use std::process::ExitCode;

const HELP: &str = "Checks:
    tidy    Checks what lints cannot: module sentences, file lengths, words, layers.
    faults  Runs the program over faulty inputs and prints what it says of each; with a folder of reported faults, over those.
    page    Clicks through the pages of `hssh map --html` in headless Chromium; with a folder, screenshots go there.
    python  Installs the Python package and runs its tests.
    ci      Everything that has to pass before a change is taken.

Experiments, benchmarks and measurements:
";

fn main() -> ExitCode {
    let arguments: Vec<OsString> = env::args_os().skip(1).collect();
    match run(&arguments) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[OsString]) -> Result<ExitCode, Box<dyn Error>> {
    let words: Vec<&str> = arguments.iter().map(|word| word.to_str().unwrap_or_default()).collect();
    match words[..] {
        ["tidy"] => tidy::run()?,
        ["ci"] => ci::run()?,
        ["python"] => ci::python()?,
        ["faults"] => faults::run()?,
        ["faults", folder] => reported::run(folder)?,
        ["page"] => page::run(None)?,
        ["page", folder] => page::run(Some(folder))?,
        ["tidy" | "ci" | "python", unexpected, ..] | ["page" | "faults", _, unexpected, ..] => {
            return Err(format!("unexpected argument `{unexpected}`").into());
        }
        [] | ["help" | "-h" | "--help"] => {
            print!("{HELP}");
            return experiments::run(["--help"]);
        }
        _ => return experiments::run(arguments),
    }
    Ok(ExitCode::SUCCESS)
}
