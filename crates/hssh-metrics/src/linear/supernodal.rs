//! Sparse Cholesky factorization in supernodes, by faer: for graphs with so much fill that dense blocks pay.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};
use nalgebra::{SMatrix, SVector};
use sprs::CsMat;

use super::error::NotPositiveDefinite;

/// The pattern in scalars, and its supernodes.
pub(crate) struct Symbolic {
    /// The upper triangle.
    scalars: SymbolicSparseColMat<usize>,
    cholesky: SymbolicCholesky<usize>,
}

/// The factor L of A = L Lᵀ.
pub(crate) struct SupernodalFactor {
    symbolic: Arc<Symbolic>,
    values: Vec<f64>,
}

impl Symbolic {
    /// Analyzes the upper triangle of a pattern of `d`×`d` blocks with its whole diagonal.
    pub(crate) fn new(pattern: &CsMat<u32>, d: usize) -> Self {
        let scalars = expand(pattern, d);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let cholesky = factorize_symbolic_cholesky(
            scalars.as_ref(),
            Side::Upper,
            SymmetricOrdering::Identity,
            parameters,
        )
        .expect("a pattern that fits in memory has a symbolic factorization");
        Symbolic { scalars, cholesky }
    }
}

impl SupernodalFactor {
    /// Factorizes A + `damping` · diag(A), A given by the blocks of its upper triangle, column by column.
    pub(crate) fn new<const D: usize>(
        symbolic: &Arc<Symbolic>,
        pattern: &CsMat<u32>,
        blocks: &[SMatrix<f64, D, D>],
        damping: f64,
    ) -> Result<Self, NotPositiveDefinite> {
        let Symbolic { scalars, cholesky } = &**symbolic;
        let mut damped: Vec<f64> = Vec::with_capacity(scalars.row_idx().len());
        let mut rest = blocks;
        for (column, block_rows) in pattern.outer_iterator().enumerate() {
            let (blocks, others) = rest.split_at(block_rows.nnz());
            rest = others;
            for c in 0..D {
                for (&row, block) in block_rows.indices().iter().zip(blocks) {
                    let height = if row == column { c + 1 } else { D };
                    damped.extend(block.column(c).iter().take(height));
                }
                let diagonal = damped.last_mut().expect("the diagonal comes last in an upper column");
                *diagonal *= 1.0 + damping;
            }
        }
        if !damped.iter().all(|value| value.is_finite()) {
            return Err(NotPositiveDefinite);
        }
        let mut values = vec![0.0; cholesky.len_val()];
        let scratch = cholesky.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        cholesky
            .factorize_numeric_llt(
                &mut values,
                SparseColMatRef::new(scalars.as_ref(), &damped),
                Side::Upper,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        Ok(SupernodalFactor { symbolic: Arc::clone(symbolic), values })
    }

    /// Replaces b by A⁻¹ b, blocks in elimination order.
    pub(crate) fn solve_in_place(&self, b: &mut [f64]) {
        let cholesky = &self.symbolic.cholesky;
        let mut memory = MemBuffer::new(cholesky.solve_in_place_scratch::<f64>(1, Par::Seq));
        let length = b.len();
        LltRef::new(cholesky, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(b, length, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }

    /// The diagonal blocks of A⁻¹, in elimination order, by a solution for each column: such graphs are small.
    pub(crate) fn inverse_diagonal_blocks<const D: usize>(&self) -> Vec<SMatrix<f64, D, D>> {
        let size = self.symbolic.scalars.ncols();
        let mut unit = vec![0.0; size];
        let block = |first: usize| {
            SMatrix::from_columns(&std::array::from_fn::<_, D, _>(|axis| {
                unit.fill(0.0);
                unit[first + axis] = 1.0;
                self.solve_in_place(&mut unit);
                SVector::from_column_slice(&unit[first..first + D])
            }))
        };
        (0..size).step_by(D).map(block).collect()
    }

    /// ln |A|.
    pub(crate) fn log_determinant(&self) -> f64 {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.cholesky.raw() else {
            unreachable!("supernodes are forced")
        };
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        let diagonal = |supernode| {
            let columns = symbolic.supernode_end()[supernode] - symbolic.supernode_begin()[supernode];
            let dense = factor.supernode(supernode).val();
            (0..columns).map(|i| 2.0 * dense[(i, i)].ln()).sum::<f64>()
        };
        (0..symbolic.n_supernodes()).map(diagonal).sum()
    }
}

/// Replaces every block by `d`×`d` scalars, keeping the upper triangle.
fn expand(blocks: &CsMat<u32>, d: usize) -> SymbolicSparseColMat<usize> {
    let size = blocks.cols() * d;
    let mut column_starts = vec![0];
    let mut rows = Vec::new();
    for (column, block_rows) in blocks.outer_iterator().enumerate() {
        for c in 0..d {
            let scalar_rows = block_rows.indices().iter().flat_map(|row| row * d..(row + 1) * d);
            rows.extend(scalar_rows.take_while(|&row| row <= column * d + c));
            column_starts.push(rows.len());
        }
    }
    SymbolicSparseColMat::new_checked(size, size, column_starts, None, rows)
}
