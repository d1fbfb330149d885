//! Whether a chart is a map that the axioms allow.

use hssh_causal::{Exploration, NamedStar, StarType};
use hssh_topology::{OlpName, Passability, Sign, Star, StarEnd};

use super::chart::{Chart, EndId};
use crate::axiom::Rules;
use crate::map::{End, Map};

impl Chart {
    /// Whether none of the axioms is violated after any of its links.
    pub(super) fn obeys(&self, rules: &Rules) -> bool {
        let stars = Exploration::new(
            (0..self.places.len())
                .map(|place| {
                    let star = self.star(place);
                    NamedStar { name: place.to_string(), bearings: vec![None; star.ends().len()], star }
                })
                .collect(),
            StarType(0),
            Vec::new(),
        )
        .expect("the stars of a chart are stars under different names");
        let places: Vec<StarType> = (0..self.places.len()).map(|place| StarType(place as u32)).collect();
        let links: Vec<(End, End)> =
            self.links.iter().map(|link| (self.position(link.from), self.position(link.to))).collect();
        (0..=links.len()).all(|made| {
            let map = Map { exploration: &stars, places: places.clone(), links: links[..made].to_vec() };
            rules.first_violation(&map).is_none()
        })
    }

    /// The star of a place: its local paths are named by their first ends.
    pub(super) fn star(&self, place: usize) -> Star {
        let star_end = |&id: &EndId| {
            let end = &self.ends[id];
            let sign = if id < end.opposite { Sign::Plus } else { Sign::Minus };
            StarEnd {
                name: OlpName { local_path: id.min(end.opposite) as u32, sign },
                passability: if end.open { Passability::Travelable } else { Passability::Closed },
                label: end.label.clone(),
            }
        };
        Star::new(self.places[place].ends.iter().map(star_end)).expect("the ends of a place come in pairs")
    }

    /// The place of an end, and where in the place's star it stands.
    pub(super) fn position(&self, end: EndId) -> End {
        let place = self.ends[end].place;
        let around = &self.places[place].ends;
        (place, around.iter().position(|&other| other == end).expect("an end stands in its place"))
    }
}
