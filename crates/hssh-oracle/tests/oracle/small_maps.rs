//! Maps small enough to draw, with facts counted by hand.

use hssh_causal::{Exploration, NamedStar, StarType};
use hssh_oracle::{Axiom, End, Facts, Map, Rules, Value};

const NORTH: usize = 0;
const EAST: usize = 1;
const SOUTH: usize = 2;
const WEST: usize = 3;

/// An exploration that has not begun, for its star types.
fn star_types(stars: &[&str]) -> Exploration {
    let named = |&text: &&str| {
        let star: hssh_topology::Star = text.parse().unwrap();
        NamedStar { name: text.to_owned(), bearings: vec![None; star.ends().len()], star }
    };
    Exploration::new(stars.iter().map(named).collect(), StarType(0), Vec::new()).unwrap()
}

fn crossings() -> Exploration {
    star_types(&["0+ 1+ 0- 1-"])
}

/// A map of places that all have the first star.
fn map<'a>(exploration: &'a Exploration, places: usize, links: &[(End, End)]) -> Map<'a> {
    Map { exploration, places: vec![StarType(0); places], links: links.to_vec() }
}

fn value(unrelated: usize, paths: usize, places: usize) -> Value {
    Value { unrelated, paths, places }
}

/// ```text
///   2
///   |
///   0 - 1
/// ```
/// Four paths: 0–1, 2–0, across 2, across 1. Across 2, place 1 has no side; across 1, place 2.
#[test]
fn a_corner_of_a_grid() {
    let exploration = crossings();
    let map = map(&exploration, 3, &[((0, EAST), (1, WEST)), ((0, NORTH), (2, SOUTH))]);
    let facts = Facts::of(&map);
    assert_eq!(facts.value, value(2, 4, 3));
    assert_eq!(facts.long_paths, 2);
    assert_eq!((facts.closed, facts.nearly_closed, facts.perpendicular), (false, false, true));
    assert_eq!(map.pending_gateways().len(), 8);
    let everything = Rules { perpendicular: true, sides: true, places_bound: Some(3), ..Rules::planar() };
    assert_eq!(everything.first_violation(&map), None);
    let fewer = Rules { places_bound: Some(2), ..everything };
    assert_eq!(fewer.first_violation(&map), Some(Axiom::Places));
}

/// Right is clockwise: looking north along 2–0, place 1 in the east is on the right.
#[test]
fn east_is_right_of_north() {
    let exploration = crossings();
    let map = map(&exploration, 3, &[((0, EAST), (1, WEST)), ((0, NORTH), (2, SOUTH))]);
    let northward = hssh_oracle::Path::through(&map, (0, NORTH));
    assert_eq!(northward.headings, [(0, NORTH), (2, NORTH)]);
    assert_eq!(northward.right(&map).into_iter().collect::<Vec<_>>(), [1]);
    assert!(northward.left(&map).is_empty());
}

/// A square of four crossings, closed to the outside: no path has one place, all gateways are used.
#[test]
fn a_closed_square() {
    let exploration = star_types(&["(0+) 1+ 0- (1-)"]);
    // Read clockwise each star is: closed, gateway, gateway, closed; so round the square, each
    // second gateway (2) meets the first (1) of the next place.
    let links = [((0, 1), (1, 2)), ((1, 1), (2, 2)), ((2, 1), (3, 2)), ((3, 1), (0, 2))];
    let facts = Facts::of(&map(&exploration, 4, &links));
    assert_eq!(facts.value, value(0, 4, 4));
    assert_eq!((facts.closed, facts.nearly_closed, facts.perpendicular), (true, true, true));
    assert_eq!((facts.genus, facts.long_paths), (0, 4));
}

/// Three crossings joined pairwise by three paths, both turns off 0–1 to its right.
#[test]
fn a_triangle_is_not_perpendicular() {
    let exploration = crossings();
    let links = [((0, EAST), (1, WEST)), ((1, SOUTH), (2, EAST)), ((0, SOUTH), (2, NORTH))];
    let map = map(&exploration, 3, &links);
    let facts = Facts::of(&map);
    assert_eq!((facts.value, facts.genus), (value(0, 3, 3), 0));
    assert_eq!((facts.closed, facts.nearly_closed, facts.perpendicular), (false, true, false));
    let rules = Rules { perpendicular: true, ..Rules::planar() };
    assert_eq!(rules.first_violation(&map), Some(Axiom::Perpendicular));
    let rules = Rules { sides: true, ..Rules::planar() };
    assert_eq!(rules.first_violation(&map), None);
}

/// The same with one turn to the other side: place 2 is left and right of 0–1.
#[test]
fn a_place_on_both_sides_has_none() {
    let exploration = crossings();
    let links = [((0, EAST), (1, WEST)), ((1, NORTH), (2, EAST)), ((0, SOUTH), (2, NORTH))];
    let map = map(&exploration, 3, &links);
    let along = hssh_oracle::Path::through(&map, (0, EAST));
    assert!(along.right(&map).contains(&2) && along.left(&map).contains(&2));
    assert!(Facts::of(&map).value.unrelated > 0);
    let rules = Rules { sides: true, ..Rules::default() };
    assert_eq!(rules.first_violation(&map), Some(Axiom::Sides));
}

/// Three paths through one common place form no triangle.
#[test]
fn a_star_of_three_paths_is_perpendicular() {
    let exploration = star_types(&["0+ 1+ 2+ 0- 1- 2-", "0+ 0-"]);
    let places = vec![StarType(0), StarType(1), StarType(1), StarType(1)];
    let links = vec![((0, 0), (1, 0)), ((0, 1), (2, 0)), ((0, 2), (3, 0))];
    let facts = Facts::of(&Map { exploration: &exploration, places, links });
    assert_eq!(facts.value, value(0, 3, 4));
    assert!(facts.perpendicular && facts.nearly_closed && !facts.closed);
}

/// Two paths that cross twice share two places, and the far place is beside the path it lies on.
#[test]
fn two_paths_that_cross_twice() {
    let exploration = crossings();
    let map = map(&exploration, 2, &[((0, EAST), (1, WEST)), ((0, SOUTH), (1, SOUTH))]);
    assert!(!Facts::of(&map).perpendicular);
    let rules = Rules { sides: true, ..Rules::default() };
    assert_eq!(rules.first_violation(&map), Some(Axiom::Sides));
    assert_eq!(Rules::planar().first_violation(&map), None);
}

/// East out of 0, straight through 1, and back into 0 from the north: one path meets 0 twice.
/// Across 1, place 0 lies both ways, hence on no side.
#[test]
fn a_path_that_meets_itself() {
    let exploration = crossings();
    let map = map(&exploration, 2, &[((0, EAST), (1, WEST)), ((1, EAST), (0, NORTH))]);
    assert_eq!(map.paths().iter().map(|path| path.headings.len()).collect::<Vec<_>>(), [3, 1]);
    assert_eq!(Facts::of(&map).value, value(1, 2, 2));
    assert_eq!(Rules::default().first_violation(&map), Some(Axiom::SelfIntersection));
}

/// Round and round through two places, never meeting one twice before closing.
#[test]
fn a_circular_path() {
    let exploration = crossings();
    let ring = map(&exploration, 2, &[((0, EAST), (1, WEST)), ((1, EAST), (0, WEST))]);
    let paths = ring.paths();
    assert_eq!(paths.iter().filter(|path| path.circular).count(), 1);
    assert_eq!(Facts::of(&ring).value.paths, 3);
    assert_eq!(Rules::default().first_violation(&ring), Some(Axiom::CircularPath));
    let itself = map(&exploration, 1, &[((0, EAST), (0, WEST))]);
    assert_eq!(Rules::default().first_violation(&itself), Some(Axiom::CircularPath));
    let turning = map(&exploration, 1, &[((0, EAST), (0, SOUTH))]);
    assert_eq!(Rules::default().first_violation(&turning), Some(Axiom::SelfIntersection));
}

/// North to south and east to west at one crossing: the smallest map that needs a torus.
#[test]
fn two_loops_at_a_crossing_need_a_handle() {
    let exploration = crossings();
    let torus = map(&exploration, 1, &[((0, NORTH), (0, SOUTH)), ((0, EAST), (0, WEST))]);
    assert_eq!((Facts::of(&torus).genus, Facts::of(&torus).closed), (1, true));
    let rules = Rules { no_circular_path: false, ..Rules::planar() };
    assert_eq!(rules.first_violation(&torus), Some(Axiom::Genus));
    let toroidal = Rules { genus_bound: Some(1), ..rules };
    assert_eq!(toroidal.first_violation(&torus), None);
}
