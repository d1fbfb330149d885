//! Paths: places joined by travels that go straight on, with their order and direction (section 2.1.3).

use serde::{Deserialize, Serialize};

use super::{Absorbed, MapOlp, PlaceId, TopologicalMap};

/// A path of a map. When two paths become one, the one with more places gives its identity.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PathId(pub u32);

impl PathId {
    /// The path as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The two directions along a path.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Direction {
    /// `+`
    Downstream,
    /// `-`
    Upstream,
}

impl Direction {
    /// The other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Direction::Downstream => Direction::Upstream,
            Direction::Upstream => Direction::Downstream,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct PathRecord {
    /// How many local paths form it.
    local_paths: u32,
    /// How many different places lie on it.
    places: u32,
    pub(super) state: PathState,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum PathState {
    /// A path with two ends.
    Open,
    /// A path that returns into itself.
    Circular,
    /// It became a part of another path.
    Absorbed,
}

impl PathRecord {
    pub(super) fn single() -> Self {
        PathRecord { local_paths: 1, places: 1, state: PathState::Open }
    }
}

/// A path from its upstream to its downstream end.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Course {
    /// The path.
    pub path: PathId,
    /// Whether it returns into itself, so that the first place follows the last one.
    pub circular: bool,
    /// At each place in downstream order: the oriented local path that points downstream.
    pub downstream: Vec<MapOlp>,
}

impl TopologicalMap {
    /// The path that an oriented local path lies on.
    #[must_use]
    pub fn path(&self, olp: MapOlp) -> PathId {
        self.olps[olp.index()].path
    }

    /// Which way along its path an oriented local path points.
    #[must_use]
    pub fn direction(&self, olp: MapOlp) -> Direction {
        self.olps[olp.index()].direction
    }

    /// The paths of the map, in order of creation.
    pub fn paths(&self) -> impl Iterator<Item = PathId> + '_ {
        let ids = (0..self.paths.len() as u32).map(PathId);
        ids.filter(|path| self.paths[path.index()].state != PathState::Absorbed)
    }

    /// How many different places lie on a path.
    #[must_use]
    pub fn places_on_path(&self, path: PathId) -> u32 {
        self.paths[path.index()].places
    }

    /// Whether a path returns into itself.
    #[must_use]
    pub fn is_circular(&self, path: PathId) -> bool {
        self.paths[path.index()].state == PathState::Circular
    }

    /// The end of a path across from the end `olp`; for an oriented local path at no end it means
    /// nothing.
    #[must_use]
    pub fn far_end(&self, olp: MapOlp) -> MapOlp {
        self.olps[olp.index()].far_end
    }

    /// All paths with their places in order.
    #[must_use]
    pub fn courses(&self) -> Vec<Course> {
        let mut courses: Vec<Course> = self
            .paths()
            .map(|path| Course { path, circular: self.is_circular(path), downstream: Vec::new() })
            .collect();
        for start in (0..self.olps.len() as u32).map(MapOlp) {
            if self.direction(start) != Direction::Downstream {
                continue;
            }
            let path = self.path(start);
            let course = courses.binary_search_by_key(&path, |course| course.path);
            let course = &mut courses[course.expect("every oriented local path is on a live path")];
            let is_upstream_end = self.linked(self.opposite(start)).is_none();
            if course.downstream.is_empty() && (is_upstream_end || course.circular) {
                course.downstream = self.follow(start);
            }
        }
        courses
    }

    /// The oriented local paths from `start` on that point the same way along its path, up to the
    /// end of the path, or once around.
    #[must_use]
    pub fn follow(&self, start: MapOlp) -> Vec<MapOlp> {
        let mut course = vec![start];
        let mut here = start;
        while let Some(entry) = self.linked(here) {
            here = self.opposite(entry);
            if here == start {
                break;
            }
            course.push(here);
        }
        course
    }

    /// Pending gateways at the ends of the path that ends in `end`, if it has a single place.
    pub(super) fn loose_gateways_of_path_ending(&self, end: MapOlp) -> u32 {
        let path = self.paths[self.path(end).index()];
        if path.places > 1 || path.state == PathState::Circular {
            return 0;
        }
        u32::from(self.is_pending(end)) + u32::from(self.is_pending(self.far_end(end)))
    }

    /// Makes the paths that end in the pending gateways `a` and `b` one path. The one with fewer
    /// local paths becomes part of the other; `None` if the two are the ends of one path.
    pub(super) fn join_paths(&mut self, a: MapOlp, b: MapOlp) -> Option<Absorbed> {
        if self.path(a) == self.path(b) {
            let path = self.path(a);
            self.paths[path.index()].state = PathState::Circular;
            return None;
        }
        let size = |end: MapOlp| self.paths[self.path(end).index()].local_paths;
        let (kept, at) = if size(a) >= size(b) { (a, b) } else { (b, a) };
        let (into, from) = (self.path(kept), self.path(at));
        let flipped = self.direction(kept) == self.direction(at);
        let absorbed = Absorbed { into, at, from, flipped, before: self.paths[into.index()] };
        self.rename_path(at, into, flipped);

        let (end, other_end) = (self.far_end(a), self.far_end(b));
        self.olps[end.index()].far_end = other_end;
        self.olps[other_end.index()].far_end = end;
        self.paths[from.index()].state = PathState::Absorbed;
        let (kept, lost) = (absorbed.before, self.paths[from.index()]);
        let places = self.boundaries.absorb(into, from, flipped);
        let joined = &mut self.paths[into.index()];
        joined.local_paths += lost.local_paths;
        joined.places = places;
        self.tally.paths -= 1;
        self.tally.incidences -= u64::from(kept.places + lost.places - places);
        self.tally.loose_gateways += self.loose_gateways_of_path_ending(end);
        Some(absorbed)
    }

    /// Takes back [`join_paths`](Self::join_paths) at the gateways `a` and `b`, which are pending again.
    pub(super) fn part_paths(&mut self, a: MapOlp, b: MapOlp, absorbed: Option<Absorbed>) {
        let Some(Absorbed { into, at, from, flipped, before }) = absorbed else {
            let path = self.path(a);
            self.paths[path.index()].state = PathState::Open;
            return;
        };
        for end in [a, b] {
            let far_end = self.far_end(end);
            self.olps[far_end.index()].far_end = end;
        }
        self.paths[into.index()] = before;
        self.paths[from.index()].state = PathState::Open;
        self.rename_path(at, from, flipped);
    }

    /// Gives every oriented local path of the path that ends in `end` another path and, if asked,
    /// the other direction.
    fn rename_path(&mut self, end: MapOlp, path: PathId, flip: bool) {
        let mut toward = end;
        loop {
            let away = self.opposite(toward);
            for olp in [toward, away] {
                let record = &mut self.olps[olp.index()];
                record.path = path;
                record.direction = if flip { record.direction.reversed() } else { record.direction };
            }
            match self.linked(away) {
                Some(next) => toward = next,
                None => return,
            }
        }
    }

    /// Calls `visit` at each place of the path that ends in `end`, from `end` inward, with the
    /// oriented local path that points towards `end`.
    pub(super) fn walk_inward(&mut self, end: MapOlp, mut visit: impl FnMut(&mut Self, MapOlp)) {
        let mut toward = end;
        loop {
            visit(self, toward);
            match self.linked(self.opposite(toward)) {
                Some(next) => toward = next,
                None => return,
            }
        }
    }

    /// The places on a path.
    pub fn places_of_path(&self, path: PathId) -> impl Iterator<Item = PlaceId> + '_ {
        self.places().filter(move |&place| self.boundaries.is_on(path, place))
    }
}
