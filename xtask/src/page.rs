//! The page in a browser: what `hssh map --html` writes, clicked through in headless Chromium.

use std::error::Error;

use xshell::{Shell, cmd};

use crate::root;

/// `cargo xtask page [FOLDER]`: runs scripts/page/check.py on the program as the tests build it. Screenshots go into the folder.
pub(crate) fn run(screenshots: Option<&str>) -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    shell.change_dir(root::root());
    cmd!(shell, "cargo test --quiet --workspace --test page --no-run").run()?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root::root().join("target"), Into::into);
    let program = target.join("debug").join(format!("hssh{}", std::env::consts::EXE_SUFFIX));
    Ok(cmd!(shell, "python3 scripts/page/check.py {program} {screenshots...}").run()?)
}
