//! Why a search that is spread over processes has no answer.

use hssh_search::MapperError;

/// Why a search that is spread over processes has no answer.
#[derive(Debug, thiserror::Error)]
pub enum ClusterError {
    /// The search cannot begin.
    #[error(transparent)]
    Search(#[from] MapperError),
    /// This process cannot be reached where it should be.
    #[error("cannot listen at {address}: {error}")]
    Listen {
        /// Where.
        address: String,
        /// Why not.
        error: std::io::Error,
    },
    /// The processes cannot talk with one another.
    #[error("cannot connect the processes: {0}")]
    Connect(String),
    /// Somebody interrupted it before all processes were there.
    #[error("interrupted before all processes were there")]
    Interrupted,
    /// A process died, or cannot be reached any more.
    #[error("another process of the search died, or cannot be reached any more")]
    Lost,
    /// A process searches something else.
    #[error(
        "process {0} was given another exploration, other options or another version of hssh than process 0"
    )]
    Foreign(usize),
}
