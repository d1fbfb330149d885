//! Best-first with proof finds exactly the optima, because its bound is one.

use std::collections::BTreeSet;

use hssh_search::{Cursor, Goal, Mapper, Order, Score, StopReason};
use hssh_topology::{Axioms, GenusRank, MapSketch, Measure, Preference};
use proptest::prelude::*;

use crate::cases::{breadth_first, case, last_nodes, sketch, sketches};

const RANKS: [GenusRank; 3] = [GenusRank::Ignored, GenusRank::First, GenusRank::Last];

fn text(sketches: &[MapSketch]) -> BTreeSet<String> {
    sketches.iter().map(|sketch| format!("{sketch:?}")).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn a_proof_finds_exactly_the_optima((exploration, axioms) in case(2000)) {
        for preference in RANKS.map(|genus| Preference { genus }) {
            let search = |(order, goal)| {
                let builder = Mapper::builder().axioms(axioms).preference(preference);
                builder.order(order).goal(goal).explain(&exploration).unwrap()
            };
            let all = search((Order::BreadthFirst, Goal::AnyMap));
            for goal in [Goal::AnyMap, Goal::ClosedMap] {
                let accepted: Vec<_> = all
                    .maps(usize::MAX)
                    .into_iter()
                    .filter(|map| map.closed || goal == Goal::AnyMap)
                    .collect();
                let best = accepted.first().map(|map| map.measure);
                let is_best = |measure| best.is_some_and(|best| preference.rank(measure) == preference.rank(best));
                let optima: Vec<MapSketch> = accepted
                    .iter()
                    .filter(|map| is_best(map.measure))
                    .map(|map| sketch(&all, map.node))
                    .collect();

                let proof = search((Order::Proof, goal));
                let found = sketches(&proof);
                prop_assert_eq!(found.len(), optima.len());
                prop_assert_eq!(text(&found), text(&optima));

                let report = proof.report();
                let certificate = report.proof.unwrap();
                let complete = if best.is_some() { StopReason::Proved } else { StopReason::Exhausted };
                prop_assert_eq!(report.stop, complete);
                prop_assert!(certificate.proved);
                let rank = |score: Option<Score>| match score {
                    Some(Score::Measure(measure)) => Some(preference.rank(measure)),
                    _ => None,
                };
                prop_assert_eq!(rank(certificate.best), best.map(|best| preference.rank(best)));
                if let (Some(open), Some(best)) = (rank(certificate.open_bound), rank(best.map(Score::Measure))) {
                    prop_assert!(open > best);
                }
                prop_assert!(report.nodes <= all.report().nodes);
            }
        }
    }

    /// Along every branch, every number of the bound is at most what the last map measures.
    #[test]
    fn bounds_are_bounds((exploration, axioms) in case(1500)) {
        let mapper = breadth_first(&exploration, axioms);
        let (tree, travels) = (mapper.tree(), exploration.travels().len());
        let mut cursor = Cursor::new(mapper.experience());
        let mut at = |node| cursor.go_to(node, tree, mapper.experience()).map.clone();
        let bounds: Vec<Measure> =
            tree.nodes().map(|node| Measure::bound(&at(node), (travels - tree.depth(node)) as u32)).collect();
        for last in last_nodes(&mapper) {
            let measure = Measure::of(&at(last));
            for node in tree.branch(last) {
                let bound = bounds[node.index()];
                let holds = bound.undetermined_boundaries <= measure.undetermined_boundaries
                    && bound.paths <= measure.paths
                    && bound.places <= measure.places
                    && bound.genus <= measure.genus;
                prop_assert!(holds, "{} after {} travels bounds {}", bound, tree.depth(node), measure);
            }
        }
    }

    /// Best-first finds a map whenever there is one, and a closed one if it is asked to.
    #[test]
    fn best_first_finds_a_map((exploration, axioms) in case(2000)) {
        let all = breadth_first(&exploration, axioms);
        let maps = all.maps(usize::MAX);
        for goal in [Goal::AnyMap, Goal::ClosedMap] {
            let builder = Mapper::builder().axioms(axioms).order(Order::BestFirst).goal(goal);
            let mapper = builder.explain(&exploration).unwrap();
            let there_is_one = maps.iter().any(|map| map.closed || goal == Goal::AnyMap);
            let expected = if there_is_one { StopReason::Found } else { StopReason::Exhausted };
            prop_assert_eq!(mapper.report().stop, expected);
            let found = mapper.maps(usize::MAX);
            if there_is_one {
                prop_assert_eq!(found.len(), 1);
                prop_assert!(found[0].closed || goal == Goal::AnyMap);
            } else {
                prop_assert!(found.is_empty());
                prop_assert_eq!(mapper.report().rejected as usize, maps.len());
            }
            let known = text(&sketches(&all));
            prop_assert!(text(&sketches(&mapper)).is_subset(&known));
        }
    }
}

/// Where no closed map can come of a hypothesis, the proof turns it down before the last travel, and
/// says so: that is not the same as a star that fits nowhere.
#[test]
fn what_cannot_close_is_turned_down_and_counted() {
    let whole = hssh_world::strategies::random_exploration(3);
    for travels in 1..=whole.travels().len().min(6) {
        let exploration = whole.prefix(travels);
        let all = breadth_first(&exploration, Axioms::default()).maps(usize::MAX);
        let builder = Mapper::builder().order(Order::Proof).goal(Goal::ClosedMap);
        let mapper = builder.explain(&exploration).unwrap();
        let closed = all.iter().any(|map| map.closed);
        assert_eq!(mapper.report().stop == StopReason::Proved, closed, "{travels} travels");
        assert!(closed || all.is_empty() || mapper.report().rejected > 0, "{travels} travels");
    }
}
