//! The true paths of a world: what one follows by going straight through places (section 2.3.4).

use std::collections::BTreeSet;

use crate::world::{PlaceId, World, WorldOlp};

/// A path of the world: the places met by always leaving opposite to where one came in.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Path {
    /// The places in order; a place occurs as often as the path runs through it.
    pub places: Vec<PlaceId>,
    /// Whether the last place is followed by the first again.
    pub circular: bool,
}

impl World {
    /// All paths. Every local path of every place lies on exactly one.
    #[must_use]
    pub fn paths(&self) -> Vec<Path> {
        let mut seen = BTreeSet::new();
        let mut paths = Vec::new();
        for place in self.place_ids() {
            for olp in self.place(place).star.olps() {
                let here = WorldOlp { place, olp };
                if seen.contains(&here) {
                    continue;
                }
                let (start, circular) = self.start_of_path(here);
                let along = self.follow(start);
                seen.extend(along.iter().flat_map(|&end| [end, self.opposite(end)]));
                paths.push(Path { places: along.iter().map(|end| end.place).collect(), circular });
            }
        }
        paths
    }

    /// Whether no path is circular and none meets a place twice, as mappers commonly assume.
    #[must_use]
    pub fn has_simple_paths(&self) -> bool {
        self.paths().iter().all(|path| {
            let places: BTreeSet<_> = path.places.iter().collect();
            !path.circular && places.len() == path.places.len()
        })
    }

    /// Looking along `end`: the first end of its path that looks the same way, and whether the
    /// path is circular (then any end is the first).
    fn start_of_path(&self, end: WorldOlp) -> (WorldOlp, bool) {
        let backwards = self.follow(self.opposite(end));
        let last = backwards[backwards.len() - 1];
        let circular = self.neighbor(last).is_some();
        (if circular { end } else { self.opposite(last) }, circular)
    }

    /// The ends met by looking along `start` and going straight on, up to the path's end or back
    /// to the start.
    fn follow(&self, start: WorldOlp) -> Vec<WorldOlp> {
        let mut along = vec![start];
        let mut here = start;
        while let Some(far) = self.neighbor(here) {
            here = self.opposite(far);
            if here == start {
                break;
            }
            along.push(here);
        }
        along
    }

    fn opposite(&self, end: WorldOlp) -> WorldOlp {
        WorldOlp { olp: self.place(end.place).star.opposite(end.olp), ..end }
    }
}
