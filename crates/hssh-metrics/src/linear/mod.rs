//! Symmetric positive definite matrices in D×D blocks: assembled, factorized and solved, dense or sparse.

mod dense;
mod elimination;
mod error;
#[cfg(any(test, not(feature = "faer")))]
mod minimum_degree;
mod order;
mod simplicial;
mod sparse;
#[cfg(feature = "faer")]
mod supernodal;

use nalgebra::SMatrix;

use dense::{DenseFactor, DenseMatrix};
pub(crate) use error::NotPositiveDefinite;
use sparse::{SparseFactor, SparseMatrix};

/// Up to this many scalar unknowns a dense factorization is faster than ordering and analyzing a sparse one:
/// measured over whole solutions, they cross between 15 poses (many iterations) and 20 (a single one).
const LARGEST_DENSE: usize = 48;

/// A symmetric matrix with a fixed pattern of D×D blocks.
pub(crate) enum BlockMatrix<const D: usize> {
    Dense(DenseMatrix<D>),
    Sparse(SparseMatrix<D>),
}

/// The Cholesky factor L of a block matrix A = L Lᵀ.
pub(crate) enum Factor<const D: usize> {
    Dense(DenseFactor),
    Sparse(SparseFactor<D>),
}

impl<const D: usize> BlockMatrix<D> {
    /// The zero matrix of `blocks` × `blocks` blocks, of which the diagonal ones and `pairs` may be filled.
    pub(crate) fn new(blocks: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        if blocks * D <= LARGEST_DENSE {
            BlockMatrix::Dense(DenseMatrix::new(blocks))
        } else {
            BlockMatrix::Sparse(SparseMatrix::new(blocks, pairs))
        }
    }

    pub(crate) fn set_zero(&mut self) {
        match self {
            BlockMatrix::Dense(matrix) => matrix.set_zero(),
            BlockMatrix::Sparse(matrix) => matrix.set_zero(),
        }
    }

    /// Adds a block at `row`, `column` and its transpose at the mirrored place. On the diagonal the block
    /// itself must be symmetric.
    pub(crate) fn add(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        match self {
            BlockMatrix::Dense(matrix) => matrix.add(row, column, block),
            BlockMatrix::Sparse(matrix) => matrix.add(row, column, block),
        }
    }

    /// Factorizes A + `damping` · diag(A).
    pub(crate) fn factorize(&self, damping: f64) -> Result<Factor<D>, NotPositiveDefinite> {
        Ok(match self {
            BlockMatrix::Dense(matrix) => Factor::Dense(matrix.factorize(damping)?),
            BlockMatrix::Sparse(matrix) => Factor::Sparse(matrix.factorize(damping)?),
        })
    }
}

impl<const D: usize> Factor<D> {
    /// A⁻¹ b for one right-hand side.
    pub(crate) fn solve(&self, right_hand_side: &[f64]) -> Vec<f64> {
        match self {
            Factor::Dense(factor) => factor.solve(right_hand_side),
            Factor::Sparse(factor) => factor.solve(right_hand_side),
        }
    }

    /// The diagonal blocks of A⁻¹.
    pub(crate) fn inverse_diagonal_blocks(&self) -> Vec<SMatrix<f64, D, D>> {
        match self {
            Factor::Dense(factor) => factor.inverse_diagonal_blocks(),
            Factor::Sparse(factor) => factor.inverse_diagonal_blocks(),
        }
    }

    /// ln |A|.
    pub(crate) fn log_determinant(&self) -> f64 {
        match self {
            Factor::Dense(factor) => factor.log_determinant(),
            Factor::Sparse(factor) => factor.log_determinant(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, matrix};

    /// Which blocks of a graph are joined: each to so many that follow, around a ring.
    fn pairs(blocks: usize, reach: usize) -> Vec<(usize, usize)> {
        (0..blocks).flat_map(|i| (1..=reach).map(move |step| (i, (i + step) % blocks))).collect()
    }

    /// Diagonally dominant 2×2 blocks without any symmetry of their own.
    fn fill(blocks: usize, pairs: &[(usize, usize)], mut add: impl FnMut(usize, usize, &Matrix2<f64>)) {
        for i in 0..blocks {
            add(i, i, &matrix![5.0 + i as f64, 0.3; 0.3, 4.0 + 2.0 * blocks as f64]);
        }
        for &(i, j) in pairs {
            add(i, j, &(matrix![-1.0, 0.2; 0.1 * i as f64 / blocks as f64, -0.5] / blocks as f64));
        }
    }

    /// Rings and small complete graphs are factorized block by block, the complete graph of 150 blocks in supernodes
    /// if faer is there to do it.
    #[test]
    fn sparse_agrees_with_dense() {
        for (blocks, reach) in [(3, 1), (10, 1), (101, 1), (101, 9), (40, 39), (150, 149)] {
            let pairs = pairs(blocks, reach);
            let mut dense = DenseMatrix::<2>::new(blocks);
            let mut sparse = SparseMatrix::<2>::new(blocks, pairs.iter().copied());
            fill(blocks, &pairs, |row, column, block| dense.add(row, column, block));
            fill(blocks, &pairs, |row, column, block| sparse.add(row, column, block));
            assert_eq!(sparse.is_supernodal(), cfg!(feature = "faer") && reach == 149);
            let right_hand_side: Vec<f64> = (0..2 * blocks).map(|i| (i as f64).sin()).collect();
            for damping in [0.0, 0.5] {
                let (dense, sparse) = (dense.factorize(damping).unwrap(), sparse.factorize(damping).unwrap());
                let difference = dense
                    .solve(&right_hand_side)
                    .iter()
                    .zip(&sparse.solve(&right_hand_side))
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max);
                assert!(difference < 1e-14, "{difference}");
                let inverses =
                    dense.inverse_diagonal_blocks::<2>().into_iter().zip(sparse.inverse_diagonal_blocks());
                for (a, b) in inverses {
                    assert!((a - b).amax() < 1e-14, "{a} {b}");
                }
                assert!((dense.log_determinant() - sparse.log_determinant()).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn indefinite_and_undefined_matrices_have_no_factor() {
        for bad in [-1.0, f64::NAN] {
            let mut dense = DenseMatrix::<2>::new(30);
            let mut sparse = SparseMatrix::<2>::new(30, []);
            for i in 0..30 {
                let block = Matrix2::identity() * if i == 17 { bad } else { 1.0 };
                dense.add(i, i, &block);
                sparse.add(i, i, &block);
            }
            assert!(matches!(dense.factorize(0.0), Err(NotPositiveDefinite)));
            assert!(matches!(sparse.factorize(0.0), Err(NotPositiveDefinite)));
        }
    }
}
