//! The tree of hypotheses, cut down to what somebody can look at.

use std::collections::{BTreeMap, BTreeSet};

use hssh_search::{NodeId, Tree};
use hssh_topology::Outcome;

use super::data::{PageFate, PageNode, PageTree};
use crate::answer::Answer;

/// More hypotheses than that nobody looks at.
const MOST_NODES: usize = 1500;

/// All hypotheses; of too many, first those on the way to the listed maps, the best first, and what branches off from these ways.
pub(super) fn page_tree(tree: &Tree, answer: &Answer) -> PageTree {
    let mut has_child = vec![false; tree.len()];
    for parent in tree.nodes().filter_map(|node| tree.parent(node)) {
        has_child[parent.index()] = true;
    }
    let ways = ways(tree, answer);
    let shown = shown(tree, &ways);
    let number_of: BTreeMap<NodeId, u32> = shown.iter().copied().zip(0..).collect();
    let mut hidden = vec![0_u64; shown.len()];
    let mut above = vec![0_u32; tree.len()];
    for node in tree.nodes() {
        let is_shown = number_of.get(&node).copied();
        let nearest = is_shown.or_else(|| tree.parent(node).map(|parent| above[parent.index()])).unwrap_or(0);
        above[node.index()] = nearest;
        if is_shown.is_none() {
            hidden[nearest as usize] += 1;
        }
    }
    let last = answer.input.considered as usize;
    let node = |(&node, hidden): (&NodeId, u64)| PageNode {
        parent: tree.parent(node).and_then(|parent| number_of.get(&parent).copied()),
        follows: tree.derivation(node).map_or_else(String::new, |word| word.to_string()),
        fate: match tree.outcome(node) {
            Outcome::Refuted => PageFate::Refuted,
            Outcome::Expanded if !has_child[node.index()] => PageFate::Removed,
            Outcome::Open if tree.depth(node) == last => PageFate::Final,
            Outcome::Open => PageFate::Open,
            Outcome::Predicted | Outcome::Expanded => PageFate::Grown,
        },
        hidden,
        rank: ways.iter().position(|way| way.last() == Some(&node)).map(|index| answer.maps[index].rank),
    };
    PageTree { nodes: shown.iter().zip(hidden).map(node).collect(), made: tree.len() as u64 }
}

/// For each listed map the hypotheses that lead to it, the root first.
fn ways(tree: &Tree, answer: &Answer) -> Vec<Vec<NodeId>> {
    let branches: Vec<Vec<&str>> =
        answer.maps.iter().map(|map| map.branch.split_whitespace().collect()).collect();
    let mut ways = vec![vec![NodeId::ROOT]; branches.len()];
    // By hypothesis on a way: whose ways.
    let mut on_way = BTreeMap::from([(NodeId::ROOT, (0..branches.len()).collect::<Vec<_>>())]);
    for node in tree.nodes() {
        let Some((parent, word)) = tree.parent(node).zip(tree.derivation(node)) else { continue };
        let Some(maps) = on_way.get(&parent) else { continue };
        let (word, travel) = (word.to_string(), tree.depth(node) - 1);
        let maps: Vec<usize> =
            maps.iter().copied().filter(|&map| branches[map].get(travel) == Some(&word.as_str())).collect();
        for &map in &maps {
            ways[map].push(node);
        }
        if !maps.is_empty() {
            on_way.insert(node, maps);
        }
    }
    ways
}

/// What is shown, in order of creation: parents come before their children.
fn shown(tree: &Tree, ways: &[Vec<NodeId>]) -> Vec<NodeId> {
    if tree.len() <= MOST_NODES {
        return tree.nodes().collect();
    }
    let mut first_way: BTreeMap<NodeId, usize> = BTreeMap::from([(NodeId::ROOT, 0)]);
    for (map, way) in ways.iter().enumerate() {
        for &node in way {
            first_way.entry(node).or_insert(map);
        }
    }
    // By map: the way to it, then what branches off. Neither comes before its parent.
    let rank = |node: NodeId| {
        let of_way = first_way.get(&node).map(|map| 2 * map);
        of_way.or_else(|| tree.parent(node).and_then(|parent| first_way.get(&parent)).map(|map| 2 * map + 1))
    };
    let ranked: BTreeSet<(usize, NodeId)> = if ways.is_empty() {
        tree.nodes().map(|node| (tree.depth(node), node)).take(MOST_NODES).collect()
    } else {
        tree.nodes().filter_map(|node| Some((rank(node)?, node))).collect()
    };
    let shown: BTreeSet<NodeId> = ranked.into_iter().take(MOST_NODES).map(|(_, node)| node).collect();
    shown.into_iter().collect()
}
