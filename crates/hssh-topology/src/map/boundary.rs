//! Boundary relations: which places lie right and left of which paths (sections 2.1.3 and 2.3.3).
//!
//! A place is right of a path if some path leaves it by an oriented local path on its right-hand
//! side and reaches the place going that way; left likewise. Each path has three sets of places: on
//! it, right of it, left of it. They only grow, so that a link adds to them what it newly reaches.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::{Direction, PlaceRecord, TopologicalMap};
use crate::ids::{MapOlp, Olp, PathId, PlaceId};

/// How a place lies to a path, looking downstream.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum BoundaryRelation {
    /// The place lies on the path.
    On,
    /// It is on the right only.
    Right,
    /// It is on the left only.
    Left,
    /// It was reached on both sides.
    Both,
    /// Nothing is known.
    Neither,
}

/// The two regions that a path divides its surroundings into, as far as boundary relations tell.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct PathSides {
    /// Places left of the path, looking downstream.
    pub left: Vec<PlaceId>,
    /// Places right of it.
    pub right: Vec<PlaceId>,
}

/// The three sets of places that belong to a path.
#[derive(Clone, Copy)]
enum Set {
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
struct Sums {
    /// Off the path, on exactly one side.
    determined: u64,
    /// Off the path on both sides, or on the path and beside it.
    contradictory: u64,
}

/// A state to come back to.
#[derive(Clone, Copy, Debug)]
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
    fn range(&self, path: PathId, set: Set) -> std::ops::Range<usize> {
        let start = (path.index() * SETS + set as usize) * self.stride;
        start..start + self.stride
    }

    fn contains(&self, path: PathId, set: Set, place: PlaceId) -> bool {
        self.words[self.range(path, set)][place.index() / 64] >> (place.index() % 64) & 1 == 1
    }

    pub(super) fn is_on(&self, path: PathId, place: PlaceId) -> bool {
        self.contains(path, Set::On, place)
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

    pub(super) fn determined(&self) -> u64 {
        self.sums.determined
    }

    pub(super) fn contradictory(&self) -> u64 {
        self.sums.contradictory
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

    fn write(&mut self, path: PathId, set: Set, word: usize, value: u64) {
        let start = self.range(path, set).start;
        let old = std::mem::replace(&mut self.words[start + word], value);
        if old != value {
            self.changes.push(((start / self.stride) as u32, word as u32, old));
        }
    }

    /// The places on, right of and left of a path, in one word of each set.
    fn triple(&self, path: PathId, word: usize) -> [u64; SETS] {
        let at = self.range(path, Set::On).start + word;
        [self.words[at], self.words[at + self.stride], self.words[at + 2 * self.stride]]
    }

    /// One side of `path` gains the places on `gained`.
    fn gain(&mut self, path: PathId, side: Set, gained: PathId) {
        for word in 0..self.stride {
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

impl TopologicalMap {
    /// The paths that cross the path ending in `end` see, beyond `end`, the places of `path`.
    pub(super) fn see_path_beyond(&mut self, end: MapOlp, path: PathId) {
        self.walk_inward(end, |map, toward| map.see_along(toward, path));
    }

    /// A path becomes circular: going either way from any of its places one comes by all of them.
    pub(super) fn see_path_from_itself(&mut self, end: MapOlp) {
        let path = self.path(end);
        self.walk_inward(end, |map, toward| {
            map.see_along(toward, path);
            map.see_along(map.opposite(toward), path);
        });
    }

    /// Whoever leaves the place of `exit` by `exit` now comes by the places of `reached`: they are
    /// right or left of every other path through that place.
    fn see_along(&mut self, exit: MapOlp, reached: PathId) {
        let PlaceRecord { first, .. } = self.places[self.place(exit).index()];
        let local = |olp: MapOlp| Olp::new(olp.number() - first);
        let olps = self.olps_of(self.place(exit));
        let degree = olps.len() as u32;
        for downstream in olps {
            let record = self.olps[downstream.index()];
            let is_other_path = exit != downstream && exit != record.opposite;
            if record.direction == Direction::Downstream && is_other_path {
                let clockwise = |to: MapOlp| local(downstream).turn_to(local(to), degree);
                let is_right = clockwise(exit) < clockwise(record.opposite);
                let side = if is_right { Set::Right } else { Set::Left };
                self.boundaries.gain(record.path, side, reached);
            }
        }
    }

    /// How many pairs of a path and a place off the path will have no boundary relation, or both,
    /// however the map grows: f1 never falls below this number along a branch.
    ///
    /// A complete path keeps its places, and what is on both sides of it stays there. A place is
    /// newly reached from it only along a path that can still grow and comes to lead through the
    /// place, so that a pair without relation keeps none if no such path leads through the complete
    /// path, or none through the place. If a path can grow, several of them may become one, so
    /// that a place on both sides of any of them counts once; and only if no path through it can
    /// grow, or it might come to lie on that path.
    #[must_use]
    pub fn permanently_undetermined_boundary_count(&self) -> u64 {
        let width = self.boundaries.stride;
        let mut growing = vec![0; width];
        for path in self.paths().filter(|&path| !self.is_complete(path)) {
            for (growing, on) in growing.iter_mut().zip(self.boundaries.on(path)) {
                *growing |= on;
            }
        }
        let mut beside_growing = vec![0; width];
        let mut count = 0;
        for path in self.paths() {
            let complete = self.is_complete(path);
            let sealed = self.boundaries.on(path).iter().zip(&growing).all(|(on, growing)| on & growing == 0);
            for word in 0..width {
                let [on, right, left] = self.boundaries.triple(path, word);
                let (both, neither) = (right & left & !on, !(right | left | on) & self.all_places(word));
                if !complete {
                    beside_growing[word] |= both & !growing[word];
                } else if sealed {
                    count += (both | neither).count_ones();
                } else {
                    count += (both | (neither & !growing[word])).count_ones();
                }
            }
        }
        count += beside_growing.iter().map(|word| word.count_ones()).sum::<u32>();
        u64::from(count)
    }

    /// The places of the map in one word of a set of places.
    fn all_places(&self, word: usize) -> u64 {
        match self.places.len().saturating_sub(64 * word) {
            0 => 0,
            64.. => u64::MAX,
            places => (1 << places) - 1,
        }
    }

    /// How a place lies to a path, looking downstream.
    #[must_use]
    pub fn boundary_relation(&self, path: PathId, place: PlaceId) -> BoundaryRelation {
        let is_in = |set| self.boundaries.contains(path, set, place);
        match (is_in(Set::On), is_in(Set::Right), is_in(Set::Left)) {
            (true, _, _) => BoundaryRelation::On,
            (_, true, true) => BoundaryRelation::Both,
            (_, true, false) => BoundaryRelation::Right,
            (_, false, true) => BoundaryRelation::Left,
            (_, false, false) => BoundaryRelation::Neither,
        }
    }

    /// The places on one side only of a path, by side.
    #[must_use]
    pub fn sides(&self, path: PathId) -> PathSides {
        let lying = |relation| {
            self.places().filter(|&place| self.boundary_relation(path, place) == relation).collect()
        };
        PathSides { left: lying(BoundaryRelation::Left), right: lying(BoundaryRelation::Right) }
    }

    /// Whether two paths have a place in common.
    #[must_use]
    pub fn paths_meet(&self, a: PathId, b: PathId) -> bool {
        self.boundaries.on(a).iter().zip(self.boundaries.on(b)).any(|(a, b)| a & b != 0)
    }

    /// The set of places on a path, as words of 64 places each, the lowest place in the lowest bit.
    pub(crate) fn place_set(&self, path: PathId) -> &[u64] {
        self.boundaries.on(path)
    }
}
