//! Everything that has to pass before a change is taken; `.ci/run` calls it.

use std::error::Error;
use std::ffi::OsStr;
use std::io;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::{self, JoinHandle};
use std::time::Instant;

use xshell::{Shell, cmd};

use crate::{page, python, root, tidy};

/// `cargo xtask ci`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    step("format", || Ok(cmd!(shell, "cargo fmt --all -- --check").run()?))?;
    step("tidy", tidy::run)?;
    step("lints", || Ok(cmd!(shell, "cargo clippy --workspace --all-targets -- -D warnings").run()?))?;
    step("lints without faer", || {
        // xtask for the features that it asks for: without them most of what the first lints compiled is compiled again.
        let lean = ["--package=hssh", "--package=hssh-metrics", "--package=xtask", "--no-default-features"];
        Ok(cmd!(shell, "cargo clippy {lean...} --all-targets -- -D warnings").run()?)
    })?;
    step("lints of the Python package", || python::lint(&shell))?;
    // The same random cases in every run: a change is refused for what it breaks, not for a case that was broken before.
    let tests = cmd!(shell, "cargo test --workspace").env("PROPTEST_RNG_SEED", "2005");
    step("tests", || Ok(tests.run()?))?;
    // As the tests have built it: a release takes longer to compile than all of these take to run.
    let run = root::built("hssh-experiments");
    // The logs keep one core busy, and so does what is done beside them.
    let logs =
        std::env::var_os("HSSH_DATA").map(|data| Beside::start("logs", &run, [OsStr::new("log"), &data]));
    let logs = logs.transpose()?;
    step("page", || page::run(None))?;
    step("examples", examples)?;
    match logs {
        Some(logs) => logs.finish()?,
        None => println!("== logs: skipped, for HSSH_DATA names no data folder\n"),
    }
    step("python", || python::test(&shell))?;
    step("documentation", || {
        Ok(cmd!(shell, "cargo doc --workspace --no-deps").env("RUSTDOCFLAGS", "-Dwarnings").run()?)
    })?;
    step("experiments", || Ok(cmd!(shell, "{run} experiment --all --check --threads 0").run()?))?;
    step("robot", || Ok(cmd!(shell, "{run} robot --check --threads 0").run()?))?;
    step("theory", || Ok(cmd!(shell, "{run} theory --small --optional --threads 0").run()?))?;
    println!("== everything passed");
    Ok(())
}

/// Runs every example of the crates that others depend on, as the tests have built it; each checks what it finds.
fn examples() -> Result<(), Box<dyn Error>> {
    const CRATES: [&str; 8] = [
        "hssh-topology",
        "hssh-causal",
        "hssh-metrics",
        "hssh-local",
        "hssh-io",
        "hssh-search",
        "hssh-verify",
        "hssh",
    ];
    let shell = Shell::new()?;
    for name in CRATES {
        let mut sources = shell.read_dir(root::root().join("crates").join(name).join("examples"))?;
        sources.sort();
        for source in sources {
            let example = Path::new("examples").join(source.file_stem().unwrap_or_default());
            let example = root::built(example);
            cmd!(shell, "{example}").quiet().ignore_stdout().run()?;
        }
    }
    Ok(())
}

/// `cargo xtask python`.
pub(crate) fn python() -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    step("lints of the Python package", || python::lint(&shell))?;
    step("python", || python::test(&shell))
}

/// Runs one step under its name, and says how long it took.
fn step(name: &str, work: impl FnOnce() -> Result<(), Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
    println!("== {name}");
    let started = Instant::now();
    work().map_err(|error| format!("{name}: {error}"))?;
    println!("== {name}: {:.0} s\n", started.elapsed().as_secs_f64());
    Ok(())
}

/// A program that runs beside other steps. What it prints is shown when it is waited for.
struct Beside {
    name: &'static str,
    started: Instant,
    ran: JoinHandle<io::Result<Output>>,
}

impl Beside {
    fn start<'a>(
        name: &'static str,
        program: &Path,
        arguments: impl IntoIterator<Item = &'a OsStr>,
    ) -> io::Result<Self> {
        let child = Command::new(program).args(arguments).stdout(Stdio::piped()).spawn()?;
        Ok(Beside { name, started: Instant::now(), ran: thread::spawn(|| child.wait_with_output()) })
    }

    fn finish(self) -> Result<(), Box<dyn Error>> {
        let Beside { name, started, ran } = self;
        println!("== {name}");
        let Output { status, stdout, .. } =
            ran.join().map_err(|_| format!("{name}: nobody waited for it"))??;
        print!("{}", String::from_utf8_lossy(&stdout));
        if !status.success() {
            return Err(format!("{name}: {status}").into());
        }
        println!("== {name}: {:.0} s, beside others\n", started.elapsed().as_secs_f64());
        Ok(())
    }
}
