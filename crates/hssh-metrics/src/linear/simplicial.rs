//! Sparse Cholesky factorization in D×D blocks, row by row (up-looking; Davis, *Direct Methods for Sparse Linear
//! Systems*, chapter 4): the blocks of pose graphs are small, their fill is little, and every index is looked up once
//! for D² numbers.

use std::sync::Arc;

use nalgebra::SMatrix;
use sprs::CsMat;

use super::error::NotPositiveDefinite;

/// Which blocks the factor L of a pattern has, besides its diagonal.
pub(crate) struct Symbolic {
    /// Where each row's part of [`Symbolic::columns`] begins, and the end.
    row_starts: Vec<usize>,
    /// The block columns of each row of L, ascending: an order in which they can be eliminated.
    columns: Vec<u32>,
    /// Where each column's part of [`Symbolic::rows`] begins, and the end.
    column_starts: Vec<usize>,
    /// The block rows of each column of L, ascending.
    rows: Vec<u32>,
}

/// The factor L of A = L Lᵀ.
pub(crate) struct SimplicialFactor<const D: usize> {
    symbolic: Arc<Symbolic>,
    /// L_jj⁻¹, lower triangular.
    inverse_diagonal: Vec<SMatrix<f64, D, D>>,
    /// The blocks below the diagonal, column by column.
    below: Vec<SMatrix<f64, D, D>>,
}

const NONE: u32 = u32::MAX;

impl Symbolic {
    /// Analyzes the upper triangle of a pattern with its whole diagonal.
    pub(crate) fn new(pattern: &CsMat<u32>) -> Self {
        let size = pattern.cols();
        let (mut parent, mut reached_by) = (vec![NONE; size], vec![NONE; size]);
        let (mut row_starts, mut columns) = (vec![0], Vec::new());
        let mut column_starts = vec![0; size + 1];
        for (k, above) in pattern.outer_iterator().enumerate() {
            // Row k of L: all that the elimination tree has between the entries above A_kk and k.
            reached_by[k] = k as u32;
            for &entry in above.indices() {
                let mut j = entry;
                while reached_by[j] != k as u32 {
                    reached_by[j] = k as u32;
                    columns.push(j as u32);
                    column_starts[j + 1] += 1;
                    if parent[j] == NONE {
                        parent[j] = k as u32;
                    }
                    j = parent[j] as usize;
                }
            }
            let start = row_starts[k];
            columns[start..].sort_unstable();
            row_starts.push(columns.len());
        }
        for j in 0..size {
            column_starts[j + 1] += column_starts[j];
        }
        let (mut rows, mut filled) = (vec![0; columns.len()], column_starts.clone());
        for k in 0..size {
            for &j in &columns[row_starts[k]..row_starts[k + 1]] {
                rows[filled[j as usize]] = k as u32;
                filled[j as usize] += 1;
            }
        }
        Symbolic { row_starts, columns, column_starts, rows }
    }

    /// How many blocks the factor has below its diagonal.
    #[cfg(all(test, feature = "faer"))]
    pub(crate) fn blocks(&self) -> usize {
        self.rows.len()
    }

    /// How many blocks the column of a block of L has, on the average over all blocks: how much work each is.
    #[cfg(feature = "faer")]
    pub(crate) fn work_per_block(&self) -> f64 {
        let counts = self.column_starts.windows(2).map(|ends| ends[1] - ends[0]);
        counts.map(|count| (count * count) as f64).sum::<f64>() / self.rows.len().max(1) as f64
    }
}

impl<const D: usize> SimplicialFactor<D> {
    /// Factorizes A + `damping` · diag(A), A given by the blocks of its upper triangle, column by column.
    pub(crate) fn new(
        symbolic: &Arc<Symbolic>,
        pattern: &CsMat<u32>,
        blocks: &[SMatrix<f64, D, D>],
        damping: f64,
    ) -> Result<Self, NotPositiveDefinite> {
        let Symbolic { row_starts, columns, column_starts, rows } = &**symbolic;
        let size = pattern.cols();
        let mut inverse_diagonal: Vec<SMatrix<f64, D, D>> = Vec::with_capacity(size);
        let mut below = vec![SMatrix::zeros(); rows.len()];
        let mut filled = column_starts.clone();
        // What is left of row k: block j holds A_kj − Σ L_ki L_jiᵀ over the columns i done; all others are zero.
        let mut row = vec![SMatrix::<f64, D, D>::zeros(); size];
        let mut blocks = blocks.iter();
        for (k, above) in pattern.outer_iterator().enumerate() {
            for (&j, block) in above.indices().iter().zip(&mut blocks) {
                row[j] = block.transpose();
            }
            let mut diagonal = std::mem::replace(&mut row[k], SMatrix::zeros());
            for i in 0..D {
                diagonal[(i, i)] *= 1.0 + damping;
            }
            for &j in &columns[row_starts[k]..row_starts[k + 1]] {
                let j = j as usize;
                let entry =
                    std::mem::replace(&mut row[j], SMatrix::zeros()) * inverse_diagonal[j].transpose(); // L_kj
                let done = column_starts[j]..filled[j];
                for (&i, block) in rows[done.clone()].iter().zip(&below[done]) {
                    subtract_product(&mut row[i as usize], &entry, block);
                }
                subtract_product(&mut diagonal, &entry, &entry);
                below[filled[j]] = entry;
                filled[j] += 1;
            }
            inverse_diagonal.push(inverse_of_factor(&diagonal).ok_or(NotPositiveDefinite)?);
        }
        Ok(SimplicialFactor { symbolic: Arc::clone(symbolic), inverse_diagonal, below })
    }

    /// Replaces b by A⁻¹ b, blocks in elimination order.
    pub(crate) fn solve_in_place(&self, b: &mut [f64]) {
        let (b, _) = b.as_chunks_mut::<D>();
        for j in 0..b.len() {
            let x = self.inverse_diagonal[j] * SMatrix::<f64, D, 1>::from(b[j]);
            b[j] = x.into();
            for (i, block) in self.column(j) {
                for (value, change) in b[i].iter_mut().zip((block * x).iter()) {
                    *value -= change;
                }
            }
        }
        for j in (0..b.len()).rev() {
            let mut x = SMatrix::<f64, D, 1>::from(b[j]);
            for (i, block) in self.column(j) {
                x -= block.tr_mul(&SMatrix::<f64, D, 1>::from(b[i]));
            }
            b[j] = self.inverse_diagonal[j].tr_mul(&x).into();
        }
    }

    /// The diagonal blocks of A⁻¹, in elimination order (Takahashi, Fagan and Chen, 1973).
    ///
    /// From A⁻¹ = L⁻ᵀ L⁻¹ follows A⁻¹ L = L⁻ᵀ, whose part at and below the diagonal is known: it is that of the diagonal's
    /// inverses. So a column of A⁻¹, at the rows that L has there, follows from later columns at rows that L has there too: the
    /// rows of a column of L are joined among each other. It costs about what the factorization costs.
    pub(crate) fn inverse_diagonal_blocks(&self) -> Vec<SMatrix<f64, D, D>> {
        let Symbolic { column_starts, rows, .. } = &*self.symbolic;
        let size = self.inverse_diagonal.len();
        let mut diagonal = vec![SMatrix::<f64, D, D>::zeros(); size];
        let mut below = vec![SMatrix::<f64, D, D>::zeros(); rows.len()];
        for j in (0..size).rev() {
            let entries = column_starts[j]..column_starts[j + 1];
            // L_kj L_jj⁻¹ for every row k of the column.
            let scaled: Vec<SMatrix<f64, D, D>> =
                self.below[entries.clone()].iter().map(|block| block * self.inverse_diagonal[j]).collect();
            let here = &rows[entries.clone()];
            // Z_ij = −Σ Z_ik L_kj L_jj⁻¹ over the rows k of the column.
            let mut column = vec![SMatrix::<f64, D, D>::zeros(); here.len()];
            for (at_k, &k) in here.iter().enumerate() {
                column[at_k] -= diagonal[k as usize] * scaled[at_k];
                let mut at = column_starts[k as usize];
                for (at_i, &i) in here.iter().enumerate().skip(at_k + 1) {
                    while rows[at] != i {
                        at += 1;
                    }
                    column[at_i] -= below[at] * scaled[at_k];
                    column[at_k] -= below[at].tr_mul(&scaled[at_i]);
                }
            }
            diagonal[j] = self.inverse_diagonal[j].tr_mul(&self.inverse_diagonal[j]);
            for (block, scaled) in column.iter().zip(&scaled) {
                diagonal[j] -= block.tr_mul(scaled);
            }
            below[entries].copy_from_slice(&column);
        }
        diagonal
    }

    /// The blocks of a column below the diagonal, with their rows.
    fn column(&self, j: usize) -> impl Iterator<Item = (usize, &SMatrix<f64, D, D>)> {
        let entries = self.symbolic.column_starts[j]..self.symbolic.column_starts[j + 1];
        let rows = self.symbolic.rows[entries.clone()].iter().map(|&row| row as usize);
        rows.zip(&self.below[entries])
    }

    /// ln |A|.
    pub(crate) fn log_determinant(&self) -> f64 {
        self.inverse_diagonal.iter().flat_map(|inverse| (0..D).map(|i| -2.0 * inverse[(i, i)].ln())).sum()
    }
}

/// target −= left · rightᵀ, written out so that it is compiled to straight code.
#[inline]
fn subtract_product<const D: usize>(
    target: &mut SMatrix<f64, D, D>,
    left: &SMatrix<f64, D, D>,
    right: &SMatrix<f64, D, D>,
) {
    let (target, left, right) = (&mut target.data.0, &left.data.0, &right.data.0);
    for column in 0..D {
        for row in 0..D {
            let mut sum = target[column][row];
            for inner in 0..D {
                sum -= left[inner][row] * right[inner][column];
            }
            target[column][row] = sum;
        }
    }
}

/// L⁻¹ of a block A = L Lᵀ, of which the lower triangle counts; `None` if A is not positive definite, or no number.
fn inverse_of_factor<const D: usize>(block: &SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
    let (mut lower, mut inverse) = (SMatrix::<f64, D, D>::zeros(), SMatrix::<f64, D, D>::zeros());
    for j in 0..D {
        let known = |i: usize, lower: &SMatrix<f64, D, D>| -> f64 {
            (0..j).map(|inner| lower[(i, inner)] * lower[(j, inner)]).sum()
        };
        let pivot = block[(j, j)] - known(j, &lower);
        if !(pivot > 0.0 && pivot.is_finite()) {
            return None;
        }
        lower[(j, j)] = pivot.sqrt();
        for i in j + 1..D {
            lower[(i, j)] = (block[(i, j)] - known(i, &lower)) / lower[(j, j)];
        }
    }
    for column in 0..D {
        inverse[(column, column)] = 1.0 / lower[(column, column)];
        for row in column + 1..D {
            let sum: f64 = (column..row).map(|inner| lower[(row, inner)] * inverse[(inner, column)]).sum();
            inverse[(row, column)] = -sum / lower[(row, row)];
        }
    }
    Some(inverse)
}
