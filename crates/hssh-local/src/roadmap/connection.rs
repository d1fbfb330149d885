//! Connections: which places lead to one another, through which passages, and the stars that follow.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Vector2, vector};

use super::graph::{Connection, RoadNodeNumber, Roadmap, Way};
use super::options::RoadmapOptions;
use super::region::RegionPart;
use crate::place::{Gateway, LocalStar, PlaceNumber};
use crate::region::{RegionMap, RegionNumber};
use crate::skeleton::distance;

/// A chain of ways from a node, each with whether it is driven from its last end to its first.
type Chain = Vec<(usize, bool)>;

/// How the nodes of a region are reached from its places.
struct Homes {
    /// For each node the length of the way, the place, and the ways from there.
    of: BTreeMap<RoadNodeNumber, (f64, PlaceNumber, Chain)>,
}

/// A connection before the stars are known.
struct Draft {
    places: [PlaceNumber; 2],
    passages: Vec<u32>,
    chain: Chain,
    length: f64,
}

/// Finds all connections, and with them the stars of the places.
pub(super) fn connect(
    roadmap: &mut Roadmap,
    map: &RegionMap,
    parts: &[RegionPart],
    options: &RoadmapOptions,
) {
    let homes: Vec<Homes> = parts.iter().map(|part| Homes::new(roadmap, part)).collect();
    let mut drafts = within(roadmap, parts, &homes);
    drafts.extend(through(map, parts, &homes));
    drafts.extend(across(roadmap, map, parts, &homes));
    let gateways: Vec<[Gateway; 2]> = drafts.iter().map(|draft| draft.gateways(roadmap, map)).collect();
    for place in 0..roadmap.places.len() {
        let number = PlaceNumber(place as u32);
        let own =
            drafts.iter().zip(&gateways).flat_map(|(draft, gateways)| draft.places.into_iter().zip(gateways));
        let own: Vec<Gateway> =
            own.filter(|&(other, _)| other == number).map(|(_, gateway)| *gateway).collect();
        let center = roadmap.places[place].center;
        roadmap.places[place].star = LocalStar::new(center, &own, &options.place);
    }
    for (draft, gateways) in drafts.into_iter().zip(&gateways) {
        let end = |at: usize| {
            let star = roadmap.place(draft.places[at]).star.as_ref()?;
            Some((draft.places[at], star.olp_of(&gateways[at])?))
        };
        if let (Some(from), Some(to)) = (end(0), end(1)) {
            let line = draft.line(&roadmap.ways);
            let width =
                draft.chain.iter().map(|&(way, _)| roadmap.ways[way].width).fold(f64::INFINITY, f64::min);
            let ways = draft.chain.iter().map(|&(way, _)| way as u32).collect();
            let Draft { passages, length, .. } = draft;
            roadmap.connections.push(Connection { ends: [from, to], passages, ways, line, length, width });
        }
    }
}

impl Homes {
    fn new(roadmap: &Roadmap, part: &RegionPart) -> Self {
        let starts = part.places.iter().map(|&place| (roadmap.place(place).node, place));
        Homes { of: spread(starts, &roadmap.ways, &part.ways) }
    }
}

/// How nodes are reached from the nearest of some that stand for places.
fn spread(
    starts: impl Iterator<Item = (RoadNodeNumber, PlaceNumber)>,
    ways: &[Way],
    own: &[usize],
) -> BTreeMap<RoadNodeNumber, (f64, PlaceNumber, Chain)> {
    let mut at: BTreeMap<RoadNodeNumber, Vec<usize>> = BTreeMap::new();
    for &way in own {
        for end in ways[way].ends {
            at.entry(end).or_default().push(way);
        }
    }
    let mut known: BTreeMap<RoadNodeNumber, (f64, PlaceNumber, Chain)> = BTreeMap::new();
    let mut waiting: BTreeSet<(u64, RoadNodeNumber)> = BTreeSet::new();
    for (node, place) in starts {
        known.entry(node).or_insert((0.0, place, Chain::new()));
        waiting.insert((0, node));
    }
    while let Some((bits, node)) = waiting.pop_first() {
        let (here, place, chain) = known[&node].clone();
        if here.to_bits() != bits {
            continue;
        }
        for &way in at.get(&node).into_iter().flatten() {
            let is_backward = ways[way].ends[1] == node;
            let other = ways[way].ends[usize::from(!is_backward)];
            let there = here + ways[way].length;
            if known.get(&other).is_none_or(|&(least, ..)| there < least) {
                let mut onward = chain.clone();
                onward.push((way, is_backward));
                known.insert(other, (there, place, onward));
                waiting.insert((there.to_bits(), other));
            }
        }
    }
    known
}

/// The chain driven the other way.
fn reversed(chain: &Chain) -> Chain {
    chain.iter().rev().map(|&(way, is_backward)| (way, !is_backward)).collect()
}

/// Connections between places of one region: each way that leads from what is nearest to one to what is nearest to
/// another.
fn within(roadmap: &Roadmap, parts: &[RegionPart], homes: &[Homes]) -> Vec<Draft> {
    let mut drafts = Vec::new();
    for (part, homes) in parts.iter().zip(homes) {
        for &way in &part.ways {
            let [Some((before, from, start)), Some((after, to, end))] =
                roadmap.ways[way].ends.map(|end| homes.of.get(&end))
            else {
                continue;
            };
            if from != to {
                let mut chain = start.clone();
                chain.push((way, false));
                chain.extend(reversed(end));
                let length = before + roadmap.ways[way].length + after;
                drafts.push(Draft { places: [*from, *to], passages: Vec::new(), chain, length });
            }
        }
    }
    drafts
}

/// Connections through a passage between two regions that have places.
fn through(map: &RegionMap, parts: &[RegionPart], homes: &[Homes]) -> Vec<Draft> {
    let mut drafts = Vec::new();
    for (region, part) in parts.iter().enumerate() {
        for &(passage, node) in &part.passages {
            let [first, second] = map.passages[passage as usize].regions;
            if first.index() != region {
                continue;
            }
            let sides = [first, second].map(|side| homes[side.index()].of.get(&node));
            if let [Some((before, from, start)), Some((after, to, end))] = sides
                && from != to
            {
                let chain = [start.clone(), reversed(end)].concat();
                drafts.push(Draft {
                    places: [*from, *to],
                    passages: vec![passage],
                    chain,
                    length: before + after,
                });
            }
        }
    }
    drafts
}

/// Connections across a region without a place, from each of its passages to each other one.
fn across(roadmap: &Roadmap, map: &RegionMap, parts: &[RegionPart], homes: &[Homes]) -> Vec<Draft> {
    let mut drafts = Vec::new();
    for (region, part) in parts.iter().enumerate().filter(|(_, part)| part.places.is_empty()) {
        let beyond = |passage: u32| {
            let [first, second] = map.passages[passage as usize].regions;
            if first == RegionNumber(region as u32) { second } else { first }
        };
        for (at, &(passage, node)) in part.passages.iter().enumerate() {
            // The place is of no account here: only the chains are.
            let reach = spread([(node, PlaceNumber(0))].into_iter(), &roadmap.ways, &part.ways);
            for &(other, far) in &part.passages[at + 1..] {
                let Some((between, _, chain)) = reach.get(&far) else { continue };
                let sides = [(passage, node), (other, far)]
                    .map(|(passage, node)| homes[beyond(passage).index()].of.get(&node));
                if let [Some((before, from, start)), Some((after, to, end))] = sides
                    && from != to
                {
                    let chain = [start.clone(), chain.clone(), reversed(end)].concat();
                    let length = before + between + after;
                    drafts.push(Draft {
                        places: [*from, *to],
                        passages: vec![passage, other],
                        chain,
                        length,
                    });
                }
            }
        }
    }
    drafts
}

impl Draft {
    /// The gateways of the two places, for somebody who leaves them.
    fn gateways(&self, roadmap: &Roadmap, map: &RegionMap) -> [Gateway; 2] {
        let line = self.line(&roadmap.ways);
        let (Some(&first), Some(&last)) = (self.passages.first(), self.passages.last()) else {
            let middle = Middle::of(&line, self.length / 2.0);
            let width =
                self.chain.iter().map(|&(way, _)| roadmap.ways[way].width).fold(f64::INFINITY, f64::min);
            return [1.0, -1.0].map(|sign| Gateway::across(middle.point, sign * middle.direction, width));
        };
        [(first, 0), (last, 1)].map(|(passage, end)| {
            let passage = &map.passages[passage as usize];
            let is_outward = passage.regions[0] == roadmap.place(self.places[end]).region;
            if is_outward { passage.gateway } else { passage.gateway.reversed() }
        })
    }

    /// The corners of the line from place to place.
    fn line(&self, ways: &[Way]) -> Vec<[f64; 2]> {
        let mut line: Vec<[f64; 2]> = Vec::new();
        for &(way, is_backward) in &self.chain {
            let mut points = ways[way].line.clone();
            if is_backward {
                points.reverse();
            }
            let known = usize::from(!line.is_empty());
            line.extend(points.into_iter().skip(known));
        }
        line
    }
}

/// A point along a line.
struct Middle {
    point: [f64; 2],
    direction: Vector2<f64>,
}

impl Middle {
    /// The point `along` metres from the beginning of a line.
    fn of(line: &[[f64; 2]], along: f64) -> Self {
        let mut left = along;
        let mut found =
            Middle { point: line.first().copied().unwrap_or_default(), direction: vector![1.0, 0.0] };
        for pair in line.windows(2) {
            let length = distance(pair[0], pair[1]);
            let direction = (Vector2::from(pair[1]) - Vector2::from(pair[0])) / length.max(f64::MIN_POSITIVE);
            let point = Vector2::from(pair[0]) + direction * left.min(length);
            found = Middle { point: point.into(), direction };
            if left <= length {
                break;
            }
            left -= length;
        }
        found
    }
}
