//! The boundary relations of a map counted anew from its paths, where it does not carry them along (section 2.1.3).

use std::borrow::Cow;
use std::ops::Range;

use super::boundaries::{Boundaries, Set, Sums};
use super::path::Course;
use super::topological_map::TopologicalMap;
use crate::ids::MapOlp;

/// Words of 64 places each that are counted together, so that a long map does not take the square of its places.
const BLOCK: usize = 16;

impl TopologicalMap {
    /// The places on, right of and left of each path.
    pub(super) fn boundaries(&self) -> Cow<'_, Boundaries> {
        match &self.boundaries {
            Some(carried) => Cow::Borrowed(carried),
            None => Cow::Owned(self.boundaries_within(&self.courses(), 0..self.words_of_places())),
        }
    }

    /// What the boundary relations add up to.
    pub(super) fn boundary_sums(&self) -> Sums {
        if let Some(carried) = &self.boundaries {
            return carried.sums();
        }
        let (courses, width) = (self.courses(), self.words_of_places());
        let mut sums = Sums::default();
        for start in (0..width).step_by(BLOCK) {
            sums += self.boundaries_within(&courses, start..width.min(start + BLOCK)).sums();
        }
        sums
    }

    /// The same sets, but of the places in those words only, which come first.
    fn boundaries_within(&self, courses: &[Course], words: Range<usize>) -> Boundaries {
        let mut boundaries = Boundaries::blank(self.paths.len(), words.len());
        let mut reached = vec![0; words.len()];
        let within = |olp: MapOlp| {
            let place = self.place(olp).index();
            words.contains(&(place / 64)).then(|| (place / 64 - words.start, 1 << (place % 64)))
        };
        for Course { path, circular, downstream } in courses {
            for (word, bit) in downstream.iter().filter_map(|&olp| within(olp)) {
                boundaries.set_mut(*path, Set::On)[word] |= bit;
            }
            if *circular {
                // Going either way from any place of it one comes by all of them.
                reached.copy_from_slice(boundaries.set_mut(*path, Set::On));
                for &olp in downstream {
                    self.see(&mut boundaries, olp, &reached);
                    self.see(&mut boundaries, self.opposite(olp), &reached);
                }
                continue;
            }
            let downstream = || downstream.iter().copied();
            let upstream = || downstream().map(|olp| self.opposite(olp));
            let there: [&mut dyn Iterator<Item = MapOlp>; 2] = [&mut upstream(), &mut downstream().rev()];
            for exits in there {
                reached.fill(0);
                for exit in exits {
                    self.see(&mut boundaries, exit, &reached);
                    if let Some((word, bit)) = within(exit) {
                        reached[word] |= bit;
                    }
                }
            }
        }
        boundaries.sum_up();
        boundaries
    }

    /// Whoever leaves a place by `exit` comes by the places reached: they are right or left of every other path through that place.
    fn see(&self, boundaries: &mut Boundaries, exit: MapOlp, reached: &[u64]) {
        for downstream in self.olps_of(self.place(exit)) {
            let Some(side) = self.side_of(exit, downstream) else { continue };
            let seen = boundaries.set_mut(self.path(downstream), side);
            seen.iter_mut().zip(reached).for_each(|(seen, reached)| *seen |= reached);
        }
    }

    /// How many words a set of places has: one at least.
    fn words_of_places(&self) -> usize {
        self.places.len().div_ceil(64).max(1)
    }
}
