//! Why a pose graph is not optimized.

use hssh_metrics::SolveError;

/// Why a pose graph is not optimized.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum GraphFailure {
    /// It has no solution.
    #[error("cannot solve the pose graph: {0}")]
    Solve(#[from] SolveError),
    /// Relaxation does not weigh edges.
    #[error("relaxation weighs all edges alike: choose another --method with --robust and --graduated")]
    WeighedRelaxation,
    /// It was to start from poses that are not there.
    #[error(
        "the file does not say where {unplaced} of its {poses} poses are, pose {first} being the first: --start chordal \
         and --start odometry need no poses"
    )]
    Unplaced {
        /// How many poses have no estimate.
        unplaced: usize,
        /// How many poses there are.
        poses: usize,
        /// The label of the first without one.
        first: u64,
    },
    /// Something could move without any measurement noticing.
    #[error(
        "the graph is not determined: the poses {poses} could move without any measurement noticing, for some \
         directions have an information of zero\nhelp: measure what is missing, or hold poses with FIX"
    )]
    Floating {
        /// The labels of the poses, the first few of them.
        poses: String,
    },
}
