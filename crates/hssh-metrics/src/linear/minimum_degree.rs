//! A minimum degree order of our own, for builds without faer.
//!
//! The next block is always one with the fewest neighbours in what is left of the graph (Amestoy, Davis and Duff, *An
//! Approximate Minimum Degree Ordering Algorithm*, 1996). Eliminating a block joins all its neighbours; that clique is
//! kept as one list, an *element*, instead of its many edges. Degrees are their upper bounds, which count a block
//! twice if two older elements share it. Blocks that look alike are not merged: pose graphs have few.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use sprs::CsMat;

/// The graph that is left after some eliminations.
struct Quotient {
    /// Neighbours by edges that no element covers.
    neighbours: Vec<Vec<usize>>,
    /// The elements that each block left is in, named by the block that made them.
    elements: Vec<Vec<usize>>,
    /// The blocks in each element; none if there is no such element, or none any more.
    members: Vec<Vec<usize>>,
}

/// `position[block]`: when a block is eliminated, given the upper triangle of a pattern with its whole diagonal.
pub(crate) fn elimination_order(pattern: &CsMat<u32>) -> Vec<usize> {
    let size = pattern.cols();
    let mut graph = Quotient::new(pattern);
    let mut degree: Vec<usize> = graph.neighbours.iter().map(Vec::len).collect();
    // Entries whose degree is out of date are skipped when they come up.
    let mut queue: BinaryHeap<_> = (0..size).map(|block| Reverse((degree[block], block))).collect();
    let mut position = vec![usize::MAX; size];
    let mut eliminated = 0;
    let mut outside = vec![None; size];
    while let Some(Reverse((claimed, pivot))) = queue.pop() {
        if position[pivot] != usize::MAX || degree[pivot] != claimed {
            continue;
        }
        position[pivot] = eliminated;
        eliminated += 1;
        graph.eliminate(pivot);
        graph.count_outside(pivot, &mut outside);
        for index in 0..graph.members[pivot].len() {
            let block = graph.members[pivot][index];
            let bound = graph.degree(block, pivot, &outside).min(size - eliminated - 1);
            if bound != degree[block] {
                degree[block] = bound;
                queue.push(Reverse((bound, block)));
            }
        }
        graph.forget_counts(pivot, &mut outside);
    }
    position
}

impl Quotient {
    fn new(pattern: &CsMat<u32>) -> Self {
        let size = pattern.cols();
        let mut neighbours = vec![Vec::new(); size];
        for (column, rows) in pattern.outer_iterator().enumerate() {
            for &row in rows.indices().iter().filter(|&&row| row != column) {
                neighbours[row].push(column);
                neighbours[column].push(row);
            }
        }
        Quotient { neighbours, elements: vec![Vec::new(); size], members: vec![Vec::new(); size] }
    }

    /// Makes an element of all neighbours of `pivot`, in place of the elements that `pivot` was in.
    fn eliminate(&mut self, pivot: usize) {
        let mut members = std::mem::take(&mut self.neighbours[pivot]);
        let absorbed = std::mem::take(&mut self.elements[pivot]);
        for &element in &absorbed {
            members.append(&mut self.members[element]);
        }
        members.sort_unstable();
        members.dedup();
        members.retain(|&block| block != pivot);
        for &block in &members {
            self.neighbours[block].retain(|other| *other != pivot && members.binary_search(other).is_err());
            self.elements[block].retain(|element| !absorbed.contains(element));
            self.elements[block].push(pivot);
        }
        self.members[pivot] = members;
    }

    /// Sets `outside[element]` to how many of its blocks are not in that of `pivot`, for each that shares one with it.
    fn count_outside(&self, pivot: usize, outside: &mut [Option<usize>]) {
        for &block in &self.members[pivot] {
            for &element in &self.elements[block] {
                let count = outside[element].get_or_insert(self.members[element].len());
                *count -= 1;
            }
        }
    }

    /// Takes back [`Quotient::count_outside`].
    fn forget_counts(&self, pivot: usize, outside: &mut [Option<usize>]) {
        for &block in &self.members[pivot] {
            for &element in &self.elements[block] {
                outside[element] = None;
            }
        }
    }

    /// How many neighbours a block in the element of `pivot` has, or a few more.
    fn degree(&self, block: usize, pivot: usize, outside: &[Option<usize>]) -> usize {
        let elsewhere = self.elements[block].iter().map(|&element| outside[element].unwrap_or(0));
        self.neighbours[block].len() + self.members[pivot].len() - 1 + elsewhere.sum::<usize>()
    }
}

#[cfg(test)]
mod tests {
    use sprs::TriMat;

    use super::*;

    /// The upper triangle of a graph's pattern.
    fn pattern(size: usize, pairs: impl Iterator<Item = (usize, usize)>) -> CsMat<u32> {
        let mut triplets = TriMat::new((size, size));
        for (row, column) in (0..size).map(|i| (i, i)).chain(pairs) {
            triplets.add_triplet(row.min(column), row.max(column), 1);
        }
        triplets.to_csc()
    }

    /// A tree can be eliminated from its leaves, without any fill: each block has one neighbour left at most.
    #[test]
    fn trees_are_eliminated_from_their_leaves() {
        let parent = |block: usize| (block * 7919 + 13) % block;
        let size = 200;
        let position = elimination_order(&pattern(size, (1..size).map(|block| (parent(block), block))));
        let mut later = vec![0; size];
        for block in 1..size {
            later[if position[block] < position[parent(block)] { block } else { parent(block) }] += 1;
        }
        assert!(later.iter().all(|&count| count <= 1), "{later:?}");
    }

    #[test]
    fn every_block_has_a_position_of_its_own() {
        for reach in [0, 1, 3, 20, 59] {
            let pairs = (0..60).flat_map(|i| (1..=reach).map(move |step| (i, (i + step) % 60)));
            let mut position = elimination_order(&pattern(60, pairs));
            position.sort_unstable();
            assert!(position.into_iter().eq(0..60));
        }
    }
}
