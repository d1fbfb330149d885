//! Search trees: a short one as text, and what is refused.

use hssh_draw::{Fate, SearchTree, TreeError, TreeNode, TreeOptions, draw_tree, tree_to_dot};
use hssh_search::{Mapper, Visit};
use hssh_topology::{Axioms, Derivation, Olp, Star};

use crate::common::Grid;

/// Three equal corners after the first, then a T: what closed too early is refuted, and a bound of four
/// places removes what is left.
fn corners() -> SearchTree {
    let corner: Star = "0+ (1+) (0-) 1-".parse().unwrap();
    let axioms = Axioms { max_places: Some(4), ..Axioms::default() };
    let mut mapper = Mapper::builder().axioms(axioms).start(&corner).unwrap();
    for _ in 0..3 {
        mapper.observe(Visit::new(Olp::new(0), Olp::new(3), &corner)).unwrap();
    }
    mapper.observe(Visit::new(Olp::new(0), Olp::new(3), &"0+ (1+) 0- 1-".parse().unwrap())).unwrap();
    mapper.advance();
    SearchTree::of(mapper.tree(), mapper.experience(), &[], 60)
}

fn fates(tree: &SearchTree) -> Vec<Fate> {
    tree.nodes.iter().map(|node| node.fate).collect()
}

#[test]
fn refuted_and_removed_nodes_are_told_apart() {
    // By hand: a path of corners can close after two, three or four of them. The first two closures
    // predict a corner where the T was seen; the open map has four places already, and none is a T.
    use Fate::{Alive, Refuted, Removed};
    let tree = corners();
    assert_eq!(fates(&tree), [Alive, Alive, Alive, Alive, Removed, Refuted, Refuted]);
    insta::assert_snapshot!(tree_to_dot(&tree, &TreeOptions::default()).unwrap());
    let svg = draw_tree(&tree, &TreeOptions::default()).unwrap();
    assert_eq!(svg.matches(">p-nc<").count(), 2);
    assert_eq!(svg.matches(">!<").count(), 2);
    assert_eq!(svg.matches(">∅<").count(), 1);
    assert_eq!(svg.matches("class=\"node\"").count(), tree.nodes.len());
}

#[test]
fn a_large_tree_has_one_dot_for_each_node() {
    let grid = Grid { rows: 3, columns: 3 };
    let mut mapper = Mapper::builder().start(&grid.star((0, 0))).unwrap();
    grid.explore(&grid.snake(), &mut mapper);
    let best: Vec<_> = mapper.maps(2).iter().map(|map| map.node).collect();
    let tree = SearchTree::of(mapper.tree(), mapper.experience(), &best, 60);
    assert_eq!(tree.nodes.len(), 317); // Figure 3.3
    let draw = || draw_tree(&tree, &TreeOptions::default()).unwrap();
    let svg = draw();
    // The legend's sign for a preferred node is a dot and a ring too.
    assert_eq!(svg.matches("fill=\"#222222\"").count(), 317 + 1);
    assert_eq!(svg.matches("stroke=\"#117733\"").count(), 2 + 1);
    assert_eq!(svg, draw());
}

fn node(parent: Option<usize>) -> TreeNode {
    let parent = parent.map(|parent| (parent, Derivation::NewPlace));
    TreeNode { parent, fate: Fate::Alive, is_optimal: false, picture: None }
}

fn refusal(nodes: Vec<TreeNode>) -> TreeError {
    let tree = SearchTree { nodes, observations: 1 };
    let options = TreeOptions { most_nodes: 3, ..TreeOptions::default() };
    let error = draw_tree(&tree, &options).unwrap_err();
    assert_eq!(tree_to_dot(&tree, &options).unwrap_err(), error);
    error
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    assert_eq!(refusal(vec![]), TreeError::Empty);
    let too_many = refusal(vec![node(None), node(Some(0)), node(Some(0)), node(Some(0))]);
    insta::assert_snapshot!(too_many, @"the search tree has 4 nodes, and above 3 nobody can read a picture of it: draw a prefix of the exploration, or raise the limit `most_nodes`");
    let is_parent_error = |error| matches!(error, TreeError::Parent { node: 1, .. });
    assert!(is_parent_error(refusal(vec![node(None), node(Some(1))])));
    assert!(is_parent_error(refusal(vec![node(None), node(None)])));
}
