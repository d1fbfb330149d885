//! Where the repository is.

use std::path::{Path, PathBuf};

/// The repository's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a folder of the repository")
}

/// The folder of explorations and experiments.
pub(crate) fn fixtures() -> PathBuf {
    root().join("fixtures")
}
