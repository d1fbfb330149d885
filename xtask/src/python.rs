//! The Python package: its Rust part is linted like everything else, then it is installed as people do and tested.

use std::env;
use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use xshell::{Cmd, Shell, cmd};

use crate::root;

/// What the tests need beside the package.
const NEEDED: [&str; 5] = ["maturin>=1.9.4,<2", "numpy", "pytest", "scipy", "networkx"];

/// Format and lints of the bindings, with what the lints of the other crates have compiled.
pub(crate) fn lint(shell: &Shell) -> Result<(), Box<dyn Error>> {
    let manifest = ["--manifest-path", "python/Cargo.toml"];
    cmd!(shell, "cargo fmt {manifest...} -- --check").run()?;
    cmd!(shell, "cargo clippy {manifest...} --locked -- -D warnings")
        .env("CARGO_TARGET_DIR", root::root().join("target"))
        .run()?;
    Ok(())
}

/// Installs the package into an environment of its own and runs its tests; where there is no Python to do so with, it says that.
pub(crate) fn test(shell: &Shell) -> Result<(), Box<dyn Error>> {
    let environment = root::root().join("target").join("python-environment");
    if let Some(missing) = prepare(shell, &environment) {
        println!("python: skipped, for {missing}");
        return Ok(());
    }
    let python = interpreter(&environment);
    // With what the other tests have compiled of the crates of others, which takes a fraction of the time of a release.
    let profile = "--config-settings=build-args=--profile dev";
    let install = ["--quiet", "--no-build-isolation", "--no-deps", "--force-reinstall", profile, "./python"];
    cmd!(shell, "{python} -m pip install {install...}")
        .env("CARGO_TARGET_DIR", root::root().join("target"))
        .env("PATH", with_programs_of(&python)?)
        .run()?;
    cmd!(shell, "{python} -m pytest --quiet python").run()?;
    Ok(())
}

/// Makes the environment; what is missing for it, if anything is.
fn prepare(shell: &Shell, environment: &Path) -> Option<&'static str> {
    let can = |command: Cmd<'_>| command.quiet().ignore_stdout().ignore_stderr().run().is_ok();
    let is_old = "import sys; sys.exit(sys.version_info < (3, 10))";
    if !can(cmd!(shell, "python3 -c {is_old}")) {
        return Some("there is no python3 of version 3.10 or newer");
    }
    let python = interpreter(environment);
    if !can(cmd!(shell, "{python} -m pip --version")) && !can(cmd!(shell, "python3 -m venv {environment}")) {
        return Some("python3 cannot make an environment: its module venv, or pip, is missing");
    }
    let wanted = NEEDED;
    if !can(cmd!(shell, "{python} -m pip install --quiet {wanted...}")) {
        return Some("pip cannot install maturin, numpy, pytest, scipy and networkx");
    }
    None
}

/// Where programs are looked for: first beside an interpreter, where maturin is.
fn with_programs_of(python: &Path) -> Result<OsString, Box<dyn Error>> {
    let usual = env::var_os("PATH").unwrap_or_default();
    let own = python.parent().map(Path::to_owned);
    Ok(env::join_paths(own.into_iter().chain(env::split_paths(&usual)))?)
}

/// The interpreter of an environment.
fn interpreter(environment: &Path) -> PathBuf {
    let folder = if cfg!(windows) { "Scripts" } else { "bin" };
    environment.join(folder).join("python")
}
