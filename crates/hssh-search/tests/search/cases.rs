//! Random explorations and axioms, small enough for a naive mapper.

use hssh_causal::{Exploration, NamedStar, StarType, Travel};
use hssh_oracle::Rules;
use hssh_search::{Goal, Limits, Mapper, NodeId, Order};
use hssh_topology::{Axioms, MapSketch, Olp, Star};
use hssh_world::{grid, strategies};
use proptest::prelude::*;
use proptest::sample::Index;

/// An order with what it accepts.
pub(crate) type Way = (Order, Goal);

/// No axiom at all.
pub(crate) const FREE: Axioms = Axioms {
    no_self_intersection: false,
    no_circular_path: false,
    max_places: None,
    max_genus: None,
    perpendicular: false,
    consistent_boundaries: false,
};

/// Planarity and the axioms of every table.
pub(crate) fn planar() -> Axioms {
    Axioms { max_genus: Some(0), ..Axioms::default() }
}

/// Every axiom on or off, the usual ones mostly on; perpendicular maps have no paths that meet a place twice.
pub(crate) fn axioms() -> impl Strategy<Value = Axioms> {
    let places = prop_oneof![3 => Just(None), 1 => (1_u32..9).prop_map(Some)];
    let genus = prop_oneof![2 => Just(None), 1 => Just(Some(0)), 1 => (1_u32..3).prop_map(Some)];
    let often = || prop::bool::weighted(0.75);
    let seldom = || prop::bool::weighted(0.25);
    (often(), often(), places, genus, seldom(), seldom()).prop_map(
        |(no_self_intersection, no_circular_path, max_places, max_genus, perpendicular, sides)| Axioms {
            no_self_intersection,
            no_circular_path,
            max_places,
            max_genus,
            perpendicular: perpendicular && no_self_intersection,
            consistent_boundaries: sides,
        },
    )
}

/// The same axioms in the naive mapper's words.
pub(crate) fn rules(axioms: &Axioms) -> Rules {
    Rules {
        no_self_intersection: axioms.no_self_intersection,
        no_circular_path: axioms.no_circular_path,
        places_bound: axioms.max_places.map(|most| most as usize),
        genus_bound: axioms.max_genus.map(|most| most as usize),
        perpendicular: axioms.perpendicular,
        sides: axioms.consistent_boundaries,
    }
}

const STARS: [&str; 9] = [
    "0+ 1+ 0- 1-",
    "0+ (1+) 0- 1-",
    "(0+) 1- 0- 1+",
    "0+ 0-",
    "0+ (0-)",
    "0+ 0- 1+ 1-",
    "0+ 1+ (0-) (1-)",
    "0+:door 1+ 0- 1-",
    "0+ 1+ 2+ 0- 1- 2-",
];

/// An exploration of no world in particular: stars, exits and entries as they come.
fn fantasy() -> impl Strategy<Value = Exploration> {
    let stars = prop::sample::subsequence(STARS.to_vec(), 1..4);
    let travels = prop::collection::vec(any::<(Index, Index, Index)>(), 0..10);
    (stars, any::<Index>(), travels).prop_map(|(stars, start, travels)| {
        let named = |text: &&str| {
            let star: Star = text.parse().expect("the list holds stars");
            NamedStar { name: (*text).to_owned(), bearings: vec![None; star.ends().len()], star }
        };
        let stars: Vec<NamedStar> = stars.iter().map(named).collect();
        let gateway = |star: usize, choice: Index| {
            let gateways: Vec<Olp> = stars[star].star.gateways().collect();
            *choice.get(&gateways)
        };
        let start = start.index(stars.len());
        let mut here = start;
        let travels = travels
            .into_iter()
            .map(|(exit, entry, star)| {
                let (from, to) = (here, star.index(stars.len()));
                here = to;
                let (exit, entry) = (gateway(from, exit), gateway(to, entry));
                Travel { exit, entry, star: StarType(to as u32), odometry: None }
            })
            .collect();
        Exploration::new(stars, StarType(start as u32), travels).expect("travels use gateways")
    })
}

/// An exploration of a small world, or of none.
pub(crate) fn exploration() -> impl Strategy<Value = Exploration> {
    prop_oneof![2 => any::<u64>().prop_map(strategies::random_exploration), 1 => fantasy()]
}

/// The longest beginning of an exploration whose tree has at most that many nodes.
pub(crate) fn shortened(exploration: &Exploration, axioms: Axioms, nodes: u64) -> Exploration {
    let limits = Limits { nodes: Some(nodes), ..Limits::default() };
    let mapper = Mapper::builder().axioms(axioms).limits(limits).explain(exploration).unwrap();
    let levels = mapper.report().levels;
    let sums = levels.iter().scan(0, |sum, level| {
        *sum += level.nodes;
        Some(*sum)
    });
    exploration.prefix(sums.take_while(|&sum| sum <= nodes).count() - 1)
}

/// An exploration and axioms with which its tree has at most that many nodes.
pub(crate) fn case(nodes: u64) -> impl Strategy<Value = (Exploration, Axioms)> {
    (exploration(), axioms())
        .prop_map(move |(exploration, axioms)| (shortened(&exploration, axioms, nodes), axioms))
}

/// A route through a grid of places.
pub(crate) fn grid_walk(rows: u32, columns: u32, route: &[hssh_world::PlaceId]) -> Exploration {
    let world = grid(rows, columns, 8.0).unwrap();
    world.explore(&world.route_through(route).unwrap()).unwrap()
}

/// Breadth-first, all of it.
pub(crate) fn breadth_first(exploration: &Exploration, axioms: Axioms) -> Mapper {
    Mapper::builder().axioms(axioms).explain(exploration).unwrap()
}

/// The nodes that explain all travels, in order of creation.
pub(crate) fn last_nodes(mapper: &Mapper) -> Vec<NodeId> {
    let (tree, travels) = (mapper.tree(), mapper.experience().observations.len());
    tree.nodes().filter(|&node| tree.depth(node) == travels).collect()
}

/// The map of a node as plain data.
pub(crate) fn sketch(mapper: &Mapper, node: NodeId) -> MapSketch {
    MapSketch::of(&mapper.hypothesis(node).map, &mapper.experience().catalog)
}

/// The maps that a mapper gives, as plain data.
pub(crate) fn sketches(mapper: &Mapper) -> Vec<MapSketch> {
    mapper.maps(usize::MAX).iter().map(|map| sketch(mapper, map.node)).collect()
}
