//! Whatever is done to a map, what it carries along equals a recount, and can be taken back.

use hssh_topology::{Olp, PendingGateway, PlaceId, Star, StarCatalog, TopologicalMap};
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
            recount::check(&growing.lean, &growing.catalog);
        }
        growing.retract_all();
    }
}

/// Links an end of one place to an end of another.
fn link(map: &mut TopologicalMap, (place, end): (u32, u32), (other, far): (u32, u32)) {
    let pending = |place, end| map.pending(map.olp(PlaceId::new(place), Olp::new(end))).unwrap();
    map.link(pending(place, end), pending(other, far));
}

/// Sets of places grow from one word to two and to four, and a map taken back below that still counts.
#[test]
fn many_places() {
    check_many_places(TopologicalMap::new());
}

/// The same counted anew.
#[test]
fn many_places_without_boundaries() {
    check_many_places(TopologicalMap::without_boundaries());
}

fn check_many_places(mut map: TopologicalMap) {
    let star: Star = "0+ 1+ 0- 1-".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let columns = 10;
    let mut measures = Vec::new();
    for place in 0..140 {
        map.add_place(id, &star);
        let (row, column) = (place / columns, place % columns);
        if column > 0 {
            link(&mut map, (place - 1, 1), (place, 3));
        }
        if row > 0 {
            link(&mut map, (place - columns, 2), (place, 0));
        }
        measures.push(hssh_topology::Measure::of(&map));
        if [62, 63, 64, 127, 128, 139].contains(&place) {
            recount::check(&map, &catalog);
            map.sanity_check().unwrap();
        }
    }
    for place in (0..140).rev() {
        assert_eq!(hssh_topology::Measure::of(&map), measures[place]);
        if [130, 63, 40].contains(&place) {
            recount::check(&map, &catalog);
            map.sanity_check().unwrap();
        }
        let links = usize::from(place % 10 > 0) + usize::from(place >= 10);
        (0..=links).for_each(|_| map.retract());
    }
    assert_eq!(map.olp_count(), 0);
}

/// Boundaries that are counted anew are counted block by block: a long road, crossed by streets, with more places than a block has.
#[test]
fn a_long_road_counted_anew() {
    let star: Star = "0+ 1+ 0- 1-".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let [mut map, mut lean] = [TopologicalMap::new(), TopologicalMap::without_boundaries()];
    for map in [&mut map, &mut lean] {
        for place in 0..2500 {
            map.add_place(id, &star);
            if place > 0 {
                link(map, (place - 1, 1), (place, 3));
            }
        }
    }
    assert_eq!(hssh_topology::Measure::of(&lean), hssh_topology::Measure::of(&map));
    // Of every pair of a street and a place off it, the side is known: the road's.
    assert_eq!(lean.undetermined_boundary_count(), 0);
    assert_eq!(lean.contradictory_boundary_count(), 0);
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
    link(&mut map, (0, 0), (1, 2));
    link(&mut map, (1, 0), (0, 2));
    let circle = map.path(map.olp(PlaceId::new(0), Olp::new(0)));
    assert!(map.is_circular(circle) && map.is_complete(circle));
    // Both roads reach both places both ways along the circle, their own place among them.
    assert_eq!(map.contradictory_boundary_count(), 4);
    recount::check(&map, &catalog);
}

/// Neither closed ends nor linked gateways are pending.
#[test]
fn only_gateways_are_linked_and_only_once() {
    let star: Star = "0+ (0-)".parse().unwrap();
    let mut catalog = StarCatalog::new();
    let id = catalog.intern(&star);
    let mut map = TopologicalMap::new();
    let [gateway, closed] = [0, 1].map(|olp| map.olp_of_next_place(Olp::new(olp)));
    map.add_place(id, &star);
    map.add_place(id, &star);
    assert_eq!((map.pending(gateway).map(PendingGateway::olp), map.pending(closed)), (Some(gateway), None));
    link(&mut map, (0, 0), (1, 0));
    assert_eq!((map.pending(gateway), map.pending_gateways().count()), (None, 0));
}

#[test]
fn retracting_an_empty_map_does_nothing() {
    let mut map = TopologicalMap::new();
    map.retract();
    assert_eq!(format!("{map:?}"), format!("{:?}", TopologicalMap::new()));
    let lean = TopologicalMap::without_boundaries();
    lean.sanity_check().unwrap();
    assert_eq!((lean.undetermined_boundary_count(), lean.is_perpendicular()), (0, true));
}
