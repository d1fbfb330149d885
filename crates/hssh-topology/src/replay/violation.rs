//! Which axioms a map violates, and where: each decided from its definition (sections 2.3.1, 3.2, 3.4).

use std::collections::BTreeSet;
use std::fmt;

use super::sketch::{End, Malformed, MapSketch, Wiring};
use crate::axioms::{Axiom, Axioms};
use crate::ids::PlaceId;

/// A path in one of its two directions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TracedPath {
    /// At each place along the path, in order, the end that looks ahead.
    pub headings: Vec<End>,
    /// Whether the last place leads on to the first.
    pub circular: bool,
}

impl TracedPath {
    /// The places along the path, in order; one that is met twice stands twice.
    pub fn places(&self) -> impl Iterator<Item = PlaceId> + '_ {
        self.headings.iter().map(|end| end.place)
    }
}

/// The places along the path: `0-1-2`; a circular path ends as it begins.
impl fmt::Display for TracedPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let around = self.places().take(usize::from(self.circular));
        let places: Vec<String> = self.places().chain(around).map(|place| place.to_string()).collect();
        f.write_str(&places.join("-"))
    }
}

/// An axiom that does not hold, and what shows it.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Violation {
    /// A path meets a place twice.
    #[error("path {path} meets place {place} twice")]
    SelfIntersection {
        /// The path.
        path: TracedPath,
        /// The place.
        place: PlaceId,
    },
    /// A path returns into itself.
    #[error("path {path} is circular")]
    CircularPath {
        /// The path.
        path: TracedPath,
    },
    /// There are more places than allowed.
    #[error("there are {places} places, at most {most} are allowed")]
    TooManyPlaces {
        /// How many there are.
        places: usize,
        /// How many may be.
        most: u32,
    },
    /// The genus is higher than allowed.
    #[error("the genus is {genus}, at most {most} is allowed")]
    GenusTooHigh {
        /// The genus.
        genus: usize,
        /// How high it may be.
        most: u32,
    },
    /// Two paths share more than one place.
    #[error("paths {path} and {other} share places {} and {}", shared.0, shared.1)]
    SharedPlaces {
        /// The first path.
        path: TracedPath,
        /// The second path.
        other: TracedPath,
        /// Two of the places.
        shared: (PlaceId, PlaceId),
    },
    /// Three paths form a triangle.
    #[error("paths {}, {} and {} form a triangle", paths[0], paths[1], paths[2])]
    Triangle {
        /// The three paths.
        paths: Box<[TracedPath; 3]>,
    },
    /// A place is right and left of a path.
    #[error("place {place} is right and left of path {path}")]
    OnBothSides {
        /// The path.
        path: TracedPath,
        /// The place.
        place: PlaceId,
    },
    /// A place on a path is also beside it.
    #[error("place {place} is on path {path} and beside it")]
    OnAndBeside {
        /// The path.
        path: TracedPath,
        /// The place.
        place: PlaceId,
    },
}

impl Violation {
    /// The axiom that does not hold.
    #[must_use]
    pub fn axiom(&self) -> Axiom {
        match self {
            Violation::SelfIntersection { .. } => Axiom::NoSelfIntersection,
            Violation::CircularPath { .. } => Axiom::NoCircularPath,
            Violation::TooManyPlaces { .. } => Axiom::MaxPlaces,
            Violation::GenusTooHigh { .. } => Axiom::MaxGenus,
            Violation::SharedPlaces { .. } | Violation::Triangle { .. } => Axiom::Perpendicular,
            Violation::OnBothSides { .. } | Violation::OnAndBeside { .. } => Axiom::ConsistentBoundaries,
        }
    }
}

/// Every violation of the axioms that are switched on, in the order of [`Axiom::ALL`].
///
/// # Errors
/// If the sketch is no map.
///
/// ```
/// use hssh_topology::{Axioms, End, MapSketch, Olp, PlaceId, violations};
///
/// // A corridor whose two ends are the same place.
/// let end = |olp| End { place: PlaceId::new(0), olp: Olp::new(olp) };
/// let ring = MapSketch { places: vec!["0+ 0-".parse()?], links: vec![(end(0), end(1))] };
/// let found = violations(&ring, &Axioms::default())?;
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].to_string(), "path 0-0 is circular");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn violations(sketch: &MapSketch, axioms: &Axioms) -> Result<Vec<Violation>, Malformed> {
    let wiring = Wiring::of(sketch)?;
    let paths = wiring.paths();
    let mut found = Vec::new();
    if axioms.no_self_intersection {
        found.extend(paths.iter().flat_map(self_intersections));
    }
    if axioms.no_circular_path {
        let circular = paths.iter().filter(|path| path.circular);
        found.extend(circular.map(|path| Violation::CircularPath { path: path.clone() }));
    }
    if let Some(most) = axioms.max_places
        && sketch.places.len() > most as usize
    {
        found.push(Violation::TooManyPlaces { places: sketch.places.len(), most });
    }
    if let Some(most) = axioms.max_genus
        && wiring.genus() > most as usize
    {
        found.push(Violation::GenusTooHigh { genus: wiring.genus(), most });
    }
    if axioms.perpendicular {
        found.extend(oblique_paths(&paths));
    }
    if axioms.consistent_boundaries {
        found.extend(paths.iter().flat_map(|path| contradictory_boundaries(&wiring, path)));
    }
    Ok(found)
}

fn self_intersections(path: &TracedPath) -> Vec<Violation> {
    let places: BTreeSet<PlaceId> = path.places().collect();
    let met_twice = |&place: &PlaceId| path.places().filter(|&other| other == place).count() > 1;
    let violation = |place| Violation::SelfIntersection { path: path.clone(), place };
    places.into_iter().filter(met_twice).map(violation).collect()
}

/// "No two global paths intersect each other in more than one place and no three global paths form a
/// triangle" (section 3.4).
fn oblique_paths(paths: &[TracedPath]) -> Vec<Violation> {
    let places: Vec<BTreeSet<PlaceId>> = paths.iter().map(|path| path.places().collect()).collect();
    let shared = |a: usize, b: usize| places[a].intersection(&places[b]).copied().collect::<Vec<_>>();
    let mut found = Vec::new();
    for a in 0..paths.len() {
        for b in a + 1..paths.len() {
            let corner = match shared(a, b)[..] {
                [] => continue,
                [corner] => corner,
                [first, second, ..] => {
                    let (path, other) = (paths[a].clone(), paths[b].clone());
                    found.push(Violation::SharedPlaces { path, other, shared: (first, second) });
                    continue;
                }
            };
            for c in b + 1..paths.len() {
                // Paths that share two places are no sides of a triangle but reported as they are.
                if let ([second], [third]) = (&shared(a, c)[..], &shared(b, c)[..])
                    && corner != *second
                    && second != third
                {
                    let paths = [a, b, c].map(|path| paths[path].clone());
                    found.push(Violation::Triangle { paths: Box::new(paths) });
                }
            }
        }
    }
    found
}

fn contradictory_boundaries(wiring: &Wiring<'_>, path: &TracedPath) -> Vec<Violation> {
    let (right, left) = (wiring.right_of(path), wiring.left_of(path));
    let on: BTreeSet<PlaceId> = path.places().collect();
    let beside: BTreeSet<PlaceId> = right.union(&left).copied().collect();
    let both = right.intersection(&left);
    let on_both_sides = both.map(|&place| Violation::OnBothSides { path: path.clone(), place });
    let on_and_beside =
        on.intersection(&beside).map(|&place| Violation::OnAndBeside { path: path.clone(), place });
    on_both_sides.chain(on_and_beside).collect()
}
