//! Any bytes as growth of a map and its reversal: everything carried along is what its definition says.

#![no_main]

use hssh_topology::{PendingGateway, Star, StarCatalog, TopologicalMap};
use libfuzzer_sys::fuzz_target;

/// Ways to go on, with loops at a place, dead ends and paths that turn among them.
const STARS: [&str; 8] = [
    "0+ 1+ 0- 1-",
    "0+ (1+) 0- 1-",
    "0+ 1+ (0-) (1-)",
    "0+ 0-",
    "0+ (0-)",
    "0+ 1+ 2+ 0- 1- 2-",
    "0+ 0- 1+ 1-",
    "2+ 0+ 1- (2-) 1+ 0-",
];

/// A check takes quadratic time.
const MOST_PLACES: u32 = 24;

fuzz_target!(|bytes: &[u8]| {
    let stars = STARS.map(|text| text.parse::<Star>().expect("these are stars"));
    let mut catalog = StarCatalog::new();
    let mut map = TopologicalMap::new();
    let mut past: Vec<String> = Vec::new();
    let check = |map: &TopologicalMap| {
        if let Err(unsound) = map.sanity_check() {
            panic!("{unsound}");
        }
    };
    let retract = |map: &mut TopologicalMap, past: &mut Vec<String>| {
        map.retract();
        check(map);
        if let Some(before) = past.pop() {
            assert_eq!(format!("{map:?}"), before);
        }
    };
    for change in bytes.chunks_exact(3) {
        let pending: Vec<PendingGateway> = map.pending_gateways().collect();
        let (one, other) = (usize::from(change[1]), usize::from(change[2]));
        match change[0] % 8 {
            0..=2 if map.place_count() < MOST_PLACES => {
                past.push(format!("{map:?}"));
                let star = &stars[one % stars.len()];
                map.add_place(catalog.intern(star), star);
            }
            3..=6 if pending.len() > 1 => {
                past.push(format!("{map:?}"));
                let (one, step) = (one % pending.len(), 1 + other % (pending.len() - 1));
                map.link(pending[one], pending[(one + step) % pending.len()]);
            }
            _ => retract(&mut map, &mut past),
        }
        check(&map);
    }
    while !past.is_empty() {
        retract(&mut map, &mut past);
    }
});
