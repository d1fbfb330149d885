//! The axioms that a map has to satisfy (sections 2.1.3, 2.3.1, 3.3 and 3.4), each on its own switch.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::ids::PathId;
use crate::map::{PendingGateway, TopologicalMap};

/// Which axioms are enforced. The default are those of every published table: no path meets a place
/// twice, and no path is circular.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Axioms {
    /// No path meets a place twice.
    pub no_self_intersection: bool,
    /// No path returns into itself.
    pub no_circular_path: bool,
    /// At most that many places.
    pub max_places: Option<u32>,
    /// Genus at most that: `Some(0)` is planarity, more is relaxed planarity (end of section 3.2).
    pub max_genus: Option<u32>,
    /// "Qualitatively perpendicular": no two paths share two places, no three form a triangle. Only together with
    /// `no_self_intersection` can a search decide it on the way ([`Axioms::check`]).
    pub perpendicular: bool,
    /// No place is both right and left of a path, and none on a path is beside it.
    pub consistent_boundaries: bool,
}

impl Axioms {
    /// The axioms of every published table.
    pub const PUBLISHED: Axioms = Axioms {
        no_self_intersection: true,
        no_circular_path: true,
        max_places: None,
        max_genus: None,
        perpendicular: false,
        consistent_boundaries: false,
    };
}

impl Default for Axioms {
    fn default() -> Self {
        Axioms::PUBLISHED
    }
}

/// Axioms by which a search may not discard what violates them: it might grow into a map that does not.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "maps cannot be held to be perpendicular while their paths may meet a place twice: two paths that share two places \
     may turn out to be one path, which crosses itself. Forbid self-intersections too, or leave out perpendicularity"
)]
pub struct AxiomsError;

impl Axioms {
    /// Whether a map that violates the axioms does so however it grows, so that a search may discard it.
    ///
    /// # Errors
    /// If perpendicularity is asked for and self-intersection is allowed: all other violations stay.
    ///
    /// ```
    /// use hssh_topology::Axioms;
    ///
    /// assert!(Axioms { perpendicular: true, ..Axioms::default() }.check().is_ok());
    /// assert!(Axioms { perpendicular: true, no_self_intersection: false, ..Axioms::default() }.check().is_err());
    /// ```
    pub fn check(&self) -> Result<(), AxiomsError> {
        if self.perpendicular && !self.no_self_intersection { Err(AxiomsError) } else { Ok(()) }
    }
}

/// One of the axioms.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Axiom {
    /// No path meets a place twice.
    NoSelfIntersection,
    /// No path returns into itself.
    NoCircularPath,
    /// The bound on places.
    MaxPlaces,
    /// The bound on the genus.
    MaxGenus,
    /// Qualitative perpendicularity.
    Perpendicular,
    /// Boundary relations do not contradict one another.
    ConsistentBoundaries,
}

impl Axiom {
    /// All axioms in the order in which they are tested: a removal counts for the first violated.
    pub const ALL: [Axiom; 6] = [
        Axiom::NoSelfIntersection,
        Axiom::NoCircularPath,
        Axiom::MaxPlaces,
        Axiom::MaxGenus,
        Axiom::Perpendicular,
        Axiom::ConsistentBoundaries,
    ];
}

/// What a violation is called.
impl fmt::Display for Axiom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Axiom::NoSelfIntersection => "self-intersecting path",
            Axiom::NoCircularPath => "circular path",
            Axiom::MaxPlaces => "too many places",
            Axiom::MaxGenus => "genus too high",
            Axiom::Perpendicular => "not perpendicular",
            Axiom::ConsistentBoundaries => "contradictory boundaries",
        })
    }
}

/// How many successors each axiom removed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Removals {
    /// By [`Axiom::NoSelfIntersection`].
    pub no_self_intersection: u64,
    /// By [`Axiom::NoCircularPath`].
    pub no_circular_path: u64,
    /// By [`Axiom::MaxPlaces`].
    pub max_places: u64,
    /// By [`Axiom::MaxGenus`].
    pub max_genus: u64,
    /// By [`Axiom::Perpendicular`].
    pub perpendicular: u64,
    /// By [`Axiom::ConsistentBoundaries`].
    pub consistent_boundaries: u64,
}

impl Removals {
    /// Counts one successor removed by `axiom`.
    pub fn record(&mut self, axiom: Axiom) {
        *self.by_mut(axiom) += 1;
    }

    /// How many successors `axiom` removed.
    #[must_use]
    pub fn by(&self, axiom: Axiom) -> u64 {
        match axiom {
            Axiom::NoSelfIntersection => self.no_self_intersection,
            Axiom::NoCircularPath => self.no_circular_path,
            Axiom::MaxPlaces => self.max_places,
            Axiom::MaxGenus => self.max_genus,
            Axiom::Perpendicular => self.perpendicular,
            Axiom::ConsistentBoundaries => self.consistent_boundaries,
        }
    }

    /// How many successors were removed.
    #[must_use]
    pub fn total(&self) -> u64 {
        Axiom::ALL.into_iter().map(|axiom| self.by(axiom)).sum()
    }

    fn by_mut(&mut self, axiom: Axiom) -> &mut u64 {
        match axiom {
            Axiom::NoSelfIntersection => &mut self.no_self_intersection,
            Axiom::NoCircularPath => &mut self.no_circular_path,
            Axiom::MaxPlaces => &mut self.max_places,
            Axiom::MaxGenus => &mut self.max_genus,
            Axiom::Perpendicular => &mut self.perpendicular,
            Axiom::ConsistentBoundaries => &mut self.consistent_boundaries,
        }
    }
}

impl std::ops::AddAssign for Removals {
    fn add_assign(&mut self, other: Removals) {
        for axiom in Axiom::ALL {
            *self.by_mut(axiom) += other.by(axiom);
        }
    }
}

impl Axioms {
    /// Whether a search under these axioms asks for boundary relations, or for the places on paths, at every step: whether its maps had better
    /// carry them along ([`TopologicalMap::without_boundaries`]).
    #[must_use]
    pub fn ask_for_boundaries(&self) -> bool {
        self.perpendicular || self.consistent_boundaries
    }

    /// The first axiom that a new place would violate.
    #[must_use]
    pub(crate) fn violated_by_new_place(&self, map: &TopologicalMap) -> Option<Axiom> {
        let full = self.max_places.is_some_and(|most| map.place_count() >= most);
        full.then_some(Axiom::MaxPlaces)
    }

    /// The first axiom, except that on boundaries, that linking two pending gateways would violate.
    /// The map satisfies them all so far.
    #[must_use]
    pub(crate) fn violated_by_closure(
        &self,
        map: &TopologicalMap,
        a: PendingGateway,
        b: PendingGateway,
    ) -> Option<Axiom> {
        let (path, other) = (map.path(a.olp()), map.path(b.olp()));
        if path == other {
            if self.no_circular_path {
                return Some(Axiom::NoCircularPath);
            }
        } else if self.no_self_intersection && map.paths_of_gateways_meet(a.olp(), b.olp()) {
            return Some(Axiom::NoSelfIntersection);
        }
        if self.max_genus.is_some_and(|most| map.graph().genus() >= most) && !map.share_face(a, b) {
            return Some(Axiom::MaxGenus);
        }
        (self.perpendicular && !stays_perpendicular(map, path, other)).then_some(Axiom::Perpendicular)
    }

    /// Whether the boundary relations of a map that just grew are no reason to discard it.
    #[must_use]
    pub(crate) fn violated_by_boundaries(&self, map: &TopologicalMap) -> Option<Axiom> {
        let violated = self.consistent_boundaries && map.contradictory_boundary_count() > 0;
        violated.then_some(Axiom::ConsistentBoundaries)
    }
}

/// Whether a perpendicular map is still perpendicular when two of its paths become one.
fn stays_perpendicular(map: &TopologicalMap, path: PathId, other: PathId) -> bool {
    let crossing = |third: PathId| third != path && third != other && map.places_on_path(third) > 1;
    let sets = map.place_sets(|asked| asked == path || asked == other || crossing(asked));
    let joined: Vec<u64> = sets.on(path).iter().zip(sets.on(other)).map(|(one, two)| one | two).collect();
    forms_no_triangle(&joined, map.paths().filter(|&third| crossing(third)).map(|third| sets.on(third)))
}

/// Whether no path shares two places with `path`, and no two of them that cross `path` in different
/// places meet off it. The `others` are perpendicular among themselves.
fn forms_no_triangle<'a>(path: &[u64], others: impl Iterator<Item = &'a [u64]>) -> bool {
    // Places off `path` on the paths that cross it. Two paths through one place of `path` share no
    // other place, so that a place met again closes a triangle.
    let mut beside = vec![0; path.len()];
    for other in others {
        match path.iter().zip(other).map(|(a, b)| (a & b).count_ones()).sum::<u32>() {
            0 => continue,
            1 => {}
            _ => return false,
        }
        for ((beside, other), path) in beside.iter_mut().zip(other).zip(path) {
            if *beside & other & !path != 0 {
                return false;
            }
            *beside |= other & !path;
        }
    }
    true
}

impl TopologicalMap {
    /// Whether no two paths share more than one place, and no three form a triangle (section 3.4).
    #[must_use]
    pub fn is_perpendicular(&self) -> bool {
        let is_long = |path: PathId| self.places_on_path(path) > 1;
        let sets = self.place_sets(is_long);
        let long: Vec<&[u64]> =
            self.paths().filter(|&path| is_long(path)).map(|path| sets.on(path)).collect();
        (0..long.len()).all(|last| forms_no_triangle(long[last], long[..last].iter().copied()))
    }
}
