//! The sparse block matrix: blocks reordered once, the symbolic factorization reused, one thread.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
    supernodal::SupernodalLltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use nalgebra::SMatrix;
use sprs::{CsMat, TriMat};

use super::NotPositiveDefinite;

/// A symmetric matrix of D×D blocks, its upper triangle in compressed columns, blocks in elimination order.
pub(crate) struct SparseMatrix<const D: usize> {
    structure: Arc<Structure>,
    /// The scalars of the upper triangle, column by column.
    values: Vec<f64>,
}

/// Everything that depends on the pattern alone.
struct Structure {
    /// `position[block]`: when a block is eliminated.
    position: Vec<usize>,
    /// The upper triangle in blocks, by position: which block rows each block column has.
    blocks: CsMat<u32>,
    /// The upper triangle in scalars.
    scalars: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
}

/// Its Cholesky factor.
pub(crate) struct SparseFactor {
    structure: Arc<Structure>,
    values: Vec<f64>,
}

impl<const D: usize> SparseMatrix<D> {
    pub(crate) fn new(blocks: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let pairs: Vec<(usize, usize)> = pairs.into_iter().collect();
        let position = elimination_order(&upper_pattern(blocks, pairs.iter().copied()));
        let blocks =
            upper_pattern(blocks, pairs.iter().map(|&(row, column)| (position[row], position[column])));
        let scalars = expand(&blocks, D);
        let symbolic = factorize_symbolic_cholesky(
            scalars.as_ref(),
            Side::Upper,
            SymmetricOrdering::Identity,
            Default::default(),
        )
        .expect("a pattern that fits in memory has a symbolic factorization");
        let values = vec![0.0; scalars.row_idx().len()];
        SparseMatrix { structure: Arc::new(Structure { position, blocks, scalars, symbolic }), values }
    }

    #[cfg(test)]
    pub(crate) fn is_supernodal(&self) -> bool {
        matches!(self.structure.symbolic.raw(), SymbolicCholeskyRaw::Supernodal(_))
    }

    pub(crate) fn set_zero(&mut self) {
        self.values.fill(0.0);
    }

    pub(crate) fn add(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        let structure = &self.structure;
        let (row, column) = (structure.position[row], structure.position[column]);
        if row <= column {
            self.add_upper(row, column, block)
        } else {
            self.add_upper(column, row, &block.transpose())
        }
    }

    fn add_upper(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        let rows = self
            .structure
            .blocks
            .outer_view(column)
            .expect("the block is in the matrix")
            .into_raw_storage()
            .0;
        let index = rows.binary_search(&row).expect("the block is in the pattern");
        for c in 0..D {
            let height = if row == column { c + 1 } else { D };
            let first = self.structure.scalars.col_ptr()[column * D + c] + index * D;
            for (value, entry) in self.values[first..first + height].iter_mut().zip(block.column(c).iter()) {
                *value += entry;
            }
        }
    }

    pub(crate) fn factorize(&self, damping: f64) -> Result<SparseFactor, NotPositiveDefinite> {
        let structure = &self.structure;
        if !self.values.iter().all(|value| value.is_finite()) {
            return Err(NotPositiveDefinite);
        }
        let mut damped = self.values.clone();
        for end in &structure.scalars.col_ptr()[1..] {
            damped[end - 1] *= 1.0 + damping; // the diagonal comes last in an upper column
        }
        let mut values = vec![0.0; structure.symbolic.len_val()];
        let scratch = structure.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        structure
            .symbolic
            .factorize_numeric_llt(
                &mut values,
                SparseColMatRef::new(structure.scalars.as_ref(), &damped),
                Side::Upper,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        Ok(SparseFactor { structure: Arc::clone(structure), values })
    }
}

impl SparseFactor {
    pub(crate) fn solve(&self, right_hand_side: &[f64]) -> Vec<f64> {
        let Structure { position, symbolic, .. } = &*self.structure;
        let size = right_hand_side.len() / position.len();
        let mut ordered = vec![0.0; right_hand_side.len()];
        for (from, &to) in right_hand_side.chunks_exact(size).zip(position) {
            ordered[to * size..][..size].copy_from_slice(from);
        }
        let mut memory = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut ordered, right_hand_side.len(), 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        position.iter().flat_map(|&from| &ordered[from * size..][..size]).copied().collect()
    }

    pub(crate) fn log_determinant(&self) -> f64 {
        match self.structure.symbolic.raw() {
            // Both layouts put the diagonal entry first in its column, a supernode shares rows.
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                let starts = &symbolic.col_ptr()[..symbolic.ncols()];
                starts.iter().map(|&start| 2.0 * self.values[start].ln()).sum()
            }
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                let factor = SupernodalLltRef::new(symbolic, &self.values);
                let diagonal = |supernode| {
                    let columns = symbolic.supernode_end()[supernode] - symbolic.supernode_begin()[supernode];
                    let dense = factor.supernode(supernode).val();
                    (0..columns).map(|i| 2.0 * dense[(i, i)].ln()).sum::<f64>()
                };
                (0..symbolic.n_supernodes()).map(diagonal).sum()
            }
        }
    }
}

/// The upper triangle of a symmetric pattern with its whole diagonal, rows ascending in every column.
fn upper_pattern(size: usize, pairs: impl Iterator<Item = (usize, usize)>) -> CsMat<u32> {
    let mut triplets = TriMat::new((size, size));
    for i in 0..size {
        triplets.add_triplet(i, i, 1);
    }
    for (row, column) in pairs {
        triplets.add_triplet(row.min(column), row.max(column), 1);
    }
    triplets.to_csc()
}

/// When to eliminate each block: approximate minimum degree on blocks, cheaper and no worse than on scalars.
fn elimination_order(pattern: &CsMat<u32>) -> Vec<usize> {
    let size = pattern.cols();
    let column_starts = pattern.indptr();
    let pattern = SymbolicSparseColMatRef::new_checked(
        size,
        size,
        column_starts.as_slice().expect("a matrix that is no slice of another has plain column starts"),
        None,
        pattern.indices(),
    );
    let (mut order, mut position) = (vec![0; size], vec![0; size]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(size, pattern.row_idx().len()));
    amd::order(&mut order, &mut position, pattern, Default::default(), MemStack::new(&mut memory))
        .expect("a pattern that fits in memory has an ordering");
    position
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
