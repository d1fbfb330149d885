//! Maps as plain data: the stars of their places, and the links between ends.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::catalog::StarCatalog;
use crate::ids::{Olp, PlaceId};
use crate::map::TopologicalMap;
use crate::star::Star;

/// An oriented local path of a map: a place, and a position in the clockwise order of its star.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct End {
    /// The place.
    pub place: PlaceId,
    /// The oriented local path of its star.
    pub olp: Olp,
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "end {} of place {}", self.olp, self.place)
    }
}

/// A topological map as plain data, to be written, read, and checked by [`replay`](crate::replay)
/// and [`violations`](crate::violations).
///
/// Serialized, a star is the list of its ends in clockwise order, each in the short form of
/// [`Star`]: a name, in parentheses if closed, a label after a colon.
///
/// ```
/// use hssh_topology::{MapSketch, PendingGateway, StarCatalog, TopologicalMap};
///
/// let mut catalog = StarCatalog::new();
/// let corner = catalog.intern(&"0+ (1+) (0-) 1-".parse()?);
/// let mut map = TopologicalMap::new();
/// map.add_place(corner, catalog.star(corner));
/// map.add_place(corner, catalog.star(corner));
/// let pending: Vec<PendingGateway> = map.pending_gateways().collect();
/// map.link(pending[0], pending[3]);
///
/// let sketch = MapSketch::of(&map, &catalog);
/// let json = serde_json::to_string(&sketch)?;
/// assert_eq!(
///     json,
///     r#"{"places":[["0+","(1+)","(0-)","1-"],["0+","(1+)","(0-)","1-"]],"#.to_owned()
///         + r#""links":[[{"place":0,"olp":0},{"place":1,"olp":3}]]}"#
/// );
/// assert_eq!(serde_json::from_str::<MapSketch>(&json)?, sketch);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapSketch {
    /// The star of every place; the number of a place is its position here.
    #[serde(with = "stars")]
    pub places: Vec<Star>,
    /// Which gateways are linked.
    pub links: Vec<(End, End)>,
}

/// Why places and links are no map.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Malformed {
    /// A map without places.
    #[error("a map needs at least one place, this one has none")]
    NoPlaces,
    /// A link names an end that does not exist.
    #[error("link {link} (counted from 0) joins {end}, which does not exist")]
    NoSuchEnd {
        /// The link's position in the list.
        link: usize,
        /// The end it names.
        end: End,
    },
    /// A link joins a closed end.
    #[error("link {link} (counted from 0) joins {end}, which is closed")]
    ClosedEnd {
        /// The link's position in the list.
        link: usize,
        /// The closed end.
        end: End,
    },
    /// A link joins an end to itself.
    #[error("link {link} (counted from 0) joins {end} to itself")]
    ToItself {
        /// The link's position in the list.
        link: usize,
        /// The end.
        end: End,
    },
    /// Two links join the same end.
    #[error("link {link} (counted from 0) joins {end}, which an earlier link joins already")]
    LinkedTwice {
        /// The position of the later link in the list.
        link: usize,
        /// The end.
        end: End,
    },
}

impl MapSketch {
    /// The plain description of a map whose stars are in `catalog`.
    #[must_use]
    pub fn of(map: &TopologicalMap, catalog: &StarCatalog) -> Self {
        let end = |olp| End { place: map.place(olp), olp: map.local(olp) };
        MapSketch {
            places: map.places().map(|place| catalog.star(map.star(place)).clone()).collect(),
            links: map.links().map(|(a, b)| (end(a), end(b))).collect(),
        }
    }
}

/// A sketch that is a map, with the far end of every link at hand.
pub(super) struct Wiring<'a> {
    places: &'a [Star],
    partner: BTreeMap<End, End>,
}

impl<'a> Wiring<'a> {
    pub(super) fn of(sketch: &'a MapSketch) -> Result<Self, Malformed> {
        if sketch.places.is_empty() {
            return Err(Malformed::NoPlaces);
        }
        let mut wiring = Wiring { places: &sketch.places, partner: BTreeMap::new() };
        for (link, &(a, b)) in sketch.links.iter().enumerate() {
            if a == b {
                return Err(Malformed::ToItself { link, end: a });
            }
            for (end, far) in [(a, b), (b, a)] {
                let star = sketch.places.get(end.place.index());
                let Some(star) = star.filter(|star| end.olp.number() < star.degree()) else {
                    return Err(Malformed::NoSuchEnd { link, end });
                };
                if !star.is_travelable(end.olp) {
                    return Err(Malformed::ClosedEnd { link, end });
                }
                if wiring.partner.insert(end, far).is_some() {
                    return Err(Malformed::LinkedTwice { link, end });
                }
            }
        }
        Ok(wiring)
    }

    pub(super) fn places(&self) -> impl Iterator<Item = PlaceId> + use<> {
        (0..self.places.len() as u32).map(PlaceId::new)
    }

    /// # Panics
    /// If there is no such place; ends of links have places that exist.
    pub(super) fn star(&self, place: PlaceId) -> &'a Star {
        &self.places[place.index()]
    }

    /// The end at the other side of the link, if there is a link.
    pub(super) fn partner(&self, end: End) -> Option<End> {
        self.partner.get(&end).copied()
    }

    pub(super) fn opposite(&self, end: End) -> End {
        End { olp: self.star(end.place).opposite(end.olp), ..end }
    }

    /// All ends of a place, clockwise.
    pub(super) fn ends_of(&self, place: PlaceId) -> impl Iterator<Item = End> + use<> {
        self.star(place).olps().map(move |olp| End { place, olp })
    }

    /// The ends that have a link.
    pub(super) fn linked_ends(&self) -> impl Iterator<Item = End> + '_ {
        self.partner.keys().copied()
    }
}

/// Stars as lists of ends in the short form.
mod stars {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    use crate::star::{Passability, Star, StarEnd, StarError};

    pub(super) fn serialize<S: Serializer>(places: &[Star], serializer: S) -> Result<S::Ok, S::Error> {
        let write = |star: &Star| star.ends().iter().map(write_end).collect::<Vec<_>>();
        places.iter().map(write).collect::<Vec<_>>().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Star>, D::Error> {
        let places: Vec<Vec<String>> = Vec::deserialize(deserializer)?;
        let read = |(place, ends): (usize, Vec<String>)| {
            let ends = ends.iter().map(|end| read_end(end)).collect::<Result<Vec<_>, _>>();
            ends.and_then(Star::new).map_err(|error| D::Error::custom(format!("place {place}: {error}")))
        };
        places.into_iter().enumerate().map(read).collect()
    }

    fn write_end(end: &StarEnd) -> String {
        let label = end.label.as_ref().map_or(String::new(), |label| format!(":{label}"));
        match end.passability {
            Passability::Travelable => format!("{}{label}", end.name),
            Passability::Closed => format!("({}{label})", end.name),
        }
    }

    fn read_end(text: &str) -> Result<StarEnd, StarError> {
        let inside = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let passability = if inside.is_some() { Passability::Closed } else { Passability::Travelable };
        let (name, label) = match inside.unwrap_or(text).split_once(':') {
            Some((name, label)) => (name, Some(label.to_owned())),
            None => (inside.unwrap_or(text), None),
        };
        Ok(StarEnd { name: name.parse()?, passability, label })
    }
}
