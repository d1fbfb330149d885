//! A chart: places with ends in clockwise order, and links between open ends.

use hssh_topology::{Passability, Star};

use super::model::Evidence;
use crate::star;

/// An end, by its number in [`Chart::ends`]: it keeps it wherever it stands in its place.
pub(super) type EndId = usize;

/// One direction of a local path of a place.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct ChartEnd {
    pub(super) place: usize,
    pub(super) open: bool,
    pub(super) label: Option<String>,
    pub(super) opposite: EndId,
    pub(super) evidence: Evidence,
}

/// A place.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct ChartPlace {
    /// Its ends, clockwise.
    pub(super) ends: Vec<EndId>,
    /// How many visits to it were reported.
    pub(super) visits: i32,
}

/// A link, made from one end to another.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Link {
    pub(super) from: EndId,
    pub(super) to: EndId,
    /// How often it was gone along.
    pub(super) passed: i32,
}

/// Places and links.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct Chart {
    pub(super) ends: Vec<ChartEnd>,
    pub(super) places: Vec<ChartPlace>,
    /// In the order in which they were made.
    pub(super) links: Vec<Link>,
}

impl Chart {
    /// A new place, visited once, with the star as seen. Gives its number; the ends of the star are the ends of the
    /// place, in order.
    pub(super) fn add_visited_place(&mut self, seen: &Star) -> usize {
        let (place, first) = (self.places.len(), self.ends.len());
        for (index, end) in seen.ends().iter().enumerate() {
            let open = end.passability == Passability::Travelable;
            self.ends.push(ChartEnd {
                place,
                open,
                label: end.label.clone(),
                opposite: first + star::opposite(seen, index),
                evidence: Evidence { shown: i32::from(open), ..Evidence::default() },
            });
        }
        self.places.push(ChartPlace { ends: (first..self.ends.len()).collect(), visits: 1 });
        place
    }

    /// J on the link of `d`, linked to `y`: the stem right of the way from `d` to `y`, or left. Gives its ends
    /// toward `d`, toward `y`, and the stem.
    pub(super) fn add_junction(&mut self, d: EndId, y: EndId, stem_right: bool) -> (EndId, EndId, EndId) {
        let (place, first) = (self.places.len(), self.ends.len());
        let (toward_y, stem, toward_d, closed) = (first, first + 1, first + 2, first + 3);
        for opposite in [toward_d, closed, toward_y, stem] {
            let open = opposite != stem;
            let evidence = Evidence { travelled: open, ..Evidence::default() };
            self.ends.push(ChartEnd { place, open, label: None, opposite, evidence });
        }
        let ends = if stem_right {
            vec![toward_y, stem, toward_d, closed]
        } else {
            vec![toward_y, closed, toward_d, stem]
        };
        self.places.push(ChartPlace { ends, visits: 0 });
        self.split((d, toward_d), (y, toward_y));
        (toward_d, toward_y, stem)
    }

    /// Replaces the link ⟨u, v⟩ by ⟨u, a⟩ and ⟨b, v⟩ in its turn, each passed as often as it was.
    pub(super) fn split(&mut self, (u, a): (EndId, EndId), (v, b): (EndId, EndId)) {
        let turn = self.link_of(u).expect("a link that is split exists");
        let Link { from, passed, .. } = self.links[turn];
        let halves = if from == u { [(u, a), (b, v)] } else { [(v, b), (a, u)] };
        self.links.splice(turn..=turn, halves.map(|(from, to)| Link { from, to, passed }));
    }

    /// Which link an end has.
    pub(super) fn link_of(&self, end: EndId) -> Option<usize> {
        self.links.iter().position(|link| link.from == end || link.to == end)
    }

    /// The end that an end is linked to.
    pub(super) fn partner(&self, end: EndId) -> Option<EndId> {
        let link = &self.links[self.link_of(end)?];
        Some(if link.from == end { link.to } else { link.from })
    }

    /// The open ends of a place, clockwise.
    pub(super) fn open_ends(&self, place: usize) -> Vec<EndId> {
        self.places[place].ends.iter().copied().filter(|&end| self.ends[end].open).collect()
    }

    /// The open ends without a link.
    pub(super) fn pending(&self) -> Vec<EndId> {
        (0..self.ends.len()).filter(|&end| self.ends[end].open && self.partner(end).is_none()).collect()
    }

    /// Puts an end of a place right after (clockwise) another one of it.
    pub(super) fn put_after(&mut self, before: EndId, end: EndId) {
        let around = &mut self.places[self.ends[before].place].ends;
        let position = around.iter().position(|&other| other == before).expect("an end stands in its place");
        around.insert(position + 1, end);
    }
}
