//! The number of threads changes nothing but the time.

use hssh_causal::Exploration;
use hssh_search::{Goal, Limits, Mapper, Order, PosteriorModel, Report};
use hssh_topology::Axioms;
use hssh_world::{DriftModel, grid, snake, thesis_3x4};
use proptest::prelude::*;

use crate::cases::{Way, case, grid_walk, planar, sketches};

pub(crate) const STRATEGIES: [Way; 7] = [
    (Order::BreadthFirst, Goal::AnyMap),
    (Order::BestFirst, Goal::AnyMap),
    (Order::BestFirst, Goal::ClosedMap),
    (Order::Cyclic, Goal::AnyMap),
    (Order::Cyclic, Goal::ClosedMap),
    (Order::Proof, Goal::AnyMap),
    (Order::Proof, Goal::ClosedMap),
];

fn timeless(report: Report) -> Report {
    Report { seconds: 0.0, ..report }
}

fn threads_change_nothing(exploration: &Exploration, axioms: Axioms, limits: Limits) {
    let counted = |threads| {
        let builder = Mapper::builder().axioms(axioms).limits(limits).threads(threads);
        timeless(builder.count(exploration).unwrap())
    };
    let alone = counted(1);
    assert!([2, 3].into_iter().all(|threads| counted(threads) == alone));

    for strategy in STRATEGIES {
        let search = |threads| {
            let builder = Mapper::builder().axioms(axioms).order(strategy.0).goal(strategy.1).limits(limits);
            builder.threads(threads).explain(exploration).unwrap()
        };
        let alone = search(1);
        for threads in [2, 3] {
            let together = search(threads);
            assert_eq!(timeless(together.report()), timeless(alone.report()));
            assert_eq!(together.maps(usize::MAX), alone.maps(usize::MAX));
            assert_eq!(sketches(&together), sketches(&alone));
            let (tree, other) = (together.tree(), alone.tree());
            assert_eq!(tree.len(), other.len());
            for node in tree.nodes() {
                assert_eq!(tree.parent(node), other.parent(node));
                assert_eq!(tree.derivation(node), other.derivation(node));
                assert_eq!(tree.outcome(node), other.outcome(node));
            }
        }
    }
}

#[test]
fn grids() {
    threads_change_nothing(&grid_walk(3, 4, &thesis_3x4()), Axioms::default(), Limits::default());
    let to_sixteen = Axioms { max_places: Some(16), ..planar() };
    threads_change_nothing(&grid_walk(4, 4, &snake(4, 4)), to_sixteen, Limits::default());
}

#[test]
fn a_limit_on_nodes_stops_at_the_same_node() {
    for nodes in [0, 1, 100, 1000, 3000] {
        let limits = Limits { nodes: Some(nodes), ..Limits::default() };
        threads_change_nothing(&grid_walk(4, 4, &snake(4, 4)), planar(), limits);
    }
}

/// Eight fronts sweep a long exploration at once; who does their work does not matter.
#[test]
fn the_posterior() {
    let world = grid(6, 6, 8.0).unwrap();
    let route = world.route_through(&snake(6, 6)).unwrap();
    let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let model = PosteriorModel::evidence(&exploration).unwrap();
    for order in [Order::Cyclic, Order::Proof, Order::BestFirst] {
        let search = |threads| {
            let limits = Limits { nodes: Some(3000), ..Limits::default() };
            let search = Mapper::builder().posterior(model).order(order).axioms(planar()).limits(limits);
            search.threads(threads).explain(&exploration).unwrap()
        };
        let alone = search(1);
        for threads in [2, 3] {
            let together = search(threads);
            assert_eq!(timeless(together.report()), timeless(alone.report()));
            assert_eq!(together.maps(usize::MAX), alone.maps(usize::MAX));
            let nodes = |mapper: &Mapper| {
                let tree = mapper.tree();
                tree.nodes().map(|node| (tree.parent(node), tree.derivation(node))).collect::<Vec<_>>()
            };
            assert_eq!(nodes(&together), nodes(&alone));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(90))]

    #[test]
    fn random_explorations((exploration, axioms) in case(2000)) {
        threads_change_nothing(&exploration, axioms, Limits::default());
    }
}
