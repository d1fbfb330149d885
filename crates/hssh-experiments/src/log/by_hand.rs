//! What was found by hand of the building of a log, and how much of it the best map has.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use hssh::answer::Answer;

use crate::aces::topology::{self, Topology, Visit};
use crate::table::aligned;

/// A log, and the topology that the robot travelled.
const KNOWN: [(&str, &str); 1] = [("intel", include_str!("../../../../fixtures/intel-topology.txt"))];
/// Corridors are passed within a scan or two: the map's visit may be so many scans off.
const OFF: usize = 2;

/// A best map beside what was found by hand.
pub(super) struct ByHand {
    name: &'static str,
    /// Rooms that the robot entered, and those of them with a place of their own.
    rooms: [usize; 2],
    /// Rooms without one.
    missing: Vec<String>,
    /// Times that the robot came back to a place of a corridor and the map has a visit both times; those of them at which both are to one place.
    returns: [usize; 2],
}

impl ByHand {
    /// Of a log of which something was found by hand, if there is a map.
    pub(super) fn of(name: &'static str, answer: &Answer) -> Result<Option<Self>, String> {
        let Some((_, text)) = KNOWN.iter().find(|(log, _)| *log == name) else { return Ok(None) };
        let topology = topology::read(text)?;
        let visited = answer.visits.iter().filter_map(|visit| Some((visit.scan? as usize, visit.place?)));
        let visited: Vec<(usize, u32)> = visited.collect();
        if visited.is_empty() {
            return Ok(None);
        }
        let (rooms, missing) = rooms(&topology, &visited);
        Ok(Some(ByHand { name, rooms, missing, returns: returns(&topology, &visited) }))
    }
}

/// How many rooms were entered, how many have a place of their own, and which have none.
fn rooms(topology: &Topology, visited: &[(usize, u32)]) -> ([usize; 2], Vec<String>) {
    let mut places: BTreeMap<usize, BTreeSet<u32>> = BTreeMap::new();
    for visit in &topology.visits {
        places.entry(visit.place).or_default().extend(seen_during(visit, visited, 0));
    }
    let is_own = |room: usize, place: u32| {
        places.iter().all(|(&other, places)| other == room || !places.contains(&place))
    };
    let names = &topology.network.crossings;
    let all = || places.iter().filter(|&(&place, _)| is_room(&names[place].name));
    let missing = all().filter(|&(&room, places)| !places.iter().any(|&place| is_own(room, place)));
    let missing: Vec<String> = missing.map(|(&room, _)| names[room].name.clone()).collect();
    ([all().count(), all().count() - missing.len()], missing)
}

/// How often the robot came back to a place of a corridor, and how often the map has one place for both visits.
fn returns(topology: &Topology, visited: &[(usize, u32)]) -> [usize; 2] {
    let (mut all, mut joined) = (0, 0);
    let mut last: BTreeMap<usize, &Visit> = BTreeMap::new();
    for visit in &topology.visits {
        if is_room(&topology.network.crossings[visit.place].name) {
            continue;
        }
        if let Some(before) = last.insert(visit.place, visit) {
            let [before, now] = [before, visit].map(|visit| seen_during(visit, visited, OFF));
            all += usize::from(!before.is_empty() && !now.is_empty());
            joined += usize::from(!before.is_disjoint(&now));
        }
    }
    [all, joined]
}

/// Rooms have capital letters.
fn is_room(name: &str) -> bool {
    name.starts_with(char::is_uppercase)
}

/// The places of the map that were visited during a visit that was found by hand.
fn seen_during(visit: &Visit, visited: &[(usize, u32)], off: usize) -> BTreeSet<u32> {
    let is_during = |scan: usize| {
        visit.scans.iter().any(|scans: &RangeInclusive<usize>| {
            (scans.start().saturating_sub(off)..=scans.end() + off).contains(&scan)
        })
    };
    visited.iter().filter(|(scan, _)| is_during(*scan)).map(|&(_, place)| place).collect()
}

/// The table of all that were found.
pub(super) fn table(all: &[ByHand]) -> String {
    let header =
        ["log", "rooms entered", "with a place of their own", "returns", "to one place", "without a place"];
    let row = |one: &ByHand| {
        let ByHand { name, rooms, missing, returns } = one;
        let mut row = vec![(*name).to_owned()];
        row.extend(rooms.iter().chain(returns).map(usize::to_string));
        row.push(missing.join(" "));
        row
    };
    let rows: Vec<Vec<String>> =
        std::iter::once(header.map(str::to_owned).to_vec()).chain(all.iter().map(row)).collect();
    format!(
        "the best map against what was found by hand: rooms that were entered, and returns to places of corridors\n{}",
        aligned(&rows)
    )
}

#[cfg(test)]
mod tests {
    use hssh_causal::Exploration;
    use hssh_world::PlaceId;

    use super::*;

    /// A walk from a corridor into a room, on to another place, and back.
    const WALK: &str = "PLACE a 0 0\nPLACE b 9 0\nPLACE R 0 5\nEDGE a b\nEDGE a R\n\
                        VISIT a 0 2\nVISIT R 4 6\nVISIT a 8 9\nVISIT b 20 21\nVISIT a 30 31\n";

    #[test]
    fn rooms_have_places_of_their_own_and_returns_one_place() {
        let topology = topology::read(WALK).unwrap();
        let right = [(1, 0), (5, 1), (9, 0), (20, 2), (30, 0)];
        assert_eq!(rooms(&topology, &right), ([1, 1], Vec::new()));
        assert_eq!(returns(&topology, &right), [2, 2]);
        // The room taken for the corridor, and another place at the end.
        let wrong = [(1, 0), (5, 0), (9, 0), (20, 2), (30, 3)];
        assert_eq!(rooms(&topology, &wrong), ([1, 0], vec!["R".to_owned()]));
        assert_eq!(returns(&topology, &wrong), [2, 1]);
    }

    /// `fixtures/intel.ron` is the exploration of that topology, by its stars alone.
    #[test]
    fn the_exploration_of_the_intel_lab_is_that_of_its_topology() {
        let topology = topology::read(KNOWN[0].1).unwrap();
        let world = topology.network.to_world().unwrap();
        let places: Vec<PlaceId> = topology.visits.iter().map(|visit| PlaceId(visit.place as u32)).collect();
        let explored = world.explore(&world.route_through(&places).unwrap()).unwrap();
        let fixture = std::fs::read_to_string(crate::root::fixtures().join("intel.ron")).unwrap();
        assert_eq!(Exploration::from_ron(&fixture).unwrap(), explored);
    }
}
