//! The command line of pages.

use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct PageArguments {
    /// Write a page to look at in a browser (see docs/report.md): one file that works without a network.
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
}
