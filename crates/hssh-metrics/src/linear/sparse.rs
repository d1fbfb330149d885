//! The sparse block matrix: blocks reordered once, the symbolic factorization reused, one thread.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use nalgebra::SMatrix;
use sprs::{CsMat, TriMat};

use super::error::NotPositiveDefinite;
use super::simplicial::{self, SimplicialFactor};
use super::supernodal::{self, SupernodalFactor};

/// From so much work per block of the factor on, dense supernodes are faster than single blocks. Pose graphs have less
/// than a third of it.
const SUPERNODAL_WORK: f64 = 60.0;

/// A symmetric matrix of D×D blocks, its upper triangle in compressed columns, blocks in elimination order.
pub(crate) struct SparseMatrix<const D: usize> {
    structure: Arc<Structure>,
    /// The blocks of the upper triangle, column by column; those on the diagonal are whole.
    blocks: Vec<SMatrix<f64, D, D>>,
}

/// Everything that depends on the pattern alone.
struct Structure {
    /// `position[block]`: when a block is eliminated.
    position: Vec<usize>,
    /// The upper triangle, by position: which block rows each block column has.
    pattern: CsMat<u32>,
    elimination: Elimination,
}

/// How the pattern is eliminated.
enum Elimination {
    Simplicial(Arc<simplicial::Symbolic>),
    Supernodal(Arc<supernodal::Symbolic>),
}

/// Its Cholesky factor.
pub(crate) struct SparseFactor<const D: usize> {
    structure: Arc<Structure>,
    values: Values<D>,
}

/// The numbers of the factor, as the elimination arranges them.
enum Values<const D: usize> {
    Simplicial(SimplicialFactor<D>),
    Supernodal(SupernodalFactor),
}

impl<const D: usize> SparseMatrix<D> {
    pub(crate) fn new(blocks: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let pairs: Vec<(usize, usize)> = pairs.into_iter().collect();
        let position = elimination_order(&upper_pattern(blocks, pairs.iter().copied()));
        let pattern =
            upper_pattern(blocks, pairs.iter().map(|&(row, column)| (position[row], position[column])));
        let symbolic = simplicial::Symbolic::new(&pattern);
        let elimination = if symbolic.work_per_block() < SUPERNODAL_WORK {
            Elimination::Simplicial(Arc::new(symbolic))
        } else {
            Elimination::Supernodal(Arc::new(supernodal::Symbolic::new(&pattern, D)))
        };
        let blocks = vec![SMatrix::zeros(); pattern.nnz()];
        SparseMatrix { structure: Arc::new(Structure { position, pattern, elimination }), blocks }
    }

    #[cfg(test)]
    pub(crate) fn is_supernodal(&self) -> bool {
        matches!(self.structure.elimination, Elimination::Supernodal(_))
    }

    pub(crate) fn set_zero(&mut self) {
        self.blocks.fill(SMatrix::zeros());
    }

    pub(crate) fn add(&mut self, row: usize, column: usize, block: &SMatrix<f64, D, D>) {
        let position = &self.structure.position;
        let (row, column) = (position[row], position[column]);
        if row <= column {
            *self.upper(row, column) += block;
        } else {
            *self.upper(column, row) += block.transpose();
        }
    }

    fn upper(&mut self, row: usize, column: usize) -> &mut SMatrix<f64, D, D> {
        let pattern = &self.structure.pattern;
        let entries = pattern.indptr().outer_inds_sz(column);
        let rows = &pattern.indices()[entries.clone()];
        let index = rows.binary_search(&row).expect("the block is in the pattern");
        &mut self.blocks[entries.start + index]
    }

    pub(crate) fn factorize(&self, damping: f64) -> Result<SparseFactor<D>, NotPositiveDefinite> {
        let Structure { pattern, elimination, .. } = &*self.structure;
        let values = match elimination {
            Elimination::Simplicial(symbolic) => {
                Values::Simplicial(SimplicialFactor::new(symbolic, pattern, &self.blocks, damping)?)
            }
            Elimination::Supernodal(symbolic) => {
                Values::Supernodal(SupernodalFactor::new(symbolic, pattern, &self.blocks, damping)?)
            }
        };
        Ok(SparseFactor { structure: Arc::clone(&self.structure), values })
    }
}

impl<const D: usize> SparseFactor<D> {
    pub(crate) fn solve(&self, right_hand_side: &[f64]) -> Vec<f64> {
        let position = &self.structure.position;
        let mut ordered = vec![0.0; right_hand_side.len()];
        for (from, &to) in right_hand_side.chunks_exact(D).zip(position) {
            ordered[to * D..][..D].copy_from_slice(from);
        }
        match &self.values {
            Values::Simplicial(factor) => factor.solve_in_place(&mut ordered),
            Values::Supernodal(factor) => factor.solve_in_place(&mut ordered),
        }
        position.iter().flat_map(|&from| &ordered[from * D..][..D]).copied().collect()
    }

    pub(crate) fn log_determinant(&self) -> f64 {
        match &self.values {
            Values::Simplicial(factor) => factor.log_determinant(),
            Values::Supernodal(factor) => factor.log_determinant(),
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
