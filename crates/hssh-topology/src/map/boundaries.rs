//! The places on, right of and left of each path, as sets of bits (sections 2.1.3 and 2.3.3).
//!
//! A place is right of a path if some path leaves it by an oriented local path on its right-hand
//! side and reaches the place going that way; left likewise. Each path has three sets of places: on
//! it, right of it, left of it. They only grow, so that a link adds to them what it newly reaches.

use std::collections::BTreeSet;
use std::ops::{AddAssign, Range};

use crate::ids::{PathId, PlaceId};

/// The three sets of places that belong to a path.
#[derive(Clone, Copy)]
pub(super) enum Set {
    On = 0,
    Right = 1,
    Left = 2,
}

const SETS: usize = 3;

/// For each path three bit sets over the places, and the sums over all paths.
#[derive(Clone, Debug)]
pub(super) struct Boundaries {
    /// Words per set.
    stride: usize,
    words: Vec<u64>,
    /// Words that changed, with what they were: which set, which word of it, the old value.
    changes: Vec<(u32, u32, u64)>,
    sums: Sums,
}

/// Pairs ⟨path, place⟩, summed over the paths that are not absorbed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Sums {
    /// Off the path, on exactly one side.
    pub(super) determined: u64,
    /// Off the path on both sides, or on the path and beside it.
    pub(super) contradictory: u64,
}

/// A state to come back to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mark {
    changes: usize,
    sums: Sums,
}

impl Default for Boundaries {
    fn default() -> Self {
        Boundaries { stride: 1, words: Vec::new(), changes: Vec::new(), sums: Sums::default() }
    }
}

impl Boundaries {
    fn range(&self, path: PathId, set: Set) -> Range<usize> {
        let start = (path.index() * SETS + set as usize) * self.stride;
        start..start + self.stride
    }

    pub(super) fn contains(&self, path: PathId, set: Set, place: PlaceId) -> bool {
        self.words[self.range(path, set)][place.index() / 64] >> (place.index() % 64) & 1 == 1
    }

    /// Makes one bit wrong.
    #[cfg(test)]
    pub(super) fn flip(&mut self, path: PathId, set: Set, place: PlaceId) {
        let start = self.range(path, set).start;
        self.words[start + place.index() / 64] ^= 1 << (place.index() % 64);
    }

    /// The set of places on a path, as words.
    pub(super) fn on(&self, path: PathId) -> &[u64] {
        &self.words[self.range(path, Set::On)]
    }

    /// The places on, right of and left of a path, spelled out.
    pub(super) fn sets(&self, path: PathId) -> [BTreeSet<PlaceId>; SETS] {
        let places = || (0..64 * self.stride as u32).map(PlaceId::new);
        [Set::On, Set::Right, Set::Left]
            .map(|set| places().filter(|&place| self.contains(path, set, place)).collect())
    }

    /// What the relations add up to.
    pub(super) fn sums(&self) -> Sums {
        self.sums
    }

    /// How many words a set has.
    pub(super) fn width(&self) -> usize {
        self.stride
    }

    /// Makes the sets wide enough for that many places.
    pub(super) fn make_room(&mut self, places: usize) {
        while places > self.stride * 64 {
            let narrow = std::mem::take(&mut self.words);
            let widen = |set: &[u64]| set.iter().copied().chain(vec![0; self.stride]).collect::<Vec<_>>();
            self.words = narrow.chunks_exact(self.stride).flat_map(widen).collect();
            self.stride *= 2;
        }
    }

    /// Adds a path with one place on it.
    pub(super) fn push_path(&mut self, place: PlaceId) {
        let start = self.words.len();
        self.words.resize(start + SETS * self.stride, 0);
        self.words[start + place.index() / 64] = 1 << (place.index() % 64);
    }

    /// Forgets the paths from number `paths` on.
    pub(super) fn truncate(&mut self, paths: usize) {
        self.words.truncate(paths * SETS * self.stride);
    }

    pub(super) fn mark(&self) -> Mark {
        Mark { changes: self.changes.len(), sums: self.sums }
    }

    pub(super) fn restore(&mut self, mark: Mark) {
        for (set, word, old) in self.changes.drain(mark.changes..).rev() {
            self.words[set as usize * self.stride + word as usize] = old;
        }
        self.sums = mark.sums;
    }

    /// Sets of so many words for so many paths, all of them empty.
    pub(super) fn blank(paths: usize, words: usize) -> Self {
        Boundaries { stride: words, words: vec![0; paths * SETS * words], ..Boundaries::default() }
    }

    /// The words of one set.
    pub(super) fn set_mut(&mut self, path: PathId, set: Set) -> &mut [u64] {
        let range = self.range(path, set);
        &mut self.words[range]
    }

    /// Counts the sums anew. Paths that are absorbed have empty sets.
    pub(super) fn sum_up(&mut self) {
        self.sums = Sums::default();
        for sets in self.words.chunks_exact(SETS * self.stride) {
            for word in 0..self.stride {
                let triple = [0, 1, 2].map(|set| sets[set * self.stride + word]);
                self.sums.replace(&[], triple);
            }
        }
    }

    fn write(&mut self, path: PathId, set: Set, word: usize, value: u64) {
        let start = self.range(path, set).start;
        let old = std::mem::replace(&mut self.words[start + word], value);
        if old != value {
            self.changes.push(((start / self.stride) as u32, word as u32, old));
        }
    }

    /// The places on, right of and left of a path, in one word of each set.
    pub(super) fn triple(&self, path: PathId, word: usize) -> [u64; SETS] {
        let at = self.range(path, Set::On).start + word;
        [self.words[at], self.words[at + self.stride], self.words[at + 2 * self.stride]]
    }

    /// From which word to which there are places on a path.
    pub(super) fn span(&self, path: PathId) -> Range<usize> {
        let on = self.on(path);
        let is_any = |&word: &u64| word != 0;
        let first = on.iter().position(is_any).unwrap_or(on.len());
        first..on.iter().rposition(is_any).map_or(first, |last| last + 1)
    }

    /// One side of `path` gains the places on `gained`, which are in those words.
    pub(super) fn gain(&mut self, path: PathId, side: Set, gained: PathId, words: Range<usize>) {
        for word in words {
            let old = self.triple(path, word);
            let mut new = old;
            new[side as usize] |= self.on(gained)[word];
            if new != old {
                self.sums.replace(&[old], new);
                self.write(path, side, word, new[side as usize]);
            }
        }
    }

    /// `into` takes over the sets of `from`, whose sides are swapped if it runs the other way; how
    /// many places are on it then.
    pub(super) fn absorb(&mut self, into: PathId, from: PathId, flipped: bool) -> u32 {
        let mut places = 0;
        for word in 0..self.stride {
            let (kept, lost) = (self.triple(into, word), self.triple(from, word));
            let [on, right, left] = lost;
            let [right, left] = if flipped { [left, right] } else { [right, left] };
            let joined = [kept[0] | on, kept[1] | right, kept[2] | left];
            self.sums.replace(&[kept, lost], joined);
            for (set, value) in [Set::On, Set::Right, Set::Left].into_iter().zip(joined) {
                self.write(into, set, word, value);
            }
            places += joined[0].count_ones();
        }
        places
    }
}

impl AddAssign for Sums {
    fn add_assign(&mut self, other: Sums) {
        self.determined += other.determined;
        self.contradictory += other.contradictory;
    }
}

impl Sums {
    /// Counts `new` in place of all of `old`.
    fn replace(&mut self, old: &[[u64; SETS]], new: [u64; SETS]) {
        let determined = |[on, right, left]: [u64; SETS]| u64::from(((right ^ left) & !on).count_ones());
        let contradictory =
            |[on, right, left]: [u64; SETS]| u64::from(((right & left) | (on & (right | left))).count_ones());
        self.determined += determined(new);
        self.contradictory += contradictory(new);
        for &old in old {
            self.determined -= determined(old);
            self.contradictory -= contradictory(old);
        }
    }
}
