//! The Bayes network against the pose graph it describes, and d-separation against counting trails.

use std::collections::BTreeSet;

use hssh_metrics::{
    BayesNetwork, Covariance, GraphError, Measurement, Pose, PoseId, Variable, metrical_log_likelihood,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::random_graph;

fn measurement(start: u32, end: u32) -> Measurement {
    Measurement {
        start: PoseId(start),
        end: PoseId(end),
        relative_pose: Pose::new(8.0, 0.0, 0.0),
        information: Covariance::from_standard_deviations(0.1, 0.2, 0.03).unwrap().information(),
    }
}

/// The square exploration of Figure 4.2, read as a square: the fourth travel comes back.
fn square() -> BayesNetwork {
    BayesNetwork::new(4, vec![measurement(0, 1), measurement(1, 2), measurement(2, 3), measurement(3, 0)])
        .unwrap()
}

fn pose(index: u32) -> Variable {
    Variable::Pose(PoseId(index))
}

#[test]
fn its_density_is_that_of_the_pose_graph_with_all_constants() {
    for seed in 0..10 {
        let graph = random_graph(seed, 20, 8, 0.2);
        let network = BayesNetwork::from(&graph);
        let (density, expected) =
            (network.log_density(graph.poses()), metrical_log_likelihood(&graph, graph.chi2()));
        assert!((density - expected).abs() < 1e-9 * expected.abs(), "{density} {expected}");
    }
}

#[test]
fn a_measurement_depends_on_its_two_poses_and_on_nothing_else() {
    let graph = random_graph(4, 8, 4, 0.1);
    let network = BayesNetwork::from(&graph);
    for (index, edge) in graph.edges().iter().enumerate() {
        let this = Variable::Measurement(index);
        let parents = BTreeSet::from([Variable::Pose(edge.from), Variable::Pose(edge.to)]);
        for other in network.variables().filter(|other| *other != this && !parents.contains(other)) {
            assert!(network.are_independent(this, other, &parents), "{this:?} {other:?}");
            let everything_else: BTreeSet<_> =
                network.variables().filter(|variable| *variable != this && *variable != other).collect();
            assert!(network.are_independent(this, other, &everything_else));
        }
        for parent in &parents {
            assert!(!network.are_independent(this, *parent, &BTreeSet::new()));
        }
    }
}

/// Whether some simple trail between two variables is open, found by trying all: the definition.
fn has_open_trail(
    network: &BayesNetwork,
    trail: &[Variable],
    goal: Variable,
    given: &BTreeSet<Variable>,
) -> bool {
    let here = trail[trail.len() - 1];
    let is_open = trail.len() == 1 || given.contains(&here) == matches!(here, Variable::Measurement(_));
    if here == goal {
        return true;
    }
    let neighbors = network.arrows().filter_map(|(parent, index)| {
        let (pose, measurement) = (Variable::Pose(parent), Variable::Measurement(index));
        if here == pose { Some(measurement) } else { (here == measurement).then_some(pose) }
    });
    is_open
        && neighbors
            .filter(|next| !trail.contains(next))
            .any(|next| has_open_trail(network, &[trail, &[next]].concat(), goal, given))
}

#[test]
fn d_separation_is_the_absence_of_open_trails() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    for seed in 0..20 {
        let network = BayesNetwork::from(&random_graph(seed, 5, 2, 0.1));
        let variables: Vec<_> = network.variables().collect();
        let given: BTreeSet<_> = variables.iter().copied().filter(|_| random.random_bool(0.4)).collect();
        for &one in variables.iter().filter(|one| !given.contains(one)) {
            for &other in variables.iter().filter(|other| **other != one && !given.contains(other)) {
                let open = has_open_trail(&network, &[one], other, &given);
                assert_eq!(network.are_independent(one, other, &given), !open, "{one:?} {other:?} {given:?}");
            }
        }
    }
}

/// Before anything is measured poses are independent; a measurement between them is what makes them dependent.
#[test]
fn poses_depend_on_one_another_through_what_was_measured() {
    let network = square();
    let nothing = BTreeSet::new();
    assert!(network.are_independent(pose(0), pose(1), &nothing));
    let measured: BTreeSet<_> = (0..4).map(Variable::Measurement).collect();
    assert!(!network.are_independent(pose(0), pose(2), &measured));
    let sides: BTreeSet<_> = measured.iter().copied().chain([pose(1), pose(3)]).collect();
    assert!(network.are_independent(pose(0), pose(2), &sides), "two opposite corners cut the square");
}

#[test]
fn the_square_exploration_as_text() {
    let network = square();
    assert_eq!(
        network.factorization(),
        "p(τ | π) =\n  p(τ1 | π1, π2)\n  p(τ2 | π2, π3)\n  p(τ3 | π3, π4)\n  p(τ4 | π4, π1)\n"
    );
    let dot = network.to_dot();
    assert_eq!(dot.matches("->").count(), 8, "two arrows for each travel");
    assert_eq!(dot.matches("filled").count(), 5, "four measurements and the first pose are known");
    for line in ["pi1 [label=\"π1\", style=filled", "pi2 [label=\"π2\"];", "pi4 -> tau4;", "pi1 -> tau4;"] {
        assert!(dot.contains(line), "{line} in {dot}");
    }
}

#[test]
fn refuses_what_is_no_network() {
    let error = |poses, measurement| BayesNetwork::new(poses, vec![measurement]).unwrap_err();
    assert_eq!(error(2, measurement(0, 2)), GraphError::NoSuchPose { pose: PoseId(2), poses: 2 });
    assert_eq!(error(2, measurement(1, 1)), GraphError::Loop(PoseId(1)));
}
