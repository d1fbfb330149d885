//! A large simulated pose graph: a robot that drives about a campus of streets.

use hssh_metrics::{Covariance, Edge, GraphFile, Pose, PoseGraph, PoseId};
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Metres from crossing to crossing, a pose every metre.
const BLOCK: i32 = 25;
/// Standard deviations of a step: metres and radians; closures are known as well.
const NOISE: (f64, f64) = (0.02, 0.004);
/// Where the robot was before, one pose in so many is recognised.
const RECOGNISED: f64 = 0.3;

/// A graph of so many poses: its poses are the true ones.
pub(crate) fn campus(poses: usize) -> GraphFile {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let blocks = ((poses as f64 / f64::from(BLOCK)).sqrt() / 1.6).ceil() as i32;
    let covariance = Covariance::from_standard_deviations(NOISE.0, NOISE.0, NOISE.1).expect("positive");
    let mut graph = PoseGraph::new();
    let mut seen = std::collections::BTreeMap::new();
    let (mut here, mut heading) = ((0, 0), 0_i32);
    let mut last: Option<(PoseId, Pose)> = None;
    let measured = |truth: Pose, random: &mut ChaCha8Rng| {
        let mut normal = || -> f64 { StandardNormal.sample(random) };
        truth.compose(Pose::new(NOISE.0 * normal(), NOISE.0 * normal(), NOISE.1 * normal()))
    };
    for _ in 0..poses {
        let pose =
            Pose::new(f64::from(here.0), f64::from(here.1), f64::from(heading) * std::f64::consts::FRAC_PI_2);
        let id = graph.add_pose(pose);
        if let Some((before, from)) = last {
            let step = measured(from.between(pose), &mut random);
            graph.add_edge(Edge::observed(before, id, step, &covariance)).expect("both poses are there");
        }
        let earlier = seen.insert(here, (id, pose));
        if let Some((earlier, from)) = earlier.filter(|_| random.random_bool(RECOGNISED)) {
            let match_ = measured(from.between(pose), &mut random);
            graph.add_edge(Edge::observed(earlier, id, match_, &covariance)).expect("both poses are there");
        }
        last = Some((id, pose));
        if here.0 % BLOCK == 0 && here.1 % BLOCK == 0 {
            let side = blocks * BLOCK;
            let ways: Vec<i32> = [heading, heading + 1, heading + 3]
                .map(|way| way % 4)
                .into_iter()
                .filter(|&way| {
                    let (x, y) = (here.0 + AHEAD[way as usize].0, here.1 + AHEAD[way as usize].1);
                    (0..=side).contains(&x) && (0..=side).contains(&y)
                })
                .collect();
            heading = *ways.choose(&mut random).expect("two sides of a crossing lead on at least");
        }
        here = (here.0 + AHEAD[heading as usize].0, here.1 + AHEAD[heading as usize].1);
    }
    graph.anchor_components();
    GraphFile::from(graph)
}

/// A step in each direction, counterclockwise.
const AHEAD: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_campus_has_loops_and_fits_its_truth() {
        let graph = campus(3000).graph;
        let freedom = 3.0 * (graph.edges().len() as f64);
        assert!(graph.edges().len() > 3300, "{}", graph.edges().len());
        assert!((graph.chi2() / freedom - 1.0).abs() < 0.1, "{}", graph.chi2() / freedom);
    }
}
