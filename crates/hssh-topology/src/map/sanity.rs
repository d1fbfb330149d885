//! Everything that a map carries along, counted anew from its places and links (sections 2.1.3 and 2.3.2).

use std::collections::BTreeSet;

use super::record::{Direction, PathState};
use super::topological_map::TopologicalMap;
use crate::ids::{MapOlp, PathId, PlaceId};
use crate::sanity::{Unsound, agrees, holds};

/// The places on a path, right of it and left of it.
type Surroundings = [BTreeSet<PlaceId>; 3];

impl TopologicalMap {
    /// Recounts everything that is carried along, from the definitions. For tests and fuzzing.
    ///
    /// # Errors
    /// With the first thing that is not so.
    pub fn sanity_check(&self) -> Result<(), Unsound> {
        self.graph.sanity_check()?;
        self.check_places()?;
        self.check_links()?;
        self.check_paths()?;
        self.check_boundaries()?;
        self.check_tally()
    }

    fn all_olps(&self) -> impl Iterator<Item = MapOlp> + use<> {
        (0..self.olp_count()).map(MapOlp::new)
    }

    /// Oriented local paths are numbered place by place and go in pairs; gateways are the darts, in order.
    fn check_places(&self) -> Result<(), Unsound> {
        agrees("vertices", self.graph.vertex_count(), self.place_count())?;
        let mut olps = Vec::new();
        let mut gateways = Vec::new();
        for place in self.places() {
            let around: Vec<MapOlp> = self.olps_of(place).collect();
            for (position, &olp) in around.iter().enumerate() {
                agrees(("place of", olp), self.place(olp), place)?;
                agrees(("position of", olp), self.local(olp).index(), position)?;
                agrees(("its position", olp), self.olp(place, self.local(olp)), olp)?;
                let opposite = self.opposite(olp);
                holds((olp, "is not its opposite"), opposite != olp)?;
                agrees(("opposite of opposite of", olp), self.opposite(opposite), olp)?;
                agrees(("place of opposite of", olp), self.place(opposite), place)?;
            }
            let travelable: Vec<MapOlp> =
                around.iter().copied().filter(|&olp| self.dart(olp).is_some()).collect();
            let vertex = self.graph.vertices().nth(place.index());
            let darts = vertex.map(|vertex| self.graph.darts_of(vertex).collect::<Vec<_>>());
            agrees(("darts of", place), travelable.iter().map(|&olp| self.dart(olp)).collect(), darts)?;
            gateways.extend(travelable);
            olps.extend(around);
        }
        agrees("oriented local paths", self.all_olps().collect(), olps)?;
        agrees("gateways", &self.gateways, &gateways)
    }

    /// Links are the edges of the graph.
    fn check_links(&self) -> Result<(), Unsound> {
        let mut links = BTreeSet::new();
        for olp in self.all_olps() {
            let far = self.linked(olp);
            let rev = self.dart(olp).and_then(|dart| self.graph.rev(dart));
            agrees(("link of", olp), far, rev.map(|rev| self.gateway(rev)))?;
            agrees(("is pending", olp), self.is_pending(olp), self.dart(olp).is_some() && far.is_none())?;
            agrees(
                ("pending", olp),
                self.pending(olp).map(|gateway| gateway.olp()),
                self.is_pending(olp).then_some(olp),
            )?;
            if let Some(far) = far {
                agrees(("link back to", olp), self.linked(far), Some(olp))?;
                links.insert((olp.min(far), olp.max(far)));
            }
        }
        agrees("links", self.links().collect(), links.iter().copied().collect::<Vec<_>>())?;
        agrees("number of links", self.link_count() as usize, links.len())?;
        agrees("changes", self.history.len(), self.places.len() + links.len())?;
        let pending: Vec<MapOlp> = self.all_olps().filter(|&olp| self.is_pending(olp)).collect();
        agrees("pending gateways", self.pending_gateways().map(|gateway| gateway.olp()).collect(), pending)
    }

    /// Every local path is on one path, the live one that straight travels from it reach.
    fn check_paths(&self) -> Result<(), Unsound> {
        let mut paths = BTreeSet::new();
        let mut local_paths = 0;
        for start in self.all_olps().filter(|&olp| self.direction(olp) == Direction::Downstream) {
            let path = self.path(start);
            if !paths.insert(path) {
                continue;
            }
            let (course, circular) = self.straight_through(start);
            for &olp in &course {
                let opposite = self.opposite(olp);
                agrees(("path of", olp), self.path(olp), path)?;
                agrees(("path of", opposite), self.path(opposite), path)?;
                agrees(("direction of", olp), self.direction(olp), Direction::Downstream)?;
                agrees(("direction of", opposite), self.direction(opposite), Direction::Upstream)?;
            }
            local_paths += course.len();
            let record = self.paths[path.index()];
            let state = if circular { PathState::Circular } else { PathState::Open };
            agrees(("state of", path), record.state, state)?;
            agrees(("local paths of", path), record.local_paths as usize, course.len())?;
            let places: BTreeSet<PlaceId> = course.iter().map(|&olp| self.place(olp)).collect();
            agrees(("number of places on", path), self.places_on_path(path) as usize, places.len())?;
            let ends = [self.opposite(course[0]), course[course.len() - 1]];
            let pending = ends.iter().filter(|&&olp| self.is_pending(olp)).count();
            agrees(("pending ends of", path), self.pending_ends(path) as usize, pending)?;
            agrees(("is complete", path), self.is_complete(path), pending == 0)?;
        }
        // Paths were found by their names: that no local path was missed shows that no two share one.
        agrees("local paths on paths", 2 * local_paths, self.olps.len())?;
        agrees("live paths", self.paths().collect(), paths.iter().copied().collect::<Vec<_>>())?;
        agrees("number of paths", self.path_count() as usize, paths.len())?;
        let absorbed = self.paths.iter().filter(|record| record.state == PathState::Absorbed).count();
        agrees("absorbed paths", absorbed, self.paths.len() - paths.len())
    }

    /// The oriented local paths along the path of `start` that point the way of `start`, from one end to
    /// the other or once around; and whether it comes around.
    fn straight_through(&self, start: MapOlp) -> (Vec<MapOlp>, bool) {
        let (back, circular) = self.ahead(self.opposite(start));
        let first = if circular { start } else { self.opposite(back[back.len() - 1]) };
        (self.ahead(first).0, circular)
    }

    /// From `start` straight ahead: the oriented local paths that look ahead, and whether the way comes
    /// around to `start`.
    fn ahead(&self, start: MapOlp) -> (Vec<MapOlp>, bool) {
        let mut way = vec![start];
        let mut here = start;
        while let Some(entry) = self.linked(here) {
            here = self.opposite(entry);
            if here == start {
                return (way, true);
            }
            way.push(here);
        }
        (way, false)
    }

    /// The sets of places of each path, and the sums over all of them.
    fn check_boundaries(&self) -> Result<(), Unsound> {
        let (mut incidences, mut undetermined, mut contradictory) = (0, 0, 0);
        let boundaries = self.boundaries();
        for path in self.paths() {
            let surroundings = self.surroundings(path);
            agrees(("sets of", path), boundaries.sets(path), surroundings.clone())?;
            agrees(("places on", path), self.places_of_path(path).collect(), surroundings[0].clone())?;
            for place in self.places() {
                let [on, right, left] = [0, 1, 2].map(|set| surroundings[set].contains(&place));
                incidences += u64::from(on);
                undetermined += u64::from(!on && right == left);
                contradictory += u64::from(right && left || on && (right || left));
            }
        }
        agrees("incidences", self.tally.incidences, incidences)?;
        agrees("undetermined boundaries", self.undetermined_boundary_count(), undetermined)?;
        agrees("contradictory boundaries", self.contradictory_boundary_count(), contradictory)
    }

    /// "Right" by its definition: some path leaves this one at a place of it by an oriented local path on
    /// the right-hand side, and reaches the place going that way.
    fn surroundings(&self, path: PathId) -> Surroundings {
        let mut surroundings = Surroundings::default();
        for heading in self.all_olps().filter(|&olp| self.path(olp) == path) {
            let around: Vec<MapOlp> = self.olps_of(self.place(heading)).collect();
            let clockwise = around.iter().cycle().copied().skip_while(|&olp| olp != heading).skip(1);
            let leaving = clockwise.take_while(|&olp| olp != self.opposite(heading));
            // Right of who goes upstream is left.
            let side = if self.direction(heading) == Direction::Downstream { 1 } else { 2 };
            for olp in leaving {
                let (way, comes_back) = self.ahead(olp);
                let reached = way.iter().skip(usize::from(!comes_back)).map(|&olp| self.place(olp));
                surroundings[side].extend(reached);
            }
            surroundings[0].insert(self.place(heading));
        }
        surroundings
    }

    /// Whatever else is counted.
    fn check_tally(&self) -> Result<(), Unsound> {
        let closed: Vec<MapOlp> = self.all_olps().filter(|&olp| self.dart(olp).is_none()).collect();
        agrees("closed ends", self.closed_end_count() as usize, closed.len())?;
        let is_long = |path: PathId| self.surroundings(path)[0].len() > 1;
        let long: BTreeSet<PathId> = self.paths().filter(|&path| is_long(path)).collect();
        let on_long = |olp: MapOlp| long.contains(&self.path(olp));
        agrees("long paths", self.long_path_count() as usize, long.len())?;
        let circles = long.iter().filter(|&&path| self.is_circular(path)).count();
        agrees("long circles", self.tally.long_circles as usize, circles)?;
        let pending: Vec<MapOlp> = self.pending_gateways().map(|gateway| gateway.olp()).collect();
        let loose = pending.iter().filter(|&&olp| !on_long(olp)).count();
        agrees("loose gateways", self.tally.loose_gateways as usize, loose)?;
        agrees("is nearly closed", self.is_nearly_closed(), loose == 0)?;
        agrees(
            "pending ends of long paths",
            self.pending_ends_of_long_paths() as usize,
            pending.len() - loose,
        )?;
        let closed_on_long = closed.iter().filter(|&&olp| on_long(olp)).count();
        agrees("closed ends of long paths", self.closed_ends_of_long_paths() as usize, closed_on_long)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::StarCatalog;
    use crate::map::boundaries::Set;
    use crate::star::Star;

    /// Two crossings on one road, a dead end, and a place that is not linked.
    fn small_map() -> TopologicalMap {
        let stars = ["0+ 1+ 0- 1-", "0+ 1+ 0- 1-", "0+ (0-)", "0+ 0-"];
        let mut catalog = StarCatalog::new();
        let mut map = TopologicalMap::new();
        for star in stars.map(|text| text.parse::<Star>().unwrap()) {
            map.add_place(catalog.intern(&star), &star);
        }
        for (a, b) in [(0, 6), (1, 8)] {
            let pending = |olp| map.pending(MapOlp::new(olp)).unwrap();
            map.link(pending(a), pending(b));
        }
        map
    }

    /// Whatever is carried along, the check sees that it is wrong.
    #[test]
    fn nothing_wrong_goes_unseen() {
        assert_eq!(small_map().sanity_check(), Ok(()));
        let faults: [fn(&mut TopologicalMap); 19] = [
            |map| map.tally.links += 1,
            |map| map.tally.paths -= 1,
            |map| map.tally.closed_ends += 1,
            |map| map.tally.loose_gateways -= 1,
            |map| map.tally.long_paths += 1,
            |map| map.tally.long_circles += 1,
            |map| map.tally.incidences += 1,
            |map| map.live_paths.leave(3),
            |map| map.paths[0].local_paths += 1,
            |map| map.paths[0].places += 1,
            |map| map.paths[0].pending_ends -= 1,
            |map| map.paths[0].state = PathState::Circular,
            |map| map.paths[0].state = PathState::Absorbed,
            |map| map.olps[0].path = PathId::new(1),
            |map| map.olps[2].direction = Direction::Downstream,
            |map| map.olps[6].link = MapOlp::new(6),
            |map| map.olps[3].opposite = MapOlp::new(3),
            |map| map.gateways.swap(0, 1),
            |map| {
                map.history.pop();
            },
        ];
        for (number, fault) in faults.into_iter().enumerate() {
            let mut map = small_map();
            fault(&mut map);
            assert!(map.sanity_check().is_err(), "fault {number}");
        }
        // Each bit of each set.
        for path in small_map().paths() {
            for set in [Set::On, Set::Right, Set::Left] {
                for place in small_map().places() {
                    let mut map = small_map();
                    map.boundaries.as_mut().unwrap().flip(path, set, place);
                    assert!(map.sanity_check().is_err(), "{path:?} and {place:?}");
                }
            }
        }
    }
}
