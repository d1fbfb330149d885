//! The page in a browser: what `hssh map --html` writes, clicked through in headless Chromium.

use std::error::Error;

use xshell::{Shell, cmd};

use crate::root;

/// `cargo xtask page [FOLDER]`: runs scripts/page/check.py on the program as the tests build it. Screenshots go into the folder.
pub(crate) fn run(screenshots: Option<&str>) -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    cmd!(shell, "cargo test --quiet --workspace --test page --no-run").run()?;
    let program = root::built("hssh");
    Ok(cmd!(shell, "python3 scripts/page/check.py {program} {screenshots...}").run()?)
}
