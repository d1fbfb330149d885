//! Why a search cannot go on from a checkpoint.

use std::io;

/// Why a search cannot go on from a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Read(#[from] io::Error),
    /// It is something else.
    #[error("it is no checkpoint of hssh")]
    Foreign,
    /// It was written by another version.
    #[error("it was written by hssh {there}, and this is hssh {here}")]
    Version {
        /// The version that wrote it.
        there: String,
        /// This one.
        here: String,
    },
    /// It breaks off, or something of it was changed.
    #[error("it is damaged: it breaks off, or something of it was changed since it was written")]
    Damaged,
    /// It is of a search through the maps of something else.
    #[error("it is of another exploration, or of another number of its travels")]
    Exploration,
    /// It is of another search.
    #[error("it is of another search: {there}, where this one is {here}")]
    Search {
        /// How the tree was searched, and for what.
        there: String,
        /// What is asked for now.
        here: String,
    },
    /// It is of the same search with other options.
    #[error(
        "it is of a search with other options: axioms, prices, what is to be proved, or what is known of visits"
    )]
    Options,
}
