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

/// An answer in JSON without the time that it took.
#[cfg(unix)]
pub(crate) fn untimed(stdout: &[u8]) -> serde_json::Value {
    let mut answer: serde_json::Value = serde_json::from_slice(stdout).unwrap();
    answer["search"]["seconds"] = serde_json::Value::Null;
    answer
}

/// Writes the walk of a robot through all places of a square grid, row by row, into a test's folder.
#[cfg(unix)]
pub(crate) fn snake_walk(folder: &str, name: &str, side: u32, measured: bool) -> PathBuf {
    let world = hssh::world::grid(side, side, 8.0).unwrap();
    let route = world.route_through(&hssh::world::snake(side, side)).unwrap();
    let walk = match measured {
        true => world.explore_with_odometry(&route, &hssh::world::DriftModel::default(), 3).unwrap(),
        false => world.explore(&route).unwrap(),
    };
    let file = scratch(folder).join(name);
    std::fs::write(&file, walk.to_ron()).unwrap();
    file
}
