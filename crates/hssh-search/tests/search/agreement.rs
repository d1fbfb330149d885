//! Breadth-first, counting and the naive mapper count the same and find the same maps in one order.

use std::collections::BTreeSet;

use hssh_causal::Exploration;
use hssh_oracle::{Axiom as NaiveAxiom, Enumeration, FinalMap, Path, enumerate};
use hssh_search::{FinalCounts, Mapper, MapperError, Report, StopReason};
use hssh_topology::{Axiom, Axioms, End, MapSketch, Olp, PlaceId};
use proptest::prelude::*;

use crate::cases::{breadth_first, case, last_nodes, rules, sketch};

const AXIOMS: [(Axiom, NaiveAxiom); 6] = [
    (Axiom::NoSelfIntersection, NaiveAxiom::SelfIntersection),
    (Axiom::NoCircularPath, NaiveAxiom::CircularPath),
    (Axiom::MaxPlaces, NaiveAxiom::Places),
    (Axiom::MaxGenus, NaiveAxiom::Genus),
    (Axiom::Perpendicular, NaiveAxiom::Perpendicular),
    (Axiom::ConsistentBoundaries, NaiveAxiom::Sides),
];

/// "No pending gateway lies on a path with only one place", even if the path comes by it twice.
fn nearly_closed(last: &FinalMap, exploration: &Exploration) -> bool {
    let map = last.map(exploration);
    let places = |end| Path::through(&map, end).places().collect::<BTreeSet<_>>().len();
    map.pending_gateways().into_iter().all(|end| places(end) > 1)
}

fn compare_counts(report: &Report, naive: &Enumeration, exploration: &Exploration) {
    assert_eq!(report.stop, StopReason::Exhausted);
    assert_eq!((report.travels, report.explained), (naive.levels.len() as u64 - 1, report.travels));
    assert_eq!(report.levels.len(), naive.levels.len());
    for (depth, (level, expected)) in report.levels.iter().zip(&naive.levels).enumerate() {
        let refuted = naive.levels.get(depth + 1).map_or(0, |next| next.refuted);
        let counted = (level.nodes as usize, level.maps as usize, level.refuted as usize);
        assert_eq!(counted, (expected.nodes, expected.maps, refuted), "after {depth} travels");
    }
    assert_eq!((report.nodes as usize, report.maps as usize), (naive.nodes(), naive.maps()));
    for (axiom, name) in AXIOMS {
        let removed: usize = naive.levels.iter().filter_map(|level| level.removed.get(&name)).sum();
        assert_eq!(report.removals.by(axiom) as usize, removed, "{axiom}");
    }

    let FinalCounts { final_maps, closed, perpendicular, optimal, best, .. } = report.finals;
    assert_eq!(final_maps as usize, naive.final_maps.len());
    assert_eq!(closed as usize, naive.closed());
    assert_eq!(perpendicular as usize, naive.closed_and_perpendicular());
    let nearly = naive.final_maps.iter().filter(|last| nearly_closed(last, exploration)).count();
    assert_eq!(report.finals.nearly_closed as usize, nearly);
    let best =
        best.map(|best| (best.undetermined_boundaries as usize, best.paths as usize, best.places as usize));
    let optimum = naive.optimum().map(|(value, _)| (value.unrelated, value.paths, value.places));
    assert_eq!(best, optimum);
    assert_eq!(optimal as usize, naive.optimum().map_or(0, |(_, number)| number));
    assert_eq!(report.expanded, report.nodes - final_maps);
}

/// A final map of the naive mapper as a sketch.
fn plain(last: &FinalMap, exploration: &Exploration) -> MapSketch {
    let end = |(place, olp)| End { place: PlaceId::new(place as u32), olp: Olp::new(olp as u32) };
    MapSketch {
        places: last.places.iter().map(|&star| exploration.star(star).clone()).collect(),
        links: last.links.iter().map(|&(a, b)| (end(a), end(b))).collect(),
    }
}

fn compare_maps(mapper: &Mapper, naive: &Enumeration, exploration: &Exploration) {
    let nodes = last_nodes(mapper);
    assert_eq!(nodes.len(), naive.final_maps.len());
    for (&node, expected) in nodes.iter().zip(&naive.final_maps) {
        assert_eq!(sketch(mapper, node), plain(expected, exploration));
        let position = mapper.hypothesis(node).position;
        let here = (position.place.index(), position.phi.rotation() as usize);
        assert_eq!(here, (expected.current, expected.rotation));
        assert_eq!(mapper.visits(node).last(), Some(&position));
    }
    // In order of preference, then of creation.
    let ranked = mapper.maps(usize::MAX);
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by_key(|&last| naive.final_maps[last].facts.value);
    assert!(ranked.iter().map(|map| map.node).eq(order.iter().map(|&last| nodes[last])));
    for (map, &last) in ranked.iter().zip(&order) {
        let facts = &naive.final_maps[last].facts;
        assert_eq!((map.closed, map.measure.genus as usize), (facts.closed, facts.genus));
    }
    assert_eq!(mapper.maps(2), ranked[..ranked.len().min(2)]);
}

fn counted(exploration: &Exploration, axioms: Axioms) -> Report {
    Mapper::builder().axioms(axioms).count(exploration).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn all_mappers_agree((exploration, axioms) in case(400)) {
        let naive = enumerate(&exploration, &rules(&axioms));
        let mapper = breadth_first(&exploration, axioms);
        compare_counts(&mapper.report(), &naive, &exploration);
        compare_counts(&counted(&exploration, axioms), &naive, &exploration);
        compare_maps(&mapper, &naive, &exploration);
    }

    /// Larger trees, without the naive mapper.
    #[test]
    fn counting_is_breadth_first((exploration, axioms) in case(20_000)) {
        let whole = breadth_first(&exploration, axioms).report();
        let counted = counted(&exploration, axioms);
        prop_assert_eq!((counted.nodes, counted.maps, counted.refuted), (whole.nodes, whole.maps, whole.refuted));
        prop_assert_eq!((counted.expanded, counted.finals), (whole.expanded, whole.finals));
        prop_assert_eq!((counted.levels, counted.removals), (whole.levels, whole.removals));
    }
}

/// Two paths that share two places may become one path, so that no search may discard a map for that.
#[test]
fn axioms_that_cannot_be_decided_on_the_way_are_refused() {
    let exploration = hssh_world::strategies::random_exploration(3);
    let axioms = Axioms { perpendicular: true, no_self_intersection: false, ..Axioms::default() };
    let builder = Mapper::builder().axioms(axioms);
    for refusal in [builder.clone().explain(&exploration).err(), builder.count(&exploration).err()] {
        assert!(matches!(refusal, Some(MapperError::Axioms(_))), "{refusal:?}");
    }
}
