//! How a map grows by places and links, and how that is taken back (sections 2.1.3 and 2.3).

use std::ops::Range;

use super::boundaries::Boundaries;
use super::record::{
    Absorbed, Change, Direction, Joined, OlpRecord, PathRecord, PathState, PlaceRecord, Tally,
};
use super::topological_map::{PendingGateway, TopologicalMap};
use crate::ids::{Dart, MapOlp, PathId, PlaceId, StarId};
use crate::star::Star;

impl TopologicalMap {
    /// Adds a place with that star, its gateways pending, each of its local paths a path of its own.
    pub fn add_place(&mut self, id: StarId, star: &Star) -> PlaceId {
        let place = PlaceId::new(self.places.len() as u32);
        let first = self.olps.len() as u32;
        self.history.push(Change::Place { tally: self.tally });
        self.places.push(PlaceRecord { star: id, first });
        if let Some(boundaries) = &mut self.boundaries {
            boundaries.make_room(self.places.len());
        }

        let mut dart = self.graph.dart_count();
        self.graph.add_vertex(star.gateways().count() as u32);
        for olp in star.olps() {
            let here = MapOlp::new(first + olp.number());
            let opposite = MapOlp::new(first + star.opposite(olp).number());
            let is_new_path = here < opposite;
            let (path, direction) = if is_new_path {
                let ends = [olp, star.opposite(olp)];
                let pending = ends.iter().filter(|&&end| star.is_travelable(end)).count();
                (self.add_path(place, pending as u32), Direction::Downstream)
            } else {
                (self.olps[opposite.index()].path, Direction::Upstream)
            };
            let travelable = star.is_travelable(olp).then(|| {
                self.gateways.push(here);
                dart += 1;
                Dart::new(dart - 1)
            });
            self.tally.closed_ends += u32::from(travelable.is_none());
            self.tally.loose_gateways += u32::from(travelable.is_some());
            self.olps.push(OlpRecord { place, opposite, link: here, dart: travelable, path, direction });
        }
        place
    }

    fn add_path(&mut self, place: PlaceId, pending_ends: u32) -> PathId {
        let path = PathId::new(self.paths.len() as u32);
        self.paths.push(PathRecord::single(pending_ends));
        self.live_paths.push();
        if let Some(boundaries) = &mut self.boundaries {
            boundaries.push_path(place);
        }
        self.tally.paths += 1;
        self.tally.incidences += 1;
        path
    }

    /// Links two pending gateways: they become one edge, and their two paths one path.
    ///
    /// The two are different and pending in this map.
    pub fn link(&mut self, a: PendingGateway, b: PendingGateway) {
        let (edges, a, b) = ((a.edge, b.edge), a.olp, b.olp);
        debug_assert!(a != b, "a link has two ends");
        debug_assert!(self.is_pending(a) && self.is_pending(b), "a stale pending gateway");
        let tally = self.tally;
        let boundaries = self.boundaries.as_ref().map(Boundaries::mark).unwrap_or_default();
        if self.boundaries.is_none() {
            // They are counted anew when somebody asks.
        } else if self.path(a) == self.path(b) {
            self.see_path_from_itself(a);
        } else {
            self.see_path_beyond(a, self.path(b));
            self.see_path_beyond(b, self.path(a));
        }

        let link = self.graph.link(edges.0, edges.1);
        let joined = self.join_paths(a, b);
        self.olps[a.index()].link = b;
        self.olps[b.index()].link = a;
        self.tally.links += 1;
        self.history.push(Change::Link { a, b, link, tally, boundaries, joined });
    }

    /// Takes back the last [`add_place`](Self::add_place) or [`link`](Self::link). Nothing happens
    /// to an empty map.
    pub fn retract(&mut self) {
        match self.history.pop() {
            None => {}
            Some(Change::Place { tally }) => self.remove_last_place(tally),
            Some(Change::Link { a, b, link, tally, boundaries, joined }) => {
                self.olps[a.index()].link = a;
                self.olps[b.index()].link = b;
                self.part_paths(joined);
                if let Some(carried) = &mut self.boundaries {
                    carried.restore(boundaries);
                }
                self.graph.unlink(link);
                self.tally = tally;
            }
        }
    }

    fn remove_last_place(&mut self, tally: Tally) {
        let Some(PlaceRecord { first, .. }) = self.places.pop() else { return };
        self.graph.remove_last_vertex();
        self.gateways.truncate(self.graph.dart_count() as usize);
        let paths = self.paths.len() - (self.olps.len() - first as usize) / 2;
        self.olps.truncate(first as usize);
        (paths..self.paths.len()).for_each(|_| self.live_paths.pop());
        self.paths.truncate(paths);
        if let Some(boundaries) = &mut self.boundaries {
            boundaries.truncate(paths);
        }
        self.tally = tally;
    }

    /// The paths that cross the path ending in `end` see, beyond `end`, the places of `path`.
    pub(super) fn see_path_beyond(&mut self, end: MapOlp, path: PathId) {
        let Some(words) = self.boundaries.as_ref().map(|boundaries| boundaries.span(path)) else { return };
        self.walk_inward(end, |map, toward| map.see_along(toward, path, &words));
    }

    /// A path becomes circular: going either way from any of its places one comes by all of them.
    pub(super) fn see_path_from_itself(&mut self, end: MapOlp) {
        let path = self.path(end);
        let Some(words) = self.boundaries.as_ref().map(|boundaries| boundaries.span(path)) else { return };
        self.walk_inward(end, |map, toward| {
            map.see_along(toward, path, &words);
            map.see_along(map.opposite(toward), path, &words);
        });
    }

    /// Whoever leaves the place of `exit` by `exit` now comes by the places of `reached`: they are
    /// right or left of every other path through that place. The places are in those words of the set.
    fn see_along(&mut self, exit: MapOlp, reached: PathId, words: &Range<usize>) {
        for downstream in self.olps_of(self.place(exit)) {
            let side = self.side_of(exit, downstream);
            if let (Some(side), Some(boundaries)) = (side, &mut self.boundaries) {
                boundaries.gain(self.olps[downstream.index()].path, side, reached, words.clone());
            }
        }
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
        let shared = if self.boundaries.is_some() { 0 } else { self.shared_places(at, into) };
        self.rename_path(at, into, flipped);

        let (before, lost) = (self.paths[into.index()], self.paths[from.index()]);
        let places = match &mut self.boundaries {
            Some(boundaries) => boundaries.absorb(into, from, flipped),
            None => before.places + lost.places - shared,
        };
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

    /// How many places of the path that ends in `end` lie on another one, too.
    fn shared_places(&mut self, end: MapOlp, other: PathId) -> u32 {
        let (path, mut shared) = (self.path(end), 0);
        self.walk_inward(end, |map, toward| {
            let on = |path: PathId| map.olps_of(map.place(toward)).find(|&olp| map.path(olp) == path);
            // A path that meets a place twice counts it once.
            let is_first = on(path).is_some_and(|first| first == toward || first == map.opposite(toward));
            shared += u32::from(is_first && on(other).is_some());
        });
        shared
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
}
