//! Everything that has to pass before a change is taken; `.ci/run` calls it.

use std::error::Error;
use std::time::Instant;

use xshell::{Shell, cmd};

use crate::{experiment, flags, robot, root, tidy};

/// `cargo xtask ci`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    step("format", || Ok(cmd!(shell, "cargo fmt --all -- --check").run()?))?;
    step("tidy", tidy::run)?;
    step("lints", || Ok(cmd!(shell, "cargo clippy --workspace --all-targets -- -D warnings").run()?))?;
    step("tests", || Ok(cmd!(shell, "cargo test --workspace").run()?))?;
    step("documentation", || {
        Ok(cmd!(shell, "cargo doc --workspace --no-deps").env("RUSTDOCFLAGS", "-Dwarnings").run()?)
    })?;
    step("experiments", experiments)?;
    step("robot", || robot::run(&flags::Robot { data: None, seeds: None, threads: Some(0), check: true }))?;
    println!("== everything passed");
    Ok(())
}

/// All experiments but the slow ones, on all cores.
fn experiments() -> Result<(), Box<dyn Error>> {
    experiment::run(&flags::Experiment {
        name: None,
        all: true,
        slow: false,
        check: true,
        json: false,
        threads: Some(0),
        data: None,
        seeds: None,
        seconds: None,
        svg: None,
    })
}

/// Runs one step under its name, and says how long it took.
fn step(name: &str, work: impl FnOnce() -> Result<(), Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
    println!("== {name}");
    let started = Instant::now();
    work().map_err(|error| format!("{name}: {error}"))?;
    println!("== {name}: {:.0} s\n", started.elapsed().as_secs_f64());
    Ok(())
}
