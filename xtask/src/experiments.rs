//! Hands commands on to `hssh-experiments`, which is built only when one of them is asked for.

use std::error::Error;
use std::ffi::OsStr;
use std::process::{Command, ExitCode};

use crate::root;

/// Runs a command of `hssh-experiments` where the user is, and ends as it ended.
pub(crate) fn run(
    arguments: impl IntoIterator<Item = impl AsRef<OsStr>>,
) -> Result<ExitCode, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(["run", "--quiet", "--release", "--package", "hssh-experiments", "--manifest-path"])
        .arg(root::root().join("Cargo.toml"))
        .arg("--")
        .args(arguments)
        .status()?;
    let code = status.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}
