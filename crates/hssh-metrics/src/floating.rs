//! Which poses could move without any measurement noticing.

use crate::components::DisjointSets;
use crate::graph::{PoseGraph, PoseId};
use crate::linearization::{LinearizationPoint, NormalEquations};

/// How much stiffness is lent to every direction, as a part of its own, so that there is a factor at all.
const LENT: f64 = 1e-13;
/// A motion that is resisted by less than this part of what resists its parts one by one is free.
const FREE: f64 = 1e-12;
/// Steps of inverse iteration: each raises what is free over everything else by orders of magnitude.
const STEPS: usize = 4;
/// What moves by more than this part of the largest motion takes part in it.
const TAKES_PART: f64 = 1e-3;

/// The poses that take part in a motion which no measurement resists, at the poses that the graph holds; empty if
/// there is no such motion.
///
/// With measurements of every direction, it is enough that each component has an anchored pose. Measurements that do
/// not measure some direction (positions without headings, ranges) may leave more free: a single measured position
/// does not keep a map from turning around it.
#[must_use]
pub fn floating_poses(graph: &PoseGraph) -> Vec<PoseId> {
    if is_rigid(graph) {
        return Vec::new();
    }
    let mut equations = NormalEquations::new(graph);
    equations.linearize(graph, graph.poses(), LinearizationPoint::Estimate);
    let diagonal = equations.diagonal(graph);
    let block_of = equations.unknowns();
    let poses_of = |is_moving: &dyn Fn(usize) -> bool| -> Vec<PoseId> {
        let moves = |pose: &PoseId| {
            block_of[pose.index()].is_some_and(|block| (3 * block..3 * block + 3).any(is_moving))
        };
        graph.pose_ids().filter(moves).collect()
    };
    // What not a single measurement touches needs no equation.
    let untouched = poses_of(&|row| diagonal[row] <= 0.0);
    if !untouched.is_empty() || diagonal.is_empty() {
        return untouched;
    }
    let Ok(factor) = equations.matrix.factorize(LENT) else { return poses_of(&|_| true) };
    // Scaled so that every direction by itself has stiffness one.
    let mut motion: Vec<f64> = (0..diagonal.len()).map(|row| 1.0 + 0.5 * (row as f64).sin()).collect();
    let mut resisted = 1.0;
    for _ in 0..STEPS {
        let scaled: Vec<f64> =
            motion.iter().zip(&diagonal).map(|(part, stiff)| part * stiff.sqrt()).collect();
        let solved = factor.solve(&scaled);
        let next: Vec<f64> = solved.iter().zip(&diagonal).map(|(part, stiff)| part * stiff.sqrt()).collect();
        let (length, before) = (norm(&next), norm(&motion));
        if !length.is_finite() {
            return poses_of(&|_| true);
        }
        resisted = before / length - LENT;
        motion = next.into_iter().map(|part| part / length).collect();
    }
    let largest = motion.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
    if resisted > FREE { Vec::new() } else { poses_of(&|row| motion[row].abs() > TAKES_PART * largest) }
}

/// Whether measurements of every direction join all poses to one that is anchored.
fn is_rigid(graph: &PoseGraph) -> bool {
    let mut bodies = DisjointSets::singletons(graph.poses().len());
    for edge in graph.edges().iter().filter(|edge| edge.information.rank() == 3) {
        bodies.join(edge.from.0, edge.to.0);
    }
    let mut held = vec![false; graph.poses().len()];
    for pose in graph.pose_ids().filter(|&pose| graph.is_anchored(pose)) {
        held[bodies.representative(pose.0) as usize] = true;
    }
    graph.pose_ids().all(|pose| held[bodies.representative(pose.0) as usize])
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}
