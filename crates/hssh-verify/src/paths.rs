//! The paths of a map, which places lie on them and to either side, and what preference counts of that.
//!
//! Everything is traced from scratch for one map at a time: along each path from end to end, then at each place of
//! a path into the ways on its right and on its left.

use crate::map::Map;

/// A path: a run of places joined by going straight through.
struct Path {
    /// Its passages: `from..to` in [`Paths::passages`].
    from: usize,
    to: usize,
    circular: bool,
    /// How many of its two ends are pending gateways.
    pending: usize,
}

/// The paths of one map. Used again for the next one, to spare allocations.
#[derive(Default)]
pub(crate) struct Paths {
    /// Words of a set of places.
    words: usize,
    paths: Vec<Path>,
    /// By passage: the end by which the path leaves the place onwards.
    passages: Vec<usize>,
    traced: Vec<bool>,
    /// By path: the places on it, right of it, left of it.
    on: Vec<u64>,
    right: Vec<u64>,
    left: Vec<u64>,
    /// By end: the places that one comes to going out by it, straight on.
    beyond: Vec<u64>,
    /// All places.
    all: Vec<u64>,
    /// Places on paths that can still grow.
    growing: Vec<u64>,
    /// Places on both sides of a growing path.
    torn: Vec<u64>,
}

fn insert(set: &mut [u64], place: usize) {
    set[place / 64] |= 1 << (place % 64);
}

fn clear(sets: &mut Vec<u64>, words: usize) {
    sets.clear();
    sets.resize(words, 0);
}

fn size(set: &[u64]) -> usize {
    set.iter().map(|word| word.count_ones() as usize).sum()
}

impl Paths {
    /// Traces all paths of a map.
    pub(crate) fn trace(&mut self, map: &Map) {
        self.words = map.places.len().div_ceil(64);
        self.paths.clear();
        self.passages.clear();
        self.on.clear();
        self.traced.clear();
        self.traced.resize(map.ends.len(), false);
        clear(&mut self.all, self.words);
        for place in 0..map.places.len() {
            insert(&mut self.all, place);
        }
        for (number, end) in map.ends.iter().enumerate() {
            if !self.traced[number] && end.link == crate::map::NONE {
                self.follow(map, number);
            }
        }
        for number in 0..map.ends.len() {
            if !self.traced[number] {
                self.follow(map, number);
            }
        }
    }

    /// Traces the path that begins by coming in by an end.
    fn follow(&mut self, map: &Map, start: usize) {
        let from = self.passages.len();
        let set = self.on.len();
        self.on.resize(set + self.words, 0);
        let mut back = start;
        let (circular, last) = loop {
            let forward = map.ends[back].opposite;
            (self.traced[back], self.traced[forward]) = (true, true);
            self.passages.push(forward);
            insert(&mut self.on[set..], map.ends[forward].place);
            back = map.ends[forward].link;
            if back == crate::map::NONE {
                break (false, forward);
            }
            if back == start {
                break (true, forward);
            }
        };
        let is_pending = |end: usize| usize::from(!circular && map.ends[end].is_pending());
        let pending = is_pending(start) + is_pending(last);
        self.paths.push(Path { from, to: self.passages.len(), circular, pending });
    }

    /// Finds the sides of all paths that were traced: q is right of P if at some place of P an end on its right
    /// leads out onto a path that comes to q.
    pub(crate) fn find_sides(&mut self, map: &Map) {
        let words = self.words;
        clear(&mut self.beyond, words * map.ends.len());
        for (number, path) in self.paths.iter().enumerate() {
            let passages = &self.passages[path.from..path.to];
            if path.circular {
                for &forward in passages {
                    for end in [forward, map.ends[forward].opposite] {
                        for word in 0..words {
                            self.beyond[end * words + word] = self.on[number * words + word];
                        }
                    }
                }
                continue;
            }
            for pair in passages.windows(2) {
                let (before, here) = (map.ends[pair[0]].opposite, map.ends[pair[1]].opposite);
                extend(&mut self.beyond, words, before, here, map.ends[pair[0]].place);
            }
            for pair in passages.windows(2).rev() {
                extend(&mut self.beyond, words, pair[1], pair[0], map.ends[pair[1]].place);
            }
        }
        clear(&mut self.right, words * self.paths.len());
        clear(&mut self.left, words * self.paths.len());
        for (number, path) in self.paths.iter().enumerate() {
            let sets = number * words..(number + 1) * words;
            for &forward in &self.passages[path.from..path.to] {
                let back = map.ends[forward].opposite;
                for (side, from, to) in [(&mut self.right, forward, back), (&mut self.left, back, forward)] {
                    let mut end = map.ends[from].next;
                    while end != to {
                        let beyond = &self.beyond[end * words..(end + 1) * words];
                        side[sets.clone()].iter_mut().zip(beyond).for_each(|(word, more)| *word |= more);
                        end = map.ends[end].next;
                    }
                }
            }
        }
    }

    /// f2: how many paths there are.
    pub(crate) fn count(&self) -> usize {
        self.paths.len()
    }

    /// The words of a path's sets: on it, right, left.
    fn sides(&self, path: usize) -> impl Iterator<Item = (u64, u64, u64)> + '_ {
        (path * self.words..(path + 1) * self.words)
            .map(|word| (self.on[word], self.right[word], self.left[word]))
    }

    /// f1: pairs of a path and a place off it that is on neither side or on both.
    pub(crate) fn undetermined(&self) -> usize {
        let of = |path| {
            self.sides(path).zip(&self.all).map(|((on, right, left), all)| !on & all & !(right ^ left))
        };
        (0..self.paths.len()).flat_map(of).map(|word| word.count_ones() as usize).sum()
    }

    /// How many of the undetermined pairs stay so however the map grows.
    pub(crate) fn undetermined_for_good(&mut self) -> usize {
        clear(&mut self.growing, self.words);
        clear(&mut self.torn, self.words);
        for (number, _) in self.paths.iter().enumerate().filter(|(_, path)| path.pending > 0) {
            let on = &self.on[number * self.words..];
            self.growing.iter_mut().zip(on).for_each(|(word, on)| *word |= on);
        }
        let mut count = 0;
        for (number, path) in self.paths.iter().enumerate() {
            if path.pending > 0 {
                for word in 0..self.words {
                    let at = number * self.words + word;
                    self.torn[word] |= self.right[at] & self.left[at] & !self.on[at];
                }
                continue;
            }
            let sealed = self.sides(number).zip(&self.growing).all(|((on, ..), growing)| on & growing == 0);
            for (((on, right, left), all), growing) in self.sides(number).zip(&self.all).zip(&self.growing) {
                let both = right & left & !on;
                let neither = all & !right & !left & !on;
                let lasting = if sealed { neither } else { neither & !growing };
                count += (both | lasting).count_ones() as usize;
            }
        }
        let torn = self.torn.iter().zip(&self.growing).map(|(torn, growing)| torn & !growing);
        count + torn.map(|word| word.count_ones() as usize).sum::<usize>()
    }

    /// f2': how many paths have at least two different places.
    pub(crate) fn long_count(&self) -> usize {
        (0..self.paths.len()).filter(|&path| self.is_long(path)).count()
    }

    /// What f2' does not fall below within so many travels more.
    pub(crate) fn long_bound(&self, travels: usize) -> usize {
        let long = || self.paths.iter().enumerate().filter(|(number, _)| self.is_long(*number));
        let ends: usize = long().map(|(_, path)| if path.circular { 0 } else { 2 }).sum();
        let pending: usize = long().map(|(_, path)| path.pending).sum();
        (ends - pending + pending.saturating_sub(2 * travels)).div_ceil(2)
    }

    fn places_on(&self, path: usize) -> &[u64] {
        &self.on[path * self.words..(path + 1) * self.words]
    }

    fn is_long(&self, path: usize) -> bool {
        size(self.places_on(path)) >= 2
    }

    /// Whether no two paths share two places and no three meet in three different places.
    pub(crate) fn are_perpendicular(&self) -> bool {
        let long: Vec<&[u64]> = (0..self.paths.len())
            .filter(|&path| self.is_long(path))
            .map(|path| self.places_on(path))
            .collect();
        // A set with one place, the one that two paths share, as its number.
        let shared = |a: &[u64], b: &[u64]| {
            let common: Vec<u64> = a.iter().zip(b).map(|(a, b)| a & b).collect();
            let first = common.iter().enumerate().find(|(_, word)| **word != 0);
            (size(&common), first.map(|(index, word)| index * 64 + word.trailing_zeros() as usize))
        };
        for (a, first) in long.iter().enumerate() {
            for (b, second) in long.iter().enumerate().skip(a + 1) {
                let (count, corner) = shared(first, second);
                if count > 1 {
                    return false;
                }
                let Some(corner) = corner else { continue };
                for third in &long[b + 1..] {
                    let (one, other) = (shared(first, third).1, shared(second, third).1);
                    if let (Some(one), Some(other)) = (one, other)
                        && (one != corner || other != corner)
                    {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Whether no place is on both sides of a path, and none on a path is beside it.
    pub(crate) fn have_consistent_sides(&self) -> bool {
        (0..self.paths.len())
            .flat_map(|path| self.sides(path))
            .all(|(on, right, left)| right & left == 0 && on & (right | left) == 0)
    }
}

/// What lies beyond `end` is what lies beyond `further`, and the place between them.
fn extend(beyond: &mut [u64], words: usize, further: usize, end: usize, between: usize) {
    for word in 0..words {
        beyond[end * words + word] = beyond[further * words + word];
    }
    insert(&mut beyond[end * words..(end + 1) * words], between);
}
