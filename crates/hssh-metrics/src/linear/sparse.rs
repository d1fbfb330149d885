//! The sparse block matrix: blocks reordered once, the symbolic factorization reused, one thread.

use std::sync::Arc;

use nalgebra::SMatrix;
use sprs::{CsMat, TriMat};

use super::elimination::{Elimination, Values};
use super::error::NotPositiveDefinite;
use super::order::elimination_order;

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

/// Its Cholesky factor.
pub(crate) struct SparseFactor<const D: usize> {
    structure: Arc<Structure>,
    values: Values<D>,
}

impl<const D: usize> SparseMatrix<D> {
    pub(crate) fn new(blocks: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        Self::eliminated(blocks, pairs, elimination_order, |pattern| Elimination::new(pattern, D))
    }

    /// The zero matrix, its blocks eliminated when `order` says and as `elimination` does it.
    fn eliminated(
        blocks: usize,
        pairs: impl IntoIterator<Item = (usize, usize)>,
        order: impl FnOnce(&CsMat<u32>) -> Vec<usize>,
        elimination: impl FnOnce(&CsMat<u32>) -> Elimination,
    ) -> Self {
        let pairs: Vec<(usize, usize)> = pairs.into_iter().collect();
        let position = order(&upper_pattern(blocks, pairs.iter().copied()));
        let pattern =
            upper_pattern(blocks, pairs.iter().map(|&(row, column)| (position[row], position[column])));
        let elimination = elimination(&pattern);
        let blocks = vec![SMatrix::zeros(); pattern.nnz()];
        SparseMatrix { structure: Arc::new(Structure { position, pattern, elimination }), blocks }
    }

    #[cfg(test)]
    pub(crate) fn is_supernodal(&self) -> bool {
        self.structure.elimination.is_supernodal()
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
        let values = elimination.factorize(pattern, &self.blocks, damping)?;
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
        self.values.solve_in_place(&mut ordered);
        position.iter().flat_map(|&from| &ordered[from * D..][..D]).copied().collect()
    }

    pub(crate) fn inverse_diagonal_blocks(&self) -> Vec<SMatrix<f64, D, D>> {
        let ordered = self.values.inverse_diagonal_blocks();
        self.structure.position.iter().map(|&position| ordered[position]).collect()
    }

    pub(crate) fn log_determinant(&self) -> f64 {
        self.values.log_determinant()
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

#[cfg(all(test, feature = "faer"))]
mod tests {
    use nalgebra::Matrix3;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::super::minimum_degree;
    use super::*;

    /// Solves a random positive definite system, every pair of which is joined as an edge of a pose graph joins it:
    /// by faer's order and supernodes, and by our own order, block by block.
    fn assert_agreement(blocks: usize, pairs: &[(usize, usize)], rng: &mut ChaCha8Rng) {
        let joined = pairs.iter().copied();
        let mut theirs =
            SparseMatrix::<3>::eliminated(blocks, joined.clone(), elimination_order, |pattern| {
                Elimination::supernodal(pattern, 3)
            });
        let mut ours = SparseMatrix::<3>::eliminated(
            blocks,
            joined,
            minimum_degree::elimination_order,
            Elimination::simplicial,
        );
        assert!(theirs.is_supernodal() && !ours.is_supernodal());
        let mut add = |row: usize, column: usize, block: &Matrix3<f64>| {
            theirs.add(row, column, block);
            ours.add(row, column, block);
        };
        for block in 0..blocks {
            add(block, block, &Matrix3::identity());
        }
        for &(start, end) in pairs {
            let [a, b]: [Matrix3<f64>; 2] =
                std::array::from_fn(|_| Matrix3::from_fn(|_, _| rng.random_range(-1.0..1.0)));
            add(start, start, &(a.transpose() * a));
            add(end, end, &(b.transpose() * b));
            add(start, end, &(a.transpose() * b));
        }
        let right_hand_side: Vec<f64> = (0..3 * blocks).map(|_| rng.random_range(-1.0..1.0)).collect();
        for damping in [0.0, 0.3] {
            let (theirs, ours) = (theirs.factorize(damping), ours.factorize(damping));
            let (theirs, ours) = (theirs.expect("positive definite"), ours.expect("positive definite"));
            for (x, y) in theirs.solve(&right_hand_side).iter().zip(&ours.solve(&right_hand_side)) {
                assert!((x - y).abs() < 1e-11, "{x} {y}");
            }
            for (x, y) in theirs.inverse_diagonal_blocks().iter().zip(&ours.inverse_diagonal_blocks()) {
                assert!((x - y).amax() < 1e-11, "{x} {y}");
            }
            let (x, y) = (theirs.log_determinant(), ours.log_determinant());
            assert!((x - y).abs() < 1e-12 * x.abs().max(1.0) * blocks as f64, "{x} {y}");
        }
    }

    #[test]
    fn faer_and_we_solve_random_systems_alike() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for blocks in [2, 17, 60, 150] {
            for per_block in [0, 1, 2, 5] {
                let pairs: Vec<(usize, usize)> = (0..blocks * per_block)
                    .map(|_| (rng.random_range(0..blocks), rng.random_range(0..blocks)))
                    .filter(|(start, end)| start != end)
                    .collect();
                assert_agreement(blocks, &pairs, &mut rng);
            }
        }
    }

    /// The pattern of a robot's pose graph on a grid of streets, and what the two orders fill in.
    #[test]
    fn our_order_fills_in_about_as_little_as_faers() {
        let side = 30;
        let streets: Vec<(usize, usize)> = (0..side * side)
            .flat_map(|place| {
                let east = (place % side + 1 < side).then_some((place, place + 1));
                let north = (place + side < side * side).then_some((place, place + side));
                east.into_iter().chain(north)
            })
            .collect();
        assert_agreement(side * side, &streets, &mut ChaCha8Rng::seed_from_u64(2));
        let work = |order: fn(&CsMat<u32>) -> Vec<usize>| {
            SparseMatrix::<3>::eliminated(
                side * side,
                streets.iter().copied(),
                order,
                Elimination::simplicial,
            )
            .structure
            .elimination
            .blocks()
        };
        let (theirs, ours) = (work(elimination_order), work(minimum_degree::elimination_order));
        assert!(ours as f64 <= 1.15 * theirs as f64, "{ours} blocks, {theirs} with faer's");
    }
}
