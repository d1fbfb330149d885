//! Hypotheses ⟨map, place, φ⟩ and the recursive step that extends them (section 2.3.1).

use serde::{Deserialize, Serialize};

use crate::axioms::{Axioms, Removals};
use crate::catalog::StarCatalog;
use crate::ids::{MapOlp, Olp, PlaceId, StarId};
use crate::isomorphism::Isomorphism;
use crate::map::TopologicalMap;

/// What one travel shows: the robot left by `exit` of the star it saw last, and came by `entry` into
/// a place with the star `star`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub struct Observation {
    /// An end of the star observed before.
    pub exit: Olp,
    /// An end of the star observed now.
    pub entry: Olp,
    /// The star observed now.
    pub star: StarId,
}

/// Where the robot is in a map: the current place, and φ from the star observed last to its star.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub struct Position {
    /// The current place.
    pub place: PlaceId,
    /// From the star as observed to the star as it stands in the map.
    pub phi: Isomorphism,
}

/// A map with a place in it: one explanation of an exploration.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    /// The map.
    pub map: TopologicalMap,
    /// Where the robot is.
    pub position: Position,
}

/// How an observation follows from a hypothesis.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Derivation {
    /// p-c: the map has the link, and the star is as predicted. The robot arrives by this gateway.
    PredictedConsistent(MapOlp),
    /// p-nc: the map has the link, but the star it leads to looks otherwise.
    PredictedInconsistent,
    /// e: the exit, this gateway, is pending; every successor is an [`Extension`] of the map.
    Expand(MapOlp),
}

/// How a map grows when the robot leaves it by a pending gateway.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub enum Extension {
    /// The robot came to a place it had not been at.
    NewPlace,
    /// The robot is back at a place of the map, by this pending gateway.
    Closure(MapOlp),
}

impl Hypothesis {
    /// The basic step: a single place with the first star, φ = identity.
    #[must_use]
    pub fn root(catalog: &StarCatalog, star: StarId) -> Self {
        let mut map = TopologicalMap::new();
        let place = map.add_place(star, catalog.star(star));
        Hypothesis { map, position: Position { place, phi: Isomorphism::identity(catalog.star(star)) } }
    }

    /// The recursive step: how `observation` follows from this hypothesis. If the exit is pending,
    /// `extensions` becomes the list of all consistent extensions that the axioms admit, the new
    /// place first and then closures in the order of their gateways; `removals` counts the rest.
    pub fn step(
        &mut self,
        observation: Observation,
        catalog: &StarCatalog,
        axioms: &Axioms,
        extensions: &mut Vec<Extension>,
        removals: &mut Removals,
    ) -> Derivation {
        extensions.clear();
        let Observation { exit, entry, star } = observation;
        let exit = self.map.olp(self.position.place, self.position.phi.apply(exit)); // φ(S_i :: OLP_out)

        if let Some(arrival) = self.map.linked(exit) {
            return if self.looks_like(star, entry, arrival, catalog) {
                Derivation::PredictedConsistent(arrival)
            } else {
                Derivation::PredictedInconsistent
            };
        }

        let exit = self.map.pending(exit).expect("the robot leaves by gateways, and this one is not linked");
        match axioms.violated_by_new_place(&self.map) {
            Some(axiom) => removals.record(axiom),
            None => extensions.push(Extension::NewPlace),
        }
        for other in self.map.pending_gateways() {
            if other != exit && self.looks_like(star, entry, other.olp(), catalog) {
                match axioms.violated_by_closure(&self.map, exit, other) {
                    Some(axiom) => removals.record(axiom),
                    None => extensions.push(Extension::Closure(other.olp())),
                }
            }
        }
        if axioms.consistent_boundaries {
            extensions.retain(|&extension| {
                self.extend(exit.olp(), extension, observation, catalog);
                let violated = axioms.violated_by_boundaries(&self.map);
                self.retract(extension);
                violated.inspect(|&axiom| removals.record(axiom)).is_none()
            });
        }
        Derivation::Expand(exit.olp())
    }

    /// Whether the observed star, entered by `entry`, matches the star of the place that `arrival`
    /// belongs to, entered by `arrival`.
    fn looks_like(&self, star: StarId, entry: Olp, arrival: MapOlp, catalog: &StarCatalog) -> bool {
        let place = self.map.place(arrival);
        catalog.matches(star, entry, self.map.star(place), self.map.local(arrival))
    }

    /// Extends the map from the pending gateway `exit`; the gateway that the robot arrives by. The
    /// position stays as it is.
    pub fn extend(
        &mut self,
        exit: MapOlp,
        extension: Extension,
        observation: Observation,
        catalog: &StarCatalog,
    ) -> MapOlp {
        let arrival = match extension {
            Extension::Closure(gateway) => gateway,
            Extension::NewPlace => {
                let place = self.map.add_place(observation.star, catalog.star(observation.star));
                self.map.olp(place, observation.entry)
            }
        };
        let pending = |olp| self.map.pending(olp).expect("only what is pending is extended");
        self.map.link(pending(exit), pending(arrival));
        arrival
    }

    /// Takes back the last [`extend`](Self::extend).
    pub fn retract(&mut self, extension: Extension) {
        self.map.retract();
        if extension == Extension::NewPlace {
            self.map.retract();
        }
    }

    /// Puts the robot at the place that it reaches by the gateway `arrival`, having seen there a star
    /// that it entered by `entry`.
    pub fn arrive(&mut self, arrival: MapOlp, entry: Olp) {
        self.position = self.position_at(arrival, entry);
    }

    /// Where the robot is if it reached a place by the gateway `arrival`, having seen there a star that it
    /// entered by `entry`.
    #[must_use]
    pub fn position_at(&self, arrival: MapOlp, entry: Olp) -> Position {
        let place = self.map.place(arrival);
        let degree = self.map.olps_of(place).len() as u32;
        Position { place, phi: Isomorphism::rotating(entry, self.map.local(arrival), degree) }
    }
}
