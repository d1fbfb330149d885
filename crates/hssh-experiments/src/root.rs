//! Where the repository is.

use std::path::{Path, PathBuf};

/// The repository's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("crates is a folder of the repository")
}

/// The folder of explorations and experiments.
pub(crate) fn fixtures() -> PathBuf {
    root().join("fixtures")
}

/// The folder of scripts that other programs run.
pub(crate) fn scripts() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts")
}
