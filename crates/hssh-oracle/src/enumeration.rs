//! Breadth-first enumeration of all maps that explain an exploration (sections 2.3.1, 3.3, 3.4).

use std::collections::BTreeMap;

use hssh_causal::{Exploration, StarType};

use crate::axiom::{Axiom, Rules};
use crate::facts::{Facts, Value};
use crate::map::{End, Map};
use crate::step::{Node, Step};

/// What one travel brought; level 0 is the root.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Level {
    /// Hypotheses alive after the travel.
    pub nodes: usize,
    /// Maps built by it; a predicted child shares its parent's map and builds none.
    pub maps: usize,
    /// Candidates it rejected, under the first axiom they violate.
    pub removed: BTreeMap<Axiom, usize>,
    /// Hypotheses of the level before that it refuted (p-nc).
    pub refuted: usize,
}

/// The quantities of equation (3.1) at a planar hypothesis whose exit is pending.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Expansion {
    /// The travel, counted from 1: the children stand on this level.
    pub level: usize,
    /// p: pending gateways, the exit among them.
    pub pending: usize,
    /// pᵢ: those that lie in the exit's face, the exit among them.
    pub pending_in_face: usize,
    /// f: faces; 1 when there are no links.
    pub faces: usize,
    /// m: matches ever made between existing places.
    pub matches: usize,
    /// b: children under all rules but the bound on the genus; 0 if the other rules reject all.
    pub children: usize,
    /// b_p: the planar ones among them.
    pub planar_children: usize,
}

/// A hypothesis at full depth.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FinalMap {
    /// The star type of every place, in order of creation.
    pub places: Vec<StarType>,
    /// The links, sorted, the smaller end of each first.
    pub links: Vec<(End, End)>,
    /// The current place.
    pub current: usize,
    /// The isomorphism from the last observed star, as a rotation.
    pub rotation: usize,
    /// What is counted about the map.
    pub facts: Facts,
}

/// The result of [`enumerate`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Enumeration {
    /// One level for the root and one for each travel.
    pub levels: Vec<Level>,
    /// The expansions of planar hypotheses, in the order in which they were made.
    pub expansions: Vec<Expansion>,
    /// The hypotheses at full depth, in the order in which they were made.
    pub final_maps: Vec<FinalMap>,
}

/// All hypotheses that explain an exploration under the rules, level by level.
///
/// The rules judge candidates of the step (e); the root is not judged.
#[must_use]
pub fn enumerate(exploration: &Exploration, rules: &Rules) -> Enumeration {
    let mut nodes = vec![Node::root(exploration)];
    let mut levels = vec![Level { nodes: 1, maps: 1, ..Level::default() }];
    let mut expansions = Vec::new();
    for travel in exploration.travels() {
        let mut level = Level::default();
        let mut next = Vec::new();
        for node in &nodes {
            match node.step(travel) {
                Step::Predicted(child) => next.push(child),
                Step::Refuted => level.refuted += 1,
                Step::Expanded { exit, candidates } => {
                    if node.map.rotation_system().genus() == 0 {
                        expansions.push(expansion(&node.map, exit, levels.len(), &candidates, rules));
                    }
                    for candidate in candidates {
                        if let Some(axiom) = rules.first_violation(&candidate.map) {
                            *level.removed.entry(axiom).or_default() += 1;
                        } else {
                            level.maps += 1;
                            next.push(candidate);
                        }
                    }
                }
            }
        }
        level.nodes = next.len();
        levels.push(level);
        nodes = next;
    }
    Enumeration { levels, expansions, final_maps: nodes.into_iter().map(final_map).collect() }
}

fn expansion(map: &Map, exit: End, level: usize, candidates: &[Node], rules: &Rules) -> Expansion {
    let pending_by_face = map.pending_by_face();
    let face_of_exit = pending_by_face.iter().find(|face| face.contains(&exit));
    let other_rules = Rules { genus_bound: None, ..rules.clone() };
    let children: Vec<&Map> = candidates
        .iter()
        .map(|child| &child.map)
        .filter(|child| other_rules.first_violation(child).is_none())
        .collect();
    Expansion {
        level,
        pending: pending_by_face.iter().map(Vec::len).sum(),
        pending_in_face: face_of_exit.expect("the exit is pending, so it lies in a face").len(),
        faces: pending_by_face.len(),
        matches: map.matches(),
        children: children.len(),
        planar_children: children.iter().filter(|child| child.rotation_system().genus() == 0).count(),
    }
}

fn final_map(node: Node) -> FinalMap {
    let facts = Facts::of(&node.map);
    let mut links: Vec<(End, End)> = node.map.links.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
    links.sort_unstable();
    FinalMap { places: node.map.places, links, current: node.current, rotation: node.rotation, facts }
}

impl FinalMap {
    /// The map, to ask it more; `exploration` is the one that was enumerated.
    #[must_use]
    pub fn map<'a>(&self, exploration: &'a Exploration) -> Map<'a> {
        Map { exploration, places: self.places.clone(), links: self.links.clone() }
    }
}

impl Enumeration {
    /// Hypotheses on all levels, the root among them.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.levels.iter().map(|level| level.nodes).sum()
    }

    /// Maps built on all levels.
    #[must_use]
    pub fn maps(&self) -> usize {
        self.levels.iter().map(|level| level.maps).sum()
    }

    /// Final maps without a pending gateway.
    #[must_use]
    pub fn closed(&self) -> usize {
        self.count(|facts| facts.closed)
    }

    /// Final maps in which no pending gateway lies on a path with only one place: the published
    /// tables' "closed".
    #[must_use]
    pub fn nearly_closed(&self) -> usize {
        self.count(|facts| facts.nearly_closed)
    }

    /// Final maps without a pending gateway that are qualitatively perpendicular.
    #[must_use]
    pub fn closed_and_perpendicular(&self) -> usize {
        self.count(|facts| facts.closed && facts.perpendicular)
    }

    /// The smallest value among the final maps and how many have it, if there is a final map.
    #[must_use]
    pub fn optimum(&self) -> Option<(Value, usize)> {
        let best = self.final_maps.iter().map(|last| last.facts.value).min()?;
        Some((best, self.count(|facts| facts.value == best)))
    }

    fn count(&self, holds: impl Fn(&Facts) -> bool) -> usize {
        self.final_maps.iter().filter(|last| holds(&last.facts)).count()
    }
}
