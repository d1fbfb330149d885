//! Paths: places joined by travels that go straight on, with their order and direction (section 2.1.3).

use super::record::{Direction, PathState};
use super::topological_map::TopologicalMap;
use crate::ids::{MapOlp, PathId, PlaceId};

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

    /// The places on a path.
    pub fn places_of_path(&self, path: PathId) -> impl Iterator<Item = PlaceId> + '_ {
        self.places().filter(move |&place| self.is_on(path, place))
    }

    /// Whether a place lies on a path.
    pub(super) fn is_on(&self, path: PathId, place: PlaceId) -> bool {
        self.olps_of(place).any(|olp| self.path(olp) == path)
    }
}
