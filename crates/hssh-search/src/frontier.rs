//! Open hypotheses by how many travels they explain, and those set aside because nothing that matters can come of them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::leaf::{Appraise, Leaf};

/// The open hypotheses that explain one number of travels.
#[derive(Debug)]
pub(crate) struct Level<A: Appraise> {
    queue: BinaryHeap<Reverse<Leaf<A>>>,
    /// How many came here so far.
    arrivals: u32,
}

impl<A: Appraise> Level<A> {
    pub(crate) fn push(&mut self, mut leaf: Leaf<A>) {
        if leaf.arrival == u32::MAX {
            leaf.arrival = self.arrivals;
            self.arrivals += 1;
        }
        self.queue.push(Reverse(leaf));
    }

    pub(crate) fn pop(&mut self) -> Option<Leaf<A>> {
        self.queue.pop().map(|Reverse(leaf)| leaf)
    }

    pub(crate) fn peek(&self) -> Option<&Leaf<A>> {
        self.queue.peek().map(|Reverse(leaf)| leaf)
    }

    /// Takes out everything there is, as if nothing had ever come here.
    pub(crate) fn empty(&mut self) -> Vec<Leaf<A>> {
        self.arrivals = 0;
        std::mem::take(&mut self.queue).into_iter().map(|Reverse(leaf)| leaf).collect()
    }
}

/// All hypotheses that are not expanded.
#[derive(Debug)]
pub(crate) struct Frontier<A: Appraise> {
    /// By number of travels explained.
    pub(crate) levels: Vec<Level<A>>,
    /// Nothing comes of them that matters, as far as is known.
    parked: Vec<Leaf<A>>,
}

impl<A: Appraise> Frontier<A> {
    pub(crate) fn new() -> Self {
        Frontier { levels: Vec::new(), parked: Vec::new() }
    }

    /// Makes levels for so many travels.
    pub(crate) fn make_room(&mut self, travels: usize) {
        self.levels.resize_with(travels + 1, || Level { queue: BinaryHeap::new(), arrivals: 0 });
    }

    pub(crate) fn push(&mut self, leaf: Leaf<A>) {
        self.levels[leaf.depth()].push(leaf);
    }

    /// Sets a hypothesis aside.
    pub(crate) fn park(&mut self, leaf: Leaf<A>) {
        self.parked.push(leaf);
    }

    /// Takes back what was set aside and may matter now.
    pub(crate) fn unpark(&mut self, matters: impl Fn(&Leaf<A>) -> bool) {
        for leaf in self.parked.extract_if(.., |leaf| matters(leaf)) {
            self.levels[leaf.depth as usize].push(leaf);
        }
    }

    /// Takes out everything there is.
    pub(crate) fn drain(&mut self) -> Vec<Leaf<A>> {
        let queued = self.levels.iter_mut().flat_map(|level| std::mem::take(&mut level.queue).into_vec());
        let mut leaves: Vec<Leaf<A>> = queued.map(|Reverse(leaf)| leaf).collect();
        leaves.append(&mut self.parked);
        leaves
    }

    /// How many travels the hypothesis explains whose turn it is among all: of equal ones the deepest.
    pub(crate) fn next_level(&self) -> Option<usize> {
        let heads = self.levels.iter().enumerate();
        let heads = heads.filter_map(|(depth, level)| Some((level.peek()?.key, Reverse(depth))));
        heads.min().map(|(_, Reverse(depth))| depth)
    }

    /// Takes the next hypotheses of the least key there is, at most that many, the deepest first.
    pub(crate) fn pop_equals(&mut self, most: usize) -> Vec<Leaf<A>> {
        let Some(key) = self.next_level().and_then(|depth| self.levels[depth].peek()).map(|leaf| leaf.key)
        else {
            return Vec::new();
        };
        let mut leaves = Vec::new();
        for level in self.levels.iter_mut().rev() {
            while leaves.len() < most && level.peek().is_some_and(|leaf| leaf.key == key) {
                leaves.extend(level.pop());
            }
        }
        leaves
    }

    /// Those that wait for their turn, in no order that means anything.
    pub(crate) fn queued(&self) -> impl Iterator<Item = &Leaf<A>> {
        self.levels.iter().flat_map(|level| &level.queue).map(|Reverse(leaf)| leaf)
    }

    /// Those that were set aside, in the order in which they were.
    pub(crate) fn parked(&self) -> impl Iterator<Item = &Leaf<A>> {
        self.parked.iter()
    }

    /// How many came to each level.
    pub(crate) fn arrivals(&self) -> impl Iterator<Item = u32> {
        self.levels.iter().map(|level| level.arrivals)
    }

    /// Puts everything where it was when so many had come to each level.
    pub(crate) fn restore(&mut self, queued: Vec<Leaf<A>>, parked: Vec<Leaf<A>>, arrivals: Vec<u32>) {
        let level = |arrivals| Level { queue: BinaryHeap::new(), arrivals };
        self.levels = arrivals.into_iter().map(level).collect();
        queued.into_iter().for_each(|leaf| self.push(leaf));
        self.parked = parked;
    }

    /// All hypotheses, in no order that means anything.
    pub(crate) fn leaves(&self) -> impl Iterator<Item = &Leaf<A>> {
        self.queued().chain(&self.parked)
    }
}
