//! Hypotheses ⟨map, place, φ⟩ and the recursive step that extends them (section 2.3.1).

use std::fmt;
use std::str::FromStr;

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

/// One way in which a travel follows from a hypothesis: what a branch of the tree chooses there. A travel that
/// follows in no way refutes the hypothesis (p-nc).
///
/// The order is that of a step's successors: a new place before all closures, these by their gateways.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Derivation {
    /// p-c: the map has the link, and the star is as predicted.
    Predicted,
    /// e: the robot left by a pending gateway and came to a place it had not been at.
    NewPlace,
    /// e: the robot left by a pending gateway and is back at a place of the map, by this pending gateway.
    Closure(MapOlp),
}

/// `p`, `n`, and `c` with the number of the gateway.
impl fmt::Display for Derivation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Derivation::Predicted => f.pad("p"),
            Derivation::NewPlace => f.pad("n"),
            Derivation::Closure(gateway) => write!(f, "c{gateway}"),
        }
    }
}

/// A text that names no derivation.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("`{0}` is no derivation: write `p` (predicted), `n` (new place), or `c` and the number of a gateway")]
pub struct DerivationError(String);

impl FromStr for Derivation {
    type Err = DerivationError;

    fn from_str(text: &str) -> Result<Self, DerivationError> {
        match (text, text.strip_prefix('c').map(str::parse)) {
            ("p", _) => Ok(Derivation::Predicted),
            ("n", _) => Ok(Derivation::NewPlace),
            (_, Some(Ok(gateway))) => Ok(Derivation::Closure(MapOlp::new(gateway))),
            _ => Err(DerivationError(text.chars().take(20).collect())),
        }
    }
}

/// What a step made of a hypothesis.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The step was not applied yet.
    Open,
    /// p-c: one successor with the same map.
    Predicted,
    /// p-nc: the map has the link, but the star it leads to looks otherwise. No successor.
    Refuted,
    /// e: a successor for each consistent extension of the map; none if the axioms removed them all.
    Expanded,
}

/// By which rules hypotheses follow from one another.
#[derive(Clone, Copy, Debug)]
pub struct Rules<'a> {
    /// Which stars look alike.
    pub catalog: &'a StarCatalog,
    /// Which maps are possible.
    pub axioms: &'a Axioms,
}

/// The result of a step. One value serves many steps, so that none has to allocate.
#[derive(Clone, Debug)]
pub struct Step {
    /// What the last step made of its hypothesis.
    pub outcome: Outcome,
    /// In which ways the travel follows from it, in order.
    pub derivations: Vec<Derivation>,
    /// Successors that the axioms removed, in all steps together.
    pub removals: Removals,
}

impl Default for Step {
    fn default() -> Self {
        Step { outcome: Outcome::Open, derivations: Vec::new(), removals: Removals::default() }
    }
}

/// What [`Hypothesis::follow`] changed, for [`Hypothesis::take_back`].
#[must_use = "a hypothesis that follows a travel has to be taken back before it follows another way"]
#[derive(Debug)]
pub struct Footprint {
    before: Position,
    derivation: Derivation,
}

impl Hypothesis {
    /// The basic step: a single place with the first star, φ = identity.
    #[must_use]
    pub fn root(catalog: &StarCatalog, star: StarId) -> Self {
        Hypothesis::rooted(TopologicalMap::new(), catalog, star)
    }

    /// The same, for a search that asks for no boundary relation on its way: [`TopologicalMap::without_boundaries`].
    #[must_use]
    pub fn root_without_boundaries(catalog: &StarCatalog, star: StarId) -> Self {
        Hypothesis::rooted(TopologicalMap::without_boundaries(), catalog, star)
    }

    fn rooted(mut map: TopologicalMap, catalog: &StarCatalog, star: StarId) -> Self {
        let place = map.add_place(star, catalog.star(star));
        Hypothesis { map, position: Position { place, phi: Isomorphism::identity(catalog.star(star)) } }
    }

    /// The recursive step: in which ways `observation` follows from this hypothesis, and how many the axioms
    /// remove. The hypothesis is the same afterwards.
    pub fn step(&mut self, observation: Observation, rules: Rules<'_>, step: &mut Step) {
        let Rules { catalog, axioms } = rules;
        let Step { outcome, derivations, removals } = step;
        derivations.clear();
        let Observation { entry, star, .. } = observation;
        let exit = self.exit(observation);

        if let Some(arrival) = self.map.linked(exit) {
            *outcome = Outcome::Refuted;
            if self.looks_like(star, entry, arrival, catalog) {
                *outcome = Outcome::Predicted;
                derivations.push(Derivation::Predicted);
            }
            return;
        }

        *outcome = Outcome::Expanded;
        let exit = self.map.pending(exit).expect("the robot leaves by gateways, and this one is not linked");
        match axioms.violated_by_new_place(&self.map) {
            Some(axiom) => removals.record(axiom),
            None => derivations.push(Derivation::NewPlace),
        }
        for other in self.map.pending_gateways() {
            if other != exit && self.looks_like(star, entry, other.olp(), catalog) {
                match axioms.violated_by_closure(&self.map, exit, other) {
                    Some(axiom) => removals.record(axiom),
                    None => derivations.push(Derivation::Closure(other.olp())),
                }
            }
        }
        if axioms.consistent_boundaries {
            derivations.retain(|&derivation| {
                let footprint = self.follow(observation, derivation, catalog);
                let violated = axioms.violated_by_boundaries(&self.map);
                self.take_back(footprint);
                violated.inspect(|&axiom| removals.record(axiom)).is_none()
            });
        }
    }

    /// The oriented local path that the robot leaves by: φ(S_i :: OLP_out).
    #[must_use]
    pub fn exit(&self, observation: Observation) -> MapOlp {
        self.map.olp(self.position.place, self.position.phi.apply(observation.exit))
    }

    /// The gateway by which the robot arrives if the travel follows in that way.
    ///
    /// # Panics
    /// If the way is [`Derivation::Predicted`] and the map does not have the link.
    #[must_use]
    pub fn arrival(&self, observation: Observation, derivation: Derivation) -> MapOlp {
        match derivation {
            Derivation::Closure(gateway) => gateway,
            Derivation::NewPlace => self.map.olp_of_next_place(observation.entry),
            Derivation::Predicted => {
                self.map.linked(self.exit(observation)).expect("a travel that is predicted follows a link")
            }
        }
    }

    /// Whether the observed star, entered by `entry`, matches the star of the place that `arrival`
    /// belongs to, entered by `arrival`.
    fn looks_like(&self, star: StarId, entry: Olp, arrival: MapOlp, catalog: &StarCatalog) -> bool {
        let place = self.map.place(arrival);
        catalog.matches(star, entry, self.map.star(place), self.map.local(arrival))
    }

    /// Goes where the travel leads if it follows in that way: the map grows, the robot arrives.
    pub fn follow(
        &mut self,
        observation: Observation,
        derivation: Derivation,
        catalog: &StarCatalog,
    ) -> Footprint {
        let before = self.position;
        let arrival = self.arrival(observation, derivation);
        if derivation != Derivation::Predicted {
            self.grow(self.exit(observation), derivation, observation.star, arrival, catalog);
        }
        self.position = self.position_at(arrival, observation.entry);
        Footprint { before, derivation }
    }

    /// Takes back the last [`follow`](Self::follow) that was not taken back yet.
    pub fn take_back(&mut self, footprint: Footprint) {
        self.shrink(footprint.derivation);
        self.position = footprint.before;
    }

    /// The map grows as the derivation says. The position stays as it is.
    pub fn grow(
        &mut self,
        exit: MapOlp,
        derivation: Derivation,
        star: StarId,
        arrival: MapOlp,
        catalog: &StarCatalog,
    ) {
        if derivation == Derivation::NewPlace {
            self.map.add_place(star, catalog.star(star));
        }
        let pending = |olp| self.map.pending(olp).expect("only what is pending is linked");
        self.map.link(pending(exit), pending(arrival));
    }

    /// Takes back the last [`grow`](Self::grow) of that kind.
    pub fn shrink(&mut self, derivation: Derivation) {
        let changes = match derivation {
            Derivation::Predicted => 0,
            Derivation::Closure(_) => 1,
            Derivation::NewPlace => 2,
        };
        (0..changes).for_each(|_| self.map.retract());
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
