//! Following the travels of an exploration through a map (section 2.3.1).

use std::collections::BTreeSet;

use serde::Serialize;

use super::sketch::{End, Malformed, MapSketch, Wiring};
use crate::hypothesis::Observation;
use crate::ids::{Olp, PlaceId, StarId};
use crate::star::{OlpName, Star};

/// An exploration as a map tells it.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Replay {
    /// One entry per travel. The first one leaves place 0.
    pub travels: Vec<ReplayedTravel>,
}

/// One travel as a map tells it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
pub struct ReplayedTravel {
    /// The place left.
    pub from: PlaceId,
    /// The end left by, in the star of that place as it stands in the map.
    pub exit: Olp,
    /// The place reached.
    pub to: PlaceId,
    /// The end entered by, in the star of that place as it stands in the map.
    pub entry: Olp,
    /// φ: how many positions clockwise the star in the map is turned against the star observed.
    pub rotation: u32,
    /// What the travel added to what was known.
    pub discovery: Discovery,
}

/// What a travel adds to what was known before it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Discovery {
    /// A place not visited before.
    NewPlace,
    /// A link not used before, back to a place visited before.
    LoopClosure,
    /// Nothing: the link was used before.
    KnownLink,
}

/// Why a map does not explain an exploration. Travels are counted from 1.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Contradiction {
    /// It is no map.
    #[error("no map: {0}")]
    Malformed(#[from] Malformed),
    /// An observation names a star that is not in the list. Travel 0 stands for the first star.
    #[error("travel {travel}: star {star} does not exist")]
    NoSuchStar {
        /// The travel.
        travel: usize,
        /// The star it names.
        star: StarId,
    },
    /// The robot cannot have left or entered a star by that end.
    #[error("travel {travel}: the observed star {star} has no gateway number {olp}")]
    NoSuchGateway {
        /// The travel.
        travel: usize,
        /// The star as observed.
        star: Star,
        /// The end that it does not have, or that is closed.
        olp: Olp,
    },
    /// The first place does not look like the first star.
    #[error("the first star is {observed}, but place 0 has {expected}")]
    FirstStar {
        /// The star as observed.
        observed: Star,
        /// The star of place 0.
        expected: Star,
    },
    /// The map leads nowhere by the exit.
    #[error("travel {travel} leaves place {place} by `{exit}`, which the map does not link")]
    NotLinked {
        /// The travel.
        travel: usize,
        /// The place it leaves.
        place: PlaceId,
        /// The end in the star of that place.
        exit: OlpName,
    },
    /// The place that the map leads to does not look like what was observed.
    #[error(
        "travel {travel} reaches place {place} by `{entry}`; seen from there its star {expected} is not the \
         observed {observed} entered by `{observed_entry}`"
    )]
    StarMismatch {
        /// The travel.
        travel: usize,
        /// The place it reaches.
        place: PlaceId,
        /// The end it comes in by, in the star of that place.
        entry: OlpName,
        /// The star of that place.
        expected: Box<Star>,
        /// The star as observed.
        observed: Box<Star>,
        /// The end it came in by, in the star as observed.
        observed_entry: OlpName,
    },
    /// A place that no travel reaches.
    #[error("place {0} is never visited")]
    UnvisitedPlace(PlaceId),
    /// A link that no travel uses.
    #[error("the link from {0} to {1} is never used")]
    UnusedLink(End, End),
}

/// Follows the travels through the map, from place 0 with φ = identity. The map explains the
/// exploration if every travel finds a link and, behind it, a star that looks as observed, and if
/// the map has nothing that no travel needs.
///
/// `stars` is what the [`StarId`]s of `start` and the observations count, as
/// [`StarCatalog::stars`](crate::StarCatalog::stars) gives it.
///
/// # Errors
/// With the first thing that is wrong.
///
/// ```
/// use hssh_topology::{Discovery, End, MapSketch, Observation, Olp, PlaceId, Star, StarId, replay};
///
/// // Along a corridor from one dead end to the other, and back.
/// let stars: [Star; 2] = ["0+ (0-)".parse()?, "(0+) 0-".parse()?];
/// let go = |exit, entry, star| Observation { exit: Olp::new(exit), entry: Olp::new(entry), star: StarId::new(star) };
/// let there_and_back = [go(0, 1, 1), go(1, 0, 0)];
///
/// let end = |place, olp| End { place: PlaceId::new(place), olp: Olp::new(olp) };
/// let mut map = MapSketch { places: stars.to_vec(), links: vec![(end(0, 0), end(1, 1))] };
/// let told = replay(&map, &stars, StarId::new(0), &there_and_back)?;
/// assert_eq!(told.travels[0].discovery, Discovery::NewPlace);
/// assert_eq!((told.travels[1].to, told.travels[1].discovery), (PlaceId::new(0), Discovery::KnownLink));
///
/// map.links.clear();
/// let error = replay(&map, &stars, StarId::new(0), &there_and_back).unwrap_err();
/// assert_eq!(error.to_string(), "travel 1 leaves place 0 by `0+`, which the map does not link");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn replay(
    sketch: &MapSketch,
    stars: &[Star],
    start: StarId,
    observations: &[Observation],
) -> Result<Replay, Contradiction> {
    let wiring = Wiring::of(sketch)?;
    let mut here = PlaceId::new(0);
    let mut rotation = 0;
    let mut seen = star(stars, start, 0)?;
    if !looks_like(seen, rotation, wiring.star(here)) {
        let (observed, expected) = (seen.clone(), wiring.star(here).clone());
        return Err(Contradiction::FirstStar { observed, expected });
    }

    let mut visited = BTreeSet::from([here]);
    let mut used = BTreeSet::new();
    let mut travels = Vec::new();
    for (index, &Observation { exit, entry, star: next }) in observations.iter().enumerate() {
        let travel = index + 1;
        let observed = star(stars, next, travel)?;
        for (star, olp) in [(seen, exit), (observed, entry)] {
            if olp.number() >= star.degree() || !star.is_travelable(olp) {
                return Err(Contradiction::NoSuchGateway { travel, star: star.clone(), olp });
            }
        }

        let left = End { place: here, olp: exit.turned(rotation, seen.degree()) };
        let reached = wiring.partner(left).ok_or_else(|| {
            let exit = wiring.star(here).name(left.olp);
            Contradiction::NotLinked { travel, place: here, exit }
        })?;
        let expected = wiring.star(reached.place);
        rotation = entry.turn_to(reached.olp, observed.degree());
        if !looks_like(observed, rotation, expected) {
            return Err(Contradiction::StarMismatch {
                travel,
                place: reached.place,
                entry: expected.name(reached.olp),
                expected: Box::new(expected.clone()),
                observed: Box::new(observed.clone()),
                observed_entry: observed.name(entry),
            });
        }

        let (new_place, new_link) = (visited.insert(reached.place), used.insert(left));
        used.insert(reached);
        let discovery = match (new_place, new_link) {
            (true, _) => Discovery::NewPlace,
            (false, true) => Discovery::LoopClosure,
            (false, false) => Discovery::KnownLink,
        };
        let (exit, to, entry) = (left.olp, reached.place, reached.olp);
        travels.push(ReplayedTravel { from: here, exit, to, entry, rotation, discovery });
        (here, seen) = (reached.place, observed);
    }

    if let Some(place) = wiring.places().find(|place| !visited.contains(place)) {
        return Err(Contradiction::UnvisitedPlace(place));
    }
    match sketch.links.iter().find(|(a, _)| !used.contains(a)) {
        Some(&(a, b)) => Err(Contradiction::UnusedLink(a, b)),
        None => Ok(Replay { travels }),
    }
}

fn star(stars: &[Star], star: StarId, travel: usize) -> Result<&Star, Contradiction> {
    stars.get(star.index()).ok_or(Contradiction::NoSuchStar { travel, star })
}

/// Whether turning `observed` clockwise by `rotation` positions keeps order, attributes and local
/// paths (Definition 2.2).
fn looks_like(observed: &Star, rotation: u32, expected: &Star) -> bool {
    let degree = observed.degree();
    let turned = |olp: Olp| olp.turned(rotation, degree);
    degree == expected.degree()
        && observed.olps().all(|olp| {
            let (here, there) = (&observed.ends()[olp.index()], &expected.ends()[turned(olp).index()]);
            here.passability == there.passability
                && here.label == there.label
                && turned(observed.opposite(olp)) == expected.opposite(turned(olp))
        })
}
