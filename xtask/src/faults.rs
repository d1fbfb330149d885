//! The table of faulty inputs, with what the program says of each.

use std::error::Error;

use xshell::{Shell, cmd};

use crate::root;

/// `cargo xtask faults`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    let test = "faults::what_is_wrong_with_an_input_is_said_first";
    Ok(cmd!(shell, "cargo test --quiet --package hssh --test suite {test} -- --nocapture").run()?)
}
