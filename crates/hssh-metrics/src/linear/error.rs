//! What a factorization may find instead of a factor.

/// The matrix has, numerically, no Cholesky factor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct NotPositiveDefinite;
