//! Whatever is done to a map, what it carries along equals a recount, and can be taken back.

use hssh_topology::{MapOlp, Star, StarCatalog, TopologicalMap};
use proptest::prelude::*;

use crate::random::{Growing, growth};
use crate::recount;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1200))]

    #[test]
    fn what_is_carried_along_equals_a_recount((stars, changes) in growth(30)) {
        let mut growing = Growing::new(&stars);
        for change in &changes {
            growing.make(change);
            recount::check(&growing.map, &growing.catalog);
        }
        growing.retract_all();
    }
}

/// Sets of places grow from one word to two and to four, and a map taken back below that still counts.
#[test]
fn many_places() {
    let star: Star = "0+ 1+ 0- 1-".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let mut map = TopologicalMap::new();
    let columns = 10;
    let mut measures = Vec::new();
    for place in 0..140 {
        map.add_place(id, &star);
        let (row, column) = (place / columns, place % columns);
        let at = |place: u32, olp: u32| MapOlp(4 * place + olp);
        if column > 0 {
            map.link(at(place - 1, 1), at(place, 3));
        }
        if row > 0 {
            map.link(at(place - columns, 2), at(place, 0));
        }
        measures.push(hssh_topology::Measure::of(&map));
        if [62, 63, 64, 127, 128, 139].contains(&place) {
            recount::check(&map, &catalog);
        }
    }
    for place in (0..140).rev() {
        assert_eq!(hssh_topology::Measure::of(&map), measures[place]);
        if [130, 63, 40].contains(&place) {
            recount::check(&map, &catalog);
        }
        let links = usize::from(place % 10 > 0) + usize::from(place >= 10);
        (0..=links).for_each(|_| map.retract());
    }
    assert_eq!(map.olp_count(), 0);
}

/// A circle of two places crossed by a road: each place is beside the circle, or on it.
#[test]
fn a_circular_path_sees_itself_along_the_paths_it_crosses() {
    let star: Star = "0+ 1+ 0- 1-".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let mut map = TopologicalMap::new();
    map.add_place(id, &star);
    map.add_place(id, &star);
    map.link(MapOlp(0), MapOlp(6));
    map.link(MapOlp(4), MapOlp(2));
    let circle = map.path(MapOlp(0));
    assert!(map.is_circular(circle) && map.is_complete(circle));
    // Both roads reach both places both ways along the circle, their own place among them.
    assert_eq!(map.contradictory_boundary_count(), 4);
    recount::check(&map, &catalog);
}

#[test]
#[should_panic(expected = "a closed end cannot be linked")]
fn closed_ends_cannot_be_linked() {
    let star: Star = "0+ (0-)".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let mut map = TopologicalMap::new();
    map.add_place(id, &star);
    map.link(MapOlp(0), MapOlp(1));
}

#[test]
fn retracting_an_empty_map_does_nothing() {
    let mut map = TopologicalMap::new();
    map.retract();
    assert_eq!(format!("{map:?}"), format!("{:?}", TopologicalMap::new()));
}
