//! Breadth-first's final maps as models of the theory.

use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_search::{Limits, Mapper, RankedMap};
use hssh_topology::{Axioms, BoundaryRelation, MapOlp, Measure, PlaceId, TopologicalMap};

use super::facts;
use super::model::{Model, Moment, Side, firsts};

/// The final maps of one search.
pub(super) struct Finals {
    /// All of them, in order of preference.
    pub(super) models: Vec<Model>,
    /// How many places of each lie on both sides of some path, summed over paths.
    pub(super) contradictions: Vec<u32>,
    /// How many of them are optimal.
    pub(super) optimal: usize,
    /// The measure of these.
    pub(super) best: Option<Measure>,
    /// Seconds of the search alone.
    pub(super) seconds: f64,
}

impl Finals {
    /// How many places the smallest map has; 1 if there is none.
    pub(super) fn fewest_places(&self) -> u32 {
        let places = |model: &Model| model.places.iter().filter(|(stay, first)| stay == first).count();
        self.models.iter().map(places).min().unwrap_or(1) as u32
    }
}

/// All maps that explain an exploration.
pub(super) fn finals(exploration: &Exploration, axioms: Axioms) -> Result<Finals, Box<dyn Error>> {
    let started = Instant::now();
    let mapper = Mapper::builder().axioms(axioms).explain(exploration)?;
    let maps = mapper.maps(usize::MAX);
    let seconds = started.elapsed().as_secs_f64();
    let best = maps.first().map(|map| map.measure);
    let value = |map: &RankedMap| {
        let Measure { undetermined_boundaries, paths, places, .. } = map.measure;
        (undetermined_boundaries, paths, places)
    };
    let optimal = maps.iter().take_while(|map| value(map) == value(&maps[0])).count();
    let (models, contradictions) = maps.iter().map(|map| model(&mapper, map, exploration)).unzip();
    Ok(Finals { models, contradictions, optimal, best, seconds })
}

/// How many travels of an exploration are explained before any level of its tree has more than so many maps.
pub(super) fn tractable(
    exploration: &Exploration,
    axioms: Axioms,
    most: u64,
) -> Result<usize, Box<dyn Error>> {
    let limits = Limits { nodes: Some(10 * most), ..Limits::default() };
    let mapper = Mapper::builder().axioms(axioms).limits(limits).explain(exploration)?;
    let report = mapper.report();
    let levels = report.levels.iter().take(report.explained as usize + 1);
    Ok(levels.take_while(|level| level.nodes <= most).count().saturating_sub(1))
}

/// A map with its names replaced by moments, and how many of its boundary relations contradict.
fn model(mapper: &Mapper, ranked: &RankedMap, exploration: &Exploration) -> (Model, u32) {
    let map = &mapper.hypothesis(ranked.node).map;
    let visits = mapper.visits(ranked.node);
    let seen = visits.iter().flat_map(|visit| {
        let observed = (0..map.olps_of(visit.place).len() as u32).map(hssh_topology::Olp::new);
        observed.map(|end| map.olp(visit.place, visit.phi.apply(end)))
    });
    let ends: Vec<MapOlp> = seen.collect();
    let openings = facts::openings(exploration);
    let places: Vec<PlaceId> = visits.iter().map(|visit| visit.place).collect();
    let first_stays = firsts(&places);

    let mut naming = Naming { map, state: BTreeMap::new(), place: BTreeMap::new() };
    for (moment, &end) in (0..).zip(&ends) {
        naming.state.entry(end).or_insert(moment);
    }
    for (&place, &opening) in places.iter().zip(&openings) {
        naming.place.entry(place).or_insert(opening);
    }
    let mut model = Model {
        states: (0..).zip(ends.iter().map(|end| naming.state[end])).collect(),
        places: openings
            .iter()
            .copied()
            .zip(first_stays.iter().map(|&stay| openings[stay as usize]))
            .collect(),
        ..Model::default()
    };
    let contradictions = naming.add_paths(&mut model);
    (model, contradictions)
}

/// By which moments the ends and places of a map are named.
struct Naming<'a> {
    map: &'a TopologicalMap,
    state: BTreeMap<MapOlp, Moment>,
    place: BTreeMap<PlaceId, Moment>,
}

impl Naming<'_> {
    /// Adds paths, their orders and boundary relations; returns how many places lie on both sides of a path.
    fn add_paths(&self, model: &mut Model) -> u32 {
        let mut contradictions = 0;
        for course in self.map.courses() {
            let along: Vec<Moment> = course.downstream.iter().map(|end| self.state[end]).collect();
            let opposite = |&end: &MapOlp| self.state[&self.map.opposite(end)];
            let against: Vec<Moment> = course.downstream.iter().rev().map(opposite).collect();
            for directed in [&along, &against] {
                for (position, &from) in directed.iter().enumerate() {
                    let ahead = if course.circular { &directed[..] } else { &directed[position + 1..] };
                    model.onward.extend(ahead.iter().map(|&to| (from, to)));
                }
            }
            // The first of its states says which way is downstream.
            let is_along = along.iter().min() < against.iter().min();
            let downstream = if is_along { along } else { against };
            let path = *downstream.iter().min().expect("a path has a place");
            model.downstream.extend(downstream.iter().map(|&state| (path, state)));
            for (&place, &name) in &self.place {
                let right = if is_along { Side::Right } else { Side::Left };
                let left = if is_along { Side::Left } else { Side::Right };
                match self.map.boundary_relation(course.path, place) {
                    BoundaryRelation::Right => drop(model.sides.insert((path, right, name))),
                    BoundaryRelation::Left => drop(model.sides.insert((path, left, name))),
                    BoundaryRelation::Both => contradictions += 1,
                    BoundaryRelation::On | BoundaryRelation::Neither => {}
                }
            }
        }
        contradictions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// North from a crossing to another, back, and east to a third.
    #[test]
    fn maps_are_named_by_moments() {
        let text = r#"(
            stars: {"+": ["0+", "1+", "0-", "1-"], "end": ["0+", "0- closed"]},
            start: "+",
            travels: [
                (exit: "0+", entry: "0-", star: "+"),
                (exit: "0-", entry: "0+", star: "+"),
                (exit: "1+", entry: "0+", star: "end"),
            ],
        )"#;
        let exploration = Exploration::from_ron(text).unwrap();
        let found = finals(&exploration, Axioms::default()).unwrap();
        assert_eq!((found.models.len(), found.optimal, found.fewest_places()), (1, 1, 3));
        let model = &found.models[0];
        // Moments 0 to 3 are the first crossing's ends, 4 to 7 the second's, 8 to 11 the first's again, 12 and 13 the
        // dead end's.
        let states: Vec<Moment> = model.states.values().copied().collect();
        assert_eq!(states, [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13]);
        assert_eq!(model.places, BTreeMap::from([(0, 0), (4, 4), (8, 0), (12, 12)]));
        assert_eq!(model.onward.iter().copied().collect::<Vec<_>>(), [(0, 4), (1, 13), (6, 2), (12, 3)]);
        let downstream = [(0, 0), (0, 4), (1, 1), (1, 13), (5, 5)];
        assert_eq!(model.downstream.iter().copied().collect::<Vec<_>>(), downstream);
        // The dead end is right of the way north, the second crossing left of the way east; and the first crossing, which is
        // south of the path across the second, right of it as one looks east.
        let sides = [(0, Side::Right, 12), (1, Side::Left, 4), (5, Side::Right, 0)];
        assert_eq!(model.sides.iter().copied().collect::<Vec<_>>(), sides);
    }
}
