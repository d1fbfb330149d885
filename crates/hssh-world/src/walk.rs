//! Routes drawn at random: a walk, and a walk that leaves no link untravelled.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::route::{Route, RouteError};
use crate::world::{PlaceId, World, WorldOlp};

/// A random walk of at most `travels` travels from a random place.
///
/// Gateways are drawn uniformly, but the robot turns back only at dead ends. The walk is shorter
/// only if it starts at a place without gateways. The same arguments give the same walk.
#[must_use]
pub fn random_walk(world: &World, travels: usize, seed: u64) -> Route {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let start = random_place(world, &mut random);
    let mut exits = Vec::new();
    let mut entry: Option<WorldOlp> = None;
    while exits.len() < travels {
        let here = entry.map_or(start, |entry| entry.place);
        let onward: Vec<WorldOlp> =
            world.gateways_of(here).filter(|&gateway| Some(gateway) != entry).collect();
        let Some(exit) = onward.choose(&mut random).copied().or(entry) else { break };
        exits.push(exit.olp);
        entry = world.neighbor(exit);
    }
    Route { start, exits }
}

/// A walk from a random place that takes every link at least once.
///
/// At each place it leaves by a random gateway of an untravelled link; if there is none, it goes
/// the fewest travels to a place that has one. The same arguments give the same walk.
///
/// # Errors
/// If the world is not connected.
pub fn cover(world: &World, seed: u64) -> Result<Route, RouteError> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let start = random_place(world, &mut random);
    let mut travelled = BTreeSet::new();
    let mut exits = Vec::new();
    let mut here = start;
    while travelled.len() < world.links().len() {
        let untravelled: Vec<WorldOlp> = world
            .gateways_of(here)
            .filter(|&gateway| world.link_index(gateway).is_some_and(|link| !travelled.contains(&link)))
            .collect();
        let ahead = match untravelled.choose(&mut random) {
            Some(&exit) => vec![exit],
            None => way_to_untravelled(world, here, &travelled).ok_or(RouteError::NotConnected {
                start: start.0,
                travelled: travelled.len(),
                links: world.links().len(),
            })?,
        };
        for exit in ahead {
            exits.push(exit.olp);
            travelled.extend(world.link_index(exit));
            here = world.neighbor(exit).map_or(here, |entry| entry.place);
        }
    }
    Ok(Route { start, exits })
}

/// The fewest gateways to take one after another, the last of them of an untravelled link.
fn way_to_untravelled(world: &World, from: PlaceId, travelled: &BTreeSet<usize>) -> Option<Vec<WorldOlp>> {
    // Most ways are short, however large the world.
    let mut reached_by: BTreeMap<PlaceId, WorldOlp> = BTreeMap::new();
    let mut frontier = VecDeque::from([from]);
    while let Some(here) = frontier.pop_front() {
        for exit in world.gateways_of(here) {
            if world.link_index(exit).is_some_and(|link| !travelled.contains(&link)) {
                let back = std::iter::successors(Some(exit), |gateway: &WorldOlp| {
                    reached_by.get(&gateway.place).copied()
                });
                let mut way: Vec<WorldOlp> = back.collect();
                way.reverse();
                return Some(way);
            }
            let Some(far) = world.neighbor(exit) else { continue };
            if far.place != from && !reached_by.contains_key(&far.place) {
                reached_by.insert(far.place, exit);
                frontier.push_back(far.place);
            }
        }
    }
    None
}

fn random_place(world: &World, random: &mut ChaCha8Rng) -> PlaceId {
    PlaceId(random.random_range(0..world.places().len() as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{grid, random_planar};

    #[test]
    fn covering_walks_take_every_link() {
        for seed in 0..50 {
            let world = random_planar(2 + seed as u32 % 20, 0.5, 10.0, seed).unwrap();
            let route = cover(&world, seed).unwrap();
            let crossings = world.follow_route(&route).unwrap();
            let links: BTreeSet<_> = crossings.iter().map(|&(exit, _)| world.link_index(exit)).collect();
            assert_eq!(links.len(), world.links().len());
            assert_eq!(cover(&world, seed), Ok(route));
        }
    }

    #[test]
    fn random_walks_turn_back_only_at_dead_ends() {
        for seed in 0..50 {
            let world = random_planar(12, 0.3, 10.0, seed).unwrap();
            let route = random_walk(&world, 40, seed);
            assert_eq!(route.exits.len(), 40);
            let crossings = world.follow_route(&route).unwrap();
            for pair in crossings.windows(2) {
                let (entry, exit) = (pair[0].1, pair[1].0);
                assert!(entry != exit || world.gateways_of(entry.place).count() == 1);
            }
        }
        assert_eq!(random_walk(&grid(1, 1, 8.0).unwrap(), 5, 0).exits, []);
    }
}
