//! The recursive step: how one hypothesis meets one travel (section 2.3.1).

use hssh_causal::{Exploration, Travel};

use crate::map::{End, Map};
use crate::star::isomorphisms;

/// A hypothesis ⟨map, current place, isomorphism⟩.
#[derive(Clone, PartialEq, Debug)]
pub struct Node<'a> {
    /// The map.
    pub map: Map<'a>,
    /// The current place.
    pub current: usize,
    /// The isomorphism φ: end `i` of the observed star is end `i + rotation`, modulo the degree, of
    /// the current place's star.
    pub rotation: usize,
}

/// What becomes of a hypothesis. No axiom is applied yet.
#[derive(Clone, PartialEq, Debug)]
pub enum Step<'a> {
    /// (p-c): the map predicts the observation.
    Predicted(Node<'a>),
    /// (p-nc): the map predicts something else.
    Refuted,
    /// (e): the exit is pending. A new place first, then a link to every other pending gateway that
    /// matches, by ascending place and end.
    Expanded {
        /// The pending gateway by which the robot left.
        exit: End,
        /// The candidates for successors.
        candidates: Vec<Node<'a>>,
    },
}

impl<'a> Node<'a> {
    /// The basic step: one place with the first star.
    #[must_use]
    pub fn root(exploration: &'a Exploration) -> Self {
        let map = Map { exploration, places: vec![exploration.start()], links: Vec::new() };
        Node { map, current: 0, rotation: 0 }
    }

    /// The recursive step.
    #[must_use]
    pub fn step(&self, travel: &Travel) -> Step<'a> {
        let degree = self.map.star(self.current).ends().len();
        let exit = (self.current, (travel.exit.index() + self.rotation) % degree);
        match self.map.partner(exit) {
            Some(entry) => match self.arrive(travel, entry) {
                Some((current, rotation)) => {
                    Step::Predicted(Node { map: self.map.clone(), current, rotation })
                }
                None => Step::Refuted,
            },
            None => Step::Expanded { exit, candidates: self.expand(travel, exit) },
        }
    }

    fn expand(&self, travel: &Travel, exit: End) -> Vec<Node<'a>> {
        let mut with_new_place = self.map.clone();
        let new = with_new_place.places.len();
        with_new_place.places.push(travel.star);
        with_new_place.links.push((exit, (new, travel.entry.index())));
        let mut candidates = vec![Node { map: with_new_place, current: new, rotation: 0 }];
        for gateway in self.map.pending_gateways() {
            if gateway == exit {
                continue;
            }
            if let Some((current, rotation)) = self.arrive(travel, gateway) {
                let mut map = self.map.clone();
                map.links.push((exit, gateway));
                candidates.push(Node { map, current, rotation });
            }
        }
        candidates
    }

    /// The place and φ′ after arriving by `entry`, if the observed star matches the one there:
    /// φ′ takes the observed entry to `entry`.
    fn arrive(&self, travel: &Travel, entry: End) -> Option<(usize, usize)> {
        let observed = self.map.exploration.star(travel.star);
        let degree = observed.ends().len();
        isomorphisms(observed, self.map.star(entry.0))
            .into_iter()
            .find(|rotation| (travel.entry.index() + rotation) % degree == entry.1)
            .map(|rotation| (entry.0, rotation))
    }
}
