//! Which places lie on which side of which path, as far as a map tells (section 2.3.2).

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::boundaries::{Boundaries, Set};
use super::path::Course;
use super::record::{Direction, OlpRecord};
use super::topological_map::TopologicalMap;
use crate::ids::{MapOlp, PathId, PlaceId};

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

impl TopologicalMap {
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
        let boundaries = self.boundaries();
        let width = boundaries.width();
        let mut growing = vec![0; width];
        for path in self.paths().filter(|&path| !self.is_complete(path)) {
            for (growing, on) in growing.iter_mut().zip(boundaries.on(path)) {
                *growing |= on;
            }
        }
        let mut beside_growing = vec![0; width];
        let mut count = 0;
        for path in self.paths() {
            let complete = self.is_complete(path);
            let sealed = boundaries.on(path).iter().zip(&growing).all(|(on, growing)| on & growing == 0);
            for word in 0..width {
                let [on, right, left] = boundaries.triple(path, word);
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
        relation(&self.boundaries(), path, place)
    }

    /// The places on one side only of a path, by side.
    #[must_use]
    pub fn sides(&self, path: PathId) -> PathSides {
        let boundaries = self.boundaries();
        let lying =
            |side| self.places().filter(|&place| relation(&boundaries, path, place) == side).collect();
        PathSides { left: lying(BoundaryRelation::Left), right: lying(BoundaryRelation::Right) }
    }

    /// On which side of the path that `downstream` points along whoever leaves its place by `exit` is then; none if it does not
    /// point downstream, or if `exit` is of the same local path.
    pub(super) fn side_of(&self, exit: MapOlp, downstream: MapOlp) -> Option<Set> {
        let OlpRecord { opposite, direction, place, .. } = self.olps[downstream.index()];
        if direction != Direction::Downstream || exit == downstream || exit == opposite {
            return None;
        }
        let degree = self.olps_of(place).len() as u32;
        let clockwise = |to: MapOlp| self.local(downstream).turn_to(self.local(to), degree);
        Some(if clockwise(exit) < clockwise(opposite) { Set::Right } else { Set::Left })
    }

    /// Whether two paths have a place in common.
    #[must_use]
    pub fn paths_meet(&self, a: PathId, b: PathId) -> bool {
        let boundaries = self.boundaries();
        boundaries.on(a).iter().zip(boundaries.on(b)).any(|(a, b)| a & b != 0)
    }

    /// The same of the paths of two pending gateways.
    pub(crate) fn paths_of_gateways_meet(&self, a: MapOlp, b: MapOlp) -> bool {
        let local_paths = |end: MapOlp| self.paths[self.path(end).index()].local_paths;
        if self.boundaries.is_some() {
            return self.paths_meet(self.path(a), self.path(b));
        }
        let (shorter, other) = if local_paths(a) <= local_paths(b) { (a, b) } else { (b, a) };
        let other = self.path(other);
        self.follow(self.opposite(shorter)).into_iter().any(|olp| self.is_on(other, self.place(olp)))
    }

    /// The sets of places on those paths that are asked for.
    pub(crate) fn place_sets(&self, is_asked: impl Fn(PathId) -> bool) -> PlaceSets<'_> {
        if let Some(carried) = &self.boundaries {
            return PlaceSets(Sets::Carried(carried));
        }
        let mut counted = BTreeMap::new();
        for Course { path, downstream, .. } in self.courses().iter().filter(|course| is_asked(course.path)) {
            let mut set = vec![0; self.places.len().div_ceil(64)];
            for place in downstream.iter().map(|&olp| self.place(olp).index()) {
                set[place / 64] |= 1 << (place % 64);
            }
            counted.insert(*path, set);
        }
        PlaceSets(Sets::Counted(counted))
    }
}

/// The places on paths of a map: words of 64 places each, the lowest place in the lowest bit.
pub(crate) struct PlaceSets<'a>(Sets<'a>);

enum Sets<'a> {
    /// As the map carries them along.
    Carried(&'a Boundaries),
    /// Counted anew.
    Counted(BTreeMap<PathId, Vec<u64>>),
}

impl PlaceSets<'_> {
    /// Those on one of the paths asked for.
    pub(crate) fn on(&self, path: PathId) -> &[u64] {
        match &self.0 {
            Sets::Carried(carried) => carried.on(path),
            Sets::Counted(counted) => &counted[&path],
        }
    }
}

fn relation(boundaries: &Boundaries, path: PathId, place: PlaceId) -> BoundaryRelation {
    let is_in = |set| boundaries.contains(path, set, place);
    match (is_in(Set::On), is_in(Set::Right), is_in(Set::Left)) {
        (true, _, _) => BoundaryRelation::On,
        (_, true, true) => BoundaryRelation::Both,
        (_, true, false) => BoundaryRelation::Right,
        (_, false, true) => BoundaryRelation::Left,
        (_, false, false) => BoundaryRelation::Neither,
    }
}
