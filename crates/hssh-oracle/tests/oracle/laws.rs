//! Laws that hold for every map and every search, whatever their numbers.

use hssh_causal::{Exploration, NamedStar, StarType, Travel};
use hssh_oracle::{End, Facts, FinalMap, Node, Rules, Step, enumerate};
use hssh_topology::Olp;

use crate::grid::{exploration, snake};

fn grid_3x3() -> Exploration {
    exploration(3, 3, &snake(3, 3))
}

/// Everything but axioms 1 and 2 switched off, these two as well.
fn no_rules() -> Rules {
    Rules { no_self_intersection: false, no_circular_path: false, ..Rules::default() }
}

/// A walk on which every place looks like "+": each travel leaves by the given end, counted
/// clockwise from the entry.
fn all_crossings(exits: &[u32]) -> Exploration {
    let star: hssh_topology::Star = "0+ 1+ 0- 1-".parse().unwrap();
    let plus = NamedStar { name: "plus".to_owned(), star, bearings: vec![None; 4] };
    let travel =
        |&exit| Travel { exit: Olp::new(exit), entry: Olp::new(0), star: StarType(0), odometry: None };
    Exploration::new(vec![plus], StarType(0), exits.iter().map(travel).collect()).unwrap()
}

/// The worst case of section 3.3: every pending gateway matches every observation, so that b = p,
/// b_p = p_i, f = m + 1, and (3.1) holds to the letter.
#[test]
fn equation_3_1_in_the_worst_case() {
    let result = enumerate(&all_crossings(&[0, 2, 1, 3, 1, 2, 3]), &no_rules());
    assert!(result.expansions.len() > 250);
    for expansion in &result.expansions {
        assert_eq!(expansion.children, expansion.pending, "{expansion:?}");
        assert_eq!(expansion.planar_children, expansion.pending_in_face, "{expansion:?}");
        assert_eq!(expansion.faces, expansion.matches + 1, "{expansion:?}");
    }
}

/// Definition 3.2 is what section 3.3 says it is for: linking two pending gateways keeps the genus
/// when they lie in the same face, and adds one handle when they do not.
#[test]
fn a_link_inside_a_face_keeps_the_genus_and_another_adds_a_handle() {
    let exploration = all_crossings(&[0, 2, 1, 3, 1]);
    let mut judged = [0, 0];
    for last in enumerate(&exploration, &no_rules()).final_maps {
        let map = last.map(&exploration);
        let pending = map.pending_gateways();
        let pending_by_face = map.pending_by_face();
        let face = |end: &End| pending_by_face.iter().position(|face| face.contains(end));
        for (index, &a) in pending.iter().enumerate() {
            for &b in &pending[index + 1..] {
                let mut linked = map.clone();
                linked.links.push((a, b));
                let handles = usize::from(face(&a) != face(&b));
                assert_eq!(Facts::of(&linked).genus, last.facts.genus + handles);
                judged[handles] += 1;
            }
        }
    }
    assert!(judged[0] > 500 && judged[1] > 500);
}

/// No extension of a map repairs a violation, so to prune early is to filter late.
#[test]
fn pruning_early_is_filtering_late() {
    let exploration = grid_3x3();
    let everything = enumerate(&exploration, &no_rules()).final_maps;
    let base = Rules::default();
    let rules = [
        base.clone(),
        Rules { places_bound: Some(9), ..base.clone() },
        Rules { genus_bound: Some(0), ..base.clone() },
        Rules { genus_bound: Some(1), ..base.clone() },
        Rules { perpendicular: true, ..base.clone() },
        Rules { sides: true, ..base.clone() },
        Rules { genus_bound: Some(0), perpendicular: true, sides: true, ..base },
    ];
    for rules in rules {
        let pruned = enumerate(&exploration, &rules).final_maps;
        let survives = |last: &&FinalMap| rules.first_violation(&last.map(&exploration)).is_none();
        let filtered: Vec<FinalMap> = everything.iter().filter(survives).cloned().collect();
        assert!(!pruned.is_empty() && pruned.len() < everything.len());
        assert_eq!(pruned, filtered, "{rules:?}");
    }
}

/// Every candidate is either built or counted under one axiom, every hypothesis either has a
/// predicted child, or is refuted, or is expanded.
#[test]
fn nothing_is_lost_between_levels() {
    let exploration = grid_3x3();
    let rules = Rules { sides: true, ..Rules::planar() };
    let result = enumerate(&exploration, &rules);
    let mut nodes = vec![Node::root(&exploration)];
    for (travel, level) in exploration.travels().iter().zip(&result.levels[1..]) {
        let steps: Vec<Step> = nodes.iter().map(|node| node.step(travel)).collect();
        nodes.clear();
        let (mut candidates_made, mut predicted, mut refuted) = (0, 0, 0);
        for step in steps {
            match step {
                Step::Predicted(child) => {
                    predicted += 1;
                    nodes.push(child);
                }
                Step::Refuted => refuted += 1,
                Step::Expanded { candidates, .. } => {
                    candidates_made += candidates.len();
                    nodes.extend(candidates.into_iter().filter(|c| rules.first_violation(&c.map).is_none()));
                }
            }
        }
        assert_eq!(candidates_made, level.maps + level.removed.values().sum::<usize>());
        assert_eq!(level.nodes, predicted + level.maps);
        assert_eq!(level.refuted, refuted);
    }
}
