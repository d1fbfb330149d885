//! Paths: the local paths that consecutive travels straight through places join (section 2.1.3).

use std::collections::BTreeSet;

use crate::map::{End, Map};
use crate::star;

/// A path, in one of its two directions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Path {
    /// At every place along the path, in order, the end that looks ahead.
    pub headings: Vec<End>,
    /// Whether the last place leads on to the first.
    pub circular: bool,
}

impl Map<'_> {
    /// The paths: every local path lies on exactly one.
    #[must_use]
    pub fn paths(&self) -> Vec<Path> {
        let mut paths: Vec<Path> = Vec::new();
        for end in self.ends() {
            let opposite = self.opposite(end);
            let known = |path: &Path| path.headings.contains(&end) || path.headings.contains(&opposite);
            if !paths.iter().any(known) {
                paths.push(Path::through(self, end));
            }
        }
        paths
    }
}

impl Path {
    /// The path on which the local path of `heading` lies: back to its beginning, then forward.
    #[must_use]
    pub fn through(map: &Map, heading: End) -> Self {
        let back = walk(map, map.opposite(heading));
        let first = *back.headings.last().expect("a walk contains where it starts");
        walk(map, map.opposite(first))
    }

    /// The places along the path, in order; one that is met twice stands twice.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.headings.iter().map(|&(place, _)| place)
    }

    /// Whether the path meets a place.
    #[must_use]
    pub fn meets(&self, place: usize) -> bool {
        self.places().any(|other| other == place)
    }

    /// The places that are reached by leaving the path to its right.
    #[must_use]
    pub fn right(&self, map: &Map) -> BTreeSet<usize> {
        reached_to_the_right(map, self.headings.iter().copied())
    }

    /// The places that are reached by leaving the path to its left.
    #[must_use]
    pub fn left(&self, map: &Map) -> BTreeSet<usize> {
        reached_to_the_right(map, self.headings.iter().map(|&heading| map.opposite(heading)))
    }
}

/// Straight ahead from a place until the path ends, is pending, or comes round to its beginning.
fn walk(map: &Map, start: End) -> Path {
    let mut headings = vec![start];
    let mut here = start;
    while let Some(entry) = map.partner(here) {
        here = map.opposite(entry);
        if here == start {
            return Path { headings, circular: true };
        }
        headings.push(here);
    }
    Path { headings, circular: false }
}

fn reached_to_the_right(map: &Map, headings: impl Iterator<Item = End>) -> BTreeSet<usize> {
    let mut reached = BTreeSet::new();
    for (place, heading) in headings {
        for end in star::right_of(map.star(place), heading) {
            let way = walk(map, (place, end));
            reached.extend(way.places().skip(1));
            if way.circular {
                reached.insert(place);
            }
        }
    }
    reached
}
