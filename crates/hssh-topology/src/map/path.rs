//! Paths: places joined by travels that go straight on, with their order and direction (section 2.1.3).

use serde::{Deserialize, Serialize};

use super::TopologicalMap;
use crate::ids::{MapOlp, PathId, PlaceId};

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
    pub(super) local_paths: u32,
    /// How many different places lie on it.
    places: u32,
    /// How many of its two ends are pending gateways; the others are closed. A circular path has no ends.
    pub(super) pending_ends: u32,
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
    /// A path of one local path.
    pub(super) fn single(pending_ends: u32) -> Self {
        PathRecord { local_paths: 1, places: 1, pending_ends, state: PathState::Open }
    }

    /// Whether it has at least two places.
    pub(super) fn is_long(&self) -> bool {
        self.places > 1
    }

    /// How many of the path's pending gateways are on a path with a single place.
    pub(super) fn loose_gateways(&self) -> u32 {
        if self.is_long() { 0 } else { self.pending_ends }
    }
}

/// How two paths became one, or one a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joined {
    into: PathId,
    before: PathRecord,
    absorbed: Option<Absorbed>,
}

/// A path that became part of another one.
#[derive(Clone, Copy, Debug)]
struct Absorbed {
    /// The end of it that was linked.
    at: MapOlp,
    from: PathId,
    /// Whether it ran the other way.
    flipped: bool,
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
        self.live_paths.iter().map(PathId::new)
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

    /// How many of the two ends of a path are pending gateways; the others are closed. A circular path has
    /// no ends.
    #[must_use]
    pub fn pending_ends(&self, path: PathId) -> u32 {
        self.paths[path.index()].pending_ends
    }

    /// Whether no link can change a path any more: whether both its ends are closed, or it has none.
    #[must_use]
    pub fn is_complete(&self, path: PathId) -> bool {
        self.paths[path.index()].pending_ends == 0
    }

    /// All paths with their places in order.
    #[must_use]
    pub fn courses(&self) -> Vec<Course> {
        let mut courses: Vec<Course> = self
            .paths()
            .map(|path| Course { path, circular: self.is_circular(path), downstream: Vec::new() })
            .collect();
        for start in (0..self.olps.len() as u32).map(MapOlp::new) {
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

    /// Makes the paths that end in the pending gateways `a` and `b` one path. The one with fewer
    /// local paths becomes part of the other.
    pub(super) fn join_paths(&mut self, a: MapOlp, b: MapOlp) -> Joined {
        let record = |end: MapOlp| self.paths[self.path(end).index()];
        if self.path(a) == self.path(b) {
            let (into, before) = (self.path(a), record(a));
            self.tally.loose_gateways -= before.loose_gateways();
            self.tally.long_circles += u32::from(before.is_long());
            let path = &mut self.paths[into.index()];
            (path.state, path.pending_ends) = (PathState::Circular, 0);
            return Joined { into, before, absorbed: None };
        }
        let (at, kept) = if record(a).local_paths >= record(b).local_paths { (b, a) } else { (a, b) };
        let (into, from) = (self.path(kept), self.path(at));
        let flipped = self.direction(kept) == self.direction(at);
        self.rename_path(at, into, flipped);

        let (before, lost) = (self.paths[into.index()], self.paths[from.index()]);
        let places = self.boundaries.absorb(into, from, flipped);
        let joined = PathRecord {
            local_paths: before.local_paths + lost.local_paths,
            places,
            pending_ends: before.pending_ends + lost.pending_ends - 2,
            state: PathState::Open,
        };
        self.paths[into.index()] = joined;
        self.paths[from.index()].state = PathState::Absorbed;
        self.live_paths.leave(from.number());
        self.tally.paths -= 1;
        self.tally.incidences -= u64::from(before.places + lost.places - places);
        self.tally.loose_gateways -= before.loose_gateways() + lost.loose_gateways();
        self.tally.loose_gateways += joined.loose_gateways();
        self.tally.long_paths -= u32::from(before.is_long()) + u32::from(lost.is_long());
        self.tally.long_paths += u32::from(joined.is_long());
        Joined { into, before, absorbed: Some(Absorbed { at, from, flipped }) }
    }

    /// Takes back [`join_paths`](Self::join_paths); its two gateways are pending again.
    pub(super) fn part_paths(&mut self, joined: Joined) {
        self.paths[joined.into.index()] = joined.before;
        if let Some(Absorbed { at, from, flipped }) = joined.absorbed {
            self.paths[from.index()].state = PathState::Open;
            self.live_paths.rejoin(from.number());
            self.rename_path(at, from, flipped);
        }
    }

    /// Gives every oriented local path of the path that ends in `end` another path and, if asked,
    /// the other direction.
    fn rename_path(&mut self, end: MapOlp, path: PathId, flip: bool) {
        self.walk_inward(end, |map, toward| {
            for olp in [toward, map.opposite(toward)] {
                let record = &mut map.olps[olp.index()];
                record.path = path;
                if flip {
                    record.direction = record.direction.reversed();
                }
            }
        });
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
