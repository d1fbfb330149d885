//! The command line of searches that are spread over processes.

use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct ProcessArguments {
    /// Search by so many processes of this machine, each with one thread; not best-first, and not with --readings.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=512), conflicts_with = "hosts", help_heading = "Processes")]
    pub(crate) workers: Option<u64>,
    /// Search by the processes whose addresses (host:port) are the lines of this file. On each the same command is started with its
    /// own --process; the first one answers.
    #[arg(long, value_name = "FILE", requires = "process", help_heading = "Processes")]
    pub(crate) hosts: Option<PathBuf>,
    /// With --hosts: which line of the file this process is, counted from 0.
    #[arg(long, value_name = "I", requires = "hosts", help_heading = "Processes")]
    pub(crate) process: Option<usize>,
}
