//! All scans of a survey in one pose graph, as a map has the places of its visits.

use hssh_metrics::{Covariance, Edge, Pose, PoseGraph, PoseId};
use hssh_topology::Position;

use super::visit::Survey;

/// A match of which one in ten thousand that is right contradicts the poses more: χ² of three numbers.
const CONTRADICTED: f64 = 21.1;
/// Where a map has two visits at one place, standard deviations of the relative pose: metres and radians.
const ONE_PLACE: (f64, f64) = (0.3, 0.05);

impl Survey {
    /// The pose graph of the closed track in another frame: `poses` are those of its scans there.
    #[must_use]
    pub fn placed_graph(&self, poses: Vec<Pose>) -> PoseGraph {
        let mut graph = self.graph.clone();
        graph.set_poses(poses).expect("there is a pose for each scan");
        graph
    }

    /// The pose graph of the scans for a map that has visits elsewhere than the closed track has them: without the matches that
    /// contradict the `poses` of the scans, and with an edge from the first visit to each place to every later one.
    #[must_use]
    pub fn bent_graph(&self, poses: Vec<Pose>, positions: &[Position]) -> PoseGraph {
        let mut graph = PoseGraph::new();
        for &pose in &poses {
            graph.add_pose(pose);
        }
        let is_step = |edge: &Edge| edge.to.0 == edge.from.0 + 1;
        let fits = |edge: &Edge| edge.chi2(poses[edge.from.index()], poses[edge.to.index()]) < CONTRADICTED;
        for edge in self.graph.edges().iter().filter(|edge| is_step(edge) || fits(edge)) {
            graph.add_edge(*edge).expect("an edge of a graph fits into one with the same poses");
        }
        let covariance = Covariance::from_standard_deviations(ONE_PLACE.0, ONE_PLACE.0, ONE_PLACE.1)
            .expect("standard deviations are positive");
        let scans: Vec<usize> = self.visits.iter().map(|visit| visit.reference).collect();
        for (later, position) in positions.iter().enumerate() {
            let first = positions.iter().position(|other| other.place == position.place).unwrap_or(later);
            let (from, to) = (scans[first], scans[later]);
            if from != to {
                let mean = poses[from].between(poses[to]);
                let edge = Edge::observed(PoseId(from as u32), PoseId(to as u32), mean, &covariance);
                graph.add_edge(edge).expect("two scans are two poses");
            }
        }
        graph.anchor_components();
        graph
    }
}
