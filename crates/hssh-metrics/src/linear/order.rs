//! When each block is eliminated: an approximate minimum degree order on blocks, cheaper than one on scalars and no
//! worse.

#[cfg(feature = "faer")]
use sprs::CsMat;

/// `position[block]`: when a block is eliminated, given the upper triangle of a pattern with its whole diagonal.
#[cfg(feature = "faer")]
pub(crate) fn elimination_order(pattern: &CsMat<u32>) -> Vec<usize> {
    use faer::dyn_stack::{MemBuffer, MemStack};
    use faer::sparse::SymbolicSparseColMatRef;
    use faer::sparse::linalg::amd;

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

#[cfg(not(feature = "faer"))]
pub(crate) use super::minimum_degree::elimination_order;
