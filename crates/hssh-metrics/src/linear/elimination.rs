//! How a pattern is eliminated: block by block, or in supernodes where faer is there to do it.

use std::sync::Arc;

use nalgebra::SMatrix;
use sprs::CsMat;

use super::error::NotPositiveDefinite;
use super::simplicial::{self, SimplicialFactor};
#[cfg(feature = "faer")]
use super::supernodal::{self, SupernodalFactor};

/// From so much work per block of the factor on, dense supernodes are faster than single blocks. Pose graphs have less
/// than a third of it.
#[cfg(feature = "faer")]
const SUPERNODAL_WORK: f64 = 60.0;

/// How the pattern is eliminated.
pub(crate) enum Elimination {
    Simplicial(Arc<simplicial::Symbolic>),
    #[cfg(feature = "faer")]
    Supernodal(Arc<supernodal::Symbolic>),
}

/// The numbers of the factor, as the elimination arranges them.
pub(crate) enum Values<const D: usize> {
    Simplicial(SimplicialFactor<D>),
    #[cfg(feature = "faer")]
    Supernodal(SupernodalFactor),
}

impl Elimination {
    /// What is fastest for the upper triangle of a pattern of `d`×`d` blocks, in elimination order.
    #[cfg(feature = "faer")]
    pub(crate) fn new(pattern: &CsMat<u32>, d: usize) -> Self {
        let symbolic = simplicial::Symbolic::new(pattern);
        if symbolic.work_per_block() < SUPERNODAL_WORK {
            Elimination::Simplicial(Arc::new(symbolic))
        } else {
            Self::supernodal(pattern, d)
        }
    }

    /// Block by block, whatever the pattern is.
    #[cfg(not(feature = "faer"))]
    pub(crate) fn new(pattern: &CsMat<u32>, _d: usize) -> Self {
        Self::simplicial(pattern)
    }

    #[cfg(any(test, not(feature = "faer")))]
    pub(crate) fn simplicial(pattern: &CsMat<u32>) -> Self {
        Elimination::Simplicial(Arc::new(simplicial::Symbolic::new(pattern)))
    }

    #[cfg(feature = "faer")]
    pub(crate) fn supernodal(pattern: &CsMat<u32>, d: usize) -> Self {
        Elimination::Supernodal(Arc::new(supernodal::Symbolic::new(pattern, d)))
    }

    #[cfg(test)]
    pub(crate) fn is_supernodal(&self) -> bool {
        !matches!(self, Elimination::Simplicial(_))
    }

    /// How many blocks a simplicial factor has below its diagonal.
    #[cfg(all(test, feature = "faer"))]
    pub(crate) fn blocks(&self) -> usize {
        match self {
            Elimination::Simplicial(symbolic) => symbolic.blocks(),
            Elimination::Supernodal(_) => unreachable!("asked of simplicial eliminations only"),
        }
    }

    /// Factorizes A + `damping` · diag(A), A given by the blocks of its upper triangle, column by column.
    pub(crate) fn factorize<const D: usize>(
        &self,
        pattern: &CsMat<u32>,
        blocks: &[SMatrix<f64, D, D>],
        damping: f64,
    ) -> Result<Values<D>, NotPositiveDefinite> {
        Ok(match self {
            Elimination::Simplicial(symbolic) => {
                Values::Simplicial(SimplicialFactor::new(symbolic, pattern, blocks, damping)?)
            }
            #[cfg(feature = "faer")]
            Elimination::Supernodal(symbolic) => {
                Values::Supernodal(SupernodalFactor::new(symbolic, pattern, blocks, damping)?)
            }
        })
    }
}

impl<const D: usize> Values<D> {
    /// Replaces b by A⁻¹ b, blocks in elimination order.
    pub(crate) fn solve_in_place(&self, b: &mut [f64]) {
        match self {
            Values::Simplicial(factor) => factor.solve_in_place(b),
            #[cfg(feature = "faer")]
            Values::Supernodal(factor) => factor.solve_in_place(b),
        }
    }

    /// The diagonal blocks of A⁻¹, in elimination order.
    pub(crate) fn inverse_diagonal_blocks(&self) -> Vec<SMatrix<f64, D, D>> {
        match self {
            Values::Simplicial(factor) => factor.inverse_diagonal_blocks(),
            #[cfg(feature = "faer")]
            Values::Supernodal(factor) => factor.inverse_diagonal_blocks(),
        }
    }

    /// ln |A|.
    pub(crate) fn log_determinant(&self) -> f64 {
        match self {
            Values::Simplicial(factor) => factor.log_determinant(),
            #[cfg(feature = "faer")]
            Values::Supernodal(factor) => factor.log_determinant(),
        }
    }
}
