//! What tells two maps of one exploration apart: the visit where they part, and a way to find out which is right.

use std::collections::{BTreeSet, VecDeque};

use hssh_topology::{Hypothesis, Isomorphism, MapOlp, Olp, PlaceId, Position, StarCatalog, StarId};

/// Where two maps part, and the shortest way from the robot's place on which they predict different things.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Distinction {
    /// The first visit that they take to be at different places, or that they see a place's star turned
    /// differently on. `None` if they are one and the same map.
    pub parting: Option<Parting>,
    /// The travels to make. `None` if no way through known links tells the two apart.
    pub test: Option<Test>,
}

/// The first visit on which two maps disagree.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Parting {
    /// The visit, the start being 0.
    pub visit: usize,
    /// Where the robot was, in either map.
    pub positions: [Position; 2],
}

/// Travels from where the robot is, the last of which the two maps say different things about.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Test {
    /// The gateways to leave by, one after the other, as gateways of the first map.
    pub exits: Vec<MapOlp>,
    /// What the first map says that the last travel shows, and what the second says.
    pub predictions: [Prediction; 2],
}

/// What a map says about a travel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Prediction {
    /// It leads to this place, which has this star, entered by this end of it.
    Arrival {
        /// The place.
        place: PlaceId,
        /// Its star.
        star: StarId,
        /// The end.
        entry: Olp,
    },
    /// The gateway is pending: it may lead anywhere.
    Unknown,
}

/// Two places that the robot may be at, if the one map is right or the other, with the olps of the first
/// taken to those of the second.
type Doubt = (PlaceId, PlaceId, Isomorphism);

/// Compares two hypotheses about the same exploration, `visits` being where the robot was in each.
#[must_use]
pub fn distinguish(
    catalog: &StarCatalog,
    hypotheses: [&Hypothesis; 2],
    visits: [&[Position]; 2],
) -> Distinction {
    let mut pairs = visits[0].iter().zip(visits[1]).enumerate();
    let parting = pairs.find(|(_, (first, second))| first != second);
    let parting = parting.map(|(visit, (first, second))| Parting { visit, positions: [*first, *second] });
    Distinction { parting, test: shortest_test(catalog, hypotheses) }
}

/// Breadth-first through the pairs of places that the robot can be at; a pair of predictions that exclude one
/// another is better than one of which the first or second map leaves things open.
fn shortest_test(catalog: &StarCatalog, [first, second]: [&Hypothesis; 2]) -> Option<Test> {
    let to_second = second.position.phi.after(first.position.phi.inverse());
    let start: Doubt = (first.position.place, second.position.place, to_second);
    let (mut queue, mut seen) = (VecDeque::from([(start, Vec::new())]), BTreeSet::from([start]));
    let mut vague: Option<Test> = None;
    while let Some(((here, there, phi), way)) = queue.pop_front() {
        for exit in first.map.olps_of(here).filter(|&olp| first.map.dart(olp).is_some()) {
            let twin = second.map.olp(there, phi.apply(first.map.local(exit)));
            let predictions = [prediction(first, exit), prediction(second, twin)];
            let exits = [way.as_slice(), &[exit]].concat();
            let [
                Prediction::Arrival { place, star, entry },
                Prediction::Arrival { place: other, star: twin, entry: end },
            ] = predictions
            else {
                if predictions[0] != predictions[1] && vague.is_none() {
                    vague = Some(Test { exits, predictions });
                }
                continue;
            };
            if !catalog.matches(star, entry, twin, end) {
                return Some(Test { exits, predictions });
            }
            let phi = Isomorphism::anchored(catalog.star(star), entry, catalog.star(twin), end)?;
            if seen.insert((place, other, phi)) {
                queue.push_back(((place, other, phi), exits));
            }
        }
    }
    vague
}

fn prediction(hypothesis: &Hypothesis, exit: MapOlp) -> Prediction {
    let map = &hypothesis.map;
    match map.linked(exit) {
        None => Prediction::Unknown,
        Some(arrival) => {
            let place = map.place(arrival);
            Prediction::Arrival { place, star: map.star(place), entry: map.local(arrival) }
        }
    }
}
