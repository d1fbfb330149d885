//! Open hypotheses by how much they explain, and those set aside because they cost too much.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::posterior::cost::Tariff;
use crate::posterior::leaf::Leaf;

/// All hypotheses that are not expanded.
#[derive(Debug)]
pub(crate) struct Frontier {
    /// By number of travels explained.
    levels: Vec<BinaryHeap<Reverse<Leaf>>>,
    /// Everything that comes of them costs more than matters.
    parked: Vec<Leaf>,
    bytes: u64,
}

impl Frontier {
    pub(crate) fn new(travels: usize, root: Leaf) -> Self {
        let levels = (0..=travels).map(|_| BinaryHeap::new()).collect();
        let mut frontier = Frontier { levels, parked: Vec::new(), bytes: 0 };
        frontier.push(root);
        frontier
    }

    pub(crate) fn push(&mut self, leaf: Leaf) {
        self.bytes += leaf.bytes();
        self.levels[leaf.depth].push(Reverse(leaf));
    }

    /// Sets a hypothesis aside.
    pub(crate) fn park(&mut self, leaf: Leaf) {
        self.bytes += leaf.bytes();
        self.parked.push(leaf);
    }

    /// Takes back what was set aside and can lead to maps that cost no more than `reach`.
    pub(crate) fn unpark(&mut self, reach: f64) {
        for leaf in self.parked.extract_if(.., |leaf| leaf.bound <= reach) {
            self.levels[leaf.depth].push(Reverse(leaf));
        }
    }

    /// The next hypothesis that explains so many travels.
    pub(crate) fn pop(&mut self, explained: usize) -> Option<Leaf> {
        let Reverse(leaf) = self.levels[explained].pop()?;
        self.bytes -= leaf.bytes();
        Some(leaf)
    }

    /// Whose turn it is among those that explain so many travels.
    pub(crate) fn peek(&self, explained: usize) -> Option<&Leaf> {
        self.levels[explained].peek().map(|Reverse(leaf)| leaf)
    }

    /// How many travels the hypothesis explains whose turn it is among all.
    pub(crate) fn next_level(&self) -> Option<usize> {
        let heads = (0..self.levels.len()).filter_map(|explained| self.peek(explained));
        heads.min().map(|leaf| leaf.depth)
    }

    fn leaves(&self) -> impl Iterator<Item = &Leaf> {
        self.levels.iter().flatten().map(|Reverse(leaf)| leaf).chain(&self.parked)
    }

    /// The least that any map costs that comes of an open hypothesis.
    pub(crate) fn least_bound(&self) -> Option<f64> {
        self.leaves().map(|leaf| leaf.bound).min_by(f64::total_cmp)
    }

    /// ln of what all maps that come of open hypotheses together can weigh at most.
    pub(crate) fn log_mass(&self, tariff: &Tariff) -> f64 {
        log_sum(self.leaves().map(|leaf| tariff.log_branches(leaf.depth, leaf.pending) - leaf.bound))
    }

    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// ln Σ eˣ.
pub(crate) fn log_sum(logs: impl Iterator<Item = f64>) -> f64 {
    let logs: Vec<f64> = logs.collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        most
    } else {
        most + logs.iter().map(|log| (log - most).exp()).sum::<f64>().ln()
    }
}
