//! The dense block matrix, for small graphs and as the plain statement of what the sparse one computes.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SMatrix};

use super::error::NotPositiveDefinite;

/// A symmetric matrix of D×D blocks; the lower triangle counts.
pub(crate) struct DenseMatrix<const D: usize>(DMatrix<f64>);

/// Its Cholesky factor.
pub(crate) struct DenseFactor(Cholesky<f64, Dyn>);

impl<const D: usize> DenseMatrix<D> {
    pub(crate) fn new(blocks: usize) -> Self {
        DenseMatrix(DMatrix::zeros(blocks * D, blocks * D))
    }

    pub(crate) fn set_zero(&mut self) {
        self.0.fill(0.0);
    }

    pub(crate) fn add(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        if row >= column {
            let mut view = self.0.fixed_view_mut::<D, D>(row * D, column * D);
            view += block;
        } else {
            let mut view = self.0.fixed_view_mut::<D, D>(column * D, row * D);
            view += block.transpose();
        }
    }

    pub(crate) fn factorize(&self, damping: f64) -> Result<DenseFactor, NotPositiveDefinite> {
        let mut damped = self.0.clone();
        for i in 0..damped.nrows() {
            damped[(i, i)] *= 1.0 + damping;
        }
        damped.cholesky().map(DenseFactor).ok_or(NotPositiveDefinite)
    }
}

impl DenseFactor {
    pub(crate) fn solve(&self, right_hand_side: &[f64]) -> Vec<f64> {
        self.0.solve(&DVector::from_column_slice(right_hand_side)).as_slice().to_vec()
    }

    pub(crate) fn inverse_diagonal_blocks<const D: usize>(&self) -> Vec<SMatrix<f64, D, D>> {
        let inverse = self.0.inverse();
        (0..inverse.nrows()).step_by(D).map(|first| inverse.fixed_view::<D, D>(first, first).into()).collect()
    }

    pub(crate) fn log_determinant(&self) -> f64 {
        let factor = self.0.l_dirty();
        (0..factor.nrows()).map(|i| 2.0 * factor[(i, i)].ln()).sum()
    }
}
