//! The axioms that prune the search, each tested on a whole map (sections 2.3.1, 3.2 and 3.4).

use crate::facts::is_perpendicular;
use crate::map::Map;
use crate::path::Path;

/// The axioms, in the order in which a rejected map is blamed on the first it violates.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Axiom {
    /// No path meets a place twice.
    SelfIntersection,
    /// No path is circular.
    CircularPath,
    /// There are no more than so many places.
    Places,
    /// The genus is no greater than so much; 0 is planarity.
    Genus,
    /// No two paths share two places, no three form a triangle.
    Perpendicular,
    /// No place is both left and right of a path; no place on a path is beside it.
    Sides,
}

/// Which axioms hold, with their bounds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rules {
    /// Forbid paths that meet a place twice.
    pub no_self_intersection: bool,
    /// Forbid circular paths.
    pub no_circular_path: bool,
    /// The greatest number of places.
    pub places_bound: Option<usize>,
    /// The greatest genus.
    pub genus_bound: Option<usize>,
    /// Demand "qualitatively perpendicular" maps.
    pub perpendicular: bool,
    /// Demand that sides are unambiguous.
    pub sides: bool,
}

impl Default for Rules {
    /// Axioms 1 and 2 only.
    fn default() -> Self {
        Rules {
            no_self_intersection: true,
            no_circular_path: true,
            places_bound: None,
            genus_bound: None,
            perpendicular: false,
            sides: false,
        }
    }
}

impl Rules {
    /// The default and planarity.
    #[must_use]
    pub fn planar() -> Self {
        Rules { genus_bound: Some(0), ..Rules::default() }
    }

    /// The first axiom that a map violates.
    #[must_use]
    pub fn first_violation(&self, map: &Map) -> Option<Axiom> {
        let paths = map.paths();
        if self.no_self_intersection && paths.iter().any(meets_a_place_twice) {
            return Some(Axiom::SelfIntersection);
        }
        if self.no_circular_path && paths.iter().any(|path| path.circular) {
            return Some(Axiom::CircularPath);
        }
        if self.places_bound.is_some_and(|bound| map.places.len() > bound) {
            return Some(Axiom::Places);
        }
        if self.genus_bound.is_some_and(|bound| map.rotation_system().genus() > bound) {
            return Some(Axiom::Genus);
        }
        if self.perpendicular && !is_perpendicular(map, &paths) {
            return Some(Axiom::Perpendicular);
        }
        if self.sides && paths.iter().any(|path| has_ambiguous_sides(map, path)) {
            return Some(Axiom::Sides);
        }
        None
    }
}

fn meets_a_place_twice(path: &Path) -> bool {
    let places: Vec<usize> = path.places().collect();
    (0..places.len()).any(|i| places[..i].contains(&places[i]))
}

fn has_ambiguous_sides(map: &Map, path: &Path) -> bool {
    let (right, left) = (path.right(map), path.left(map));
    let on_both_sides = !right.is_disjoint(&left);
    let on_and_beside = path.places().any(|place| right.contains(&place) || left.contains(&place));
    on_both_sides || on_and_beside
}
