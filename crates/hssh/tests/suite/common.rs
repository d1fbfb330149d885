//! How the tests start the program, and where they read and write.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The root of the repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A folder for what a test writes.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The program in the root of the repository, as if nobody had set anything.
fn program(arguments: &[&str]) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
    program.current_dir(root()).args(arguments).env_remove("HSSH_LOG");
    program
}

/// Runs the program.
pub(crate) fn hssh(arguments: &[&str]) -> Output {
    program(arguments).output().unwrap()
}

/// Runs the program with a file of the repository as its standard input.
pub(crate) fn hssh_reading(file: &str, arguments: &[&str]) -> Output {
    let file = std::fs::File::open(root().join(file)).unwrap();
    program(arguments).stdin(Stdio::from(file)).output().unwrap()
}

/// What the program printed.
pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The command, standard output, standard error and the exit code, to be read side by side in a snapshot.
pub(crate) fn session(arguments: &[&str]) -> String {
    let output = hssh(arguments);
    format!(
        "$ hssh {}\n{}{}exit {}\n",
        arguments.join(" "),
        text(&output.stdout),
        text(&output.stderr),
        output.status.code().unwrap()
    )
}
