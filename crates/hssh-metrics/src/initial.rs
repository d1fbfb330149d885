//! Poses to start from, computed from the edges alone: dead reckoning and chordal relaxation.

use std::collections::VecDeque;

use nalgebra::{Matrix2, Vector2};

use crate::components::DisjointSets;
use crate::graph::{Edge, PoseGraph};
use crate::linear::BlockMatrix;
use crate::linearization::{free_pairs, number_free_poses};
use crate::pose::Pose;
use crate::solution::{SolveError, check};

/// A relaxed direction is about of length one; one that is so short is none.
const NO_DIRECTION: f64 = 1e-9;

/// Dead reckoning: the anchored poses, and from them every other pose by compounding measurements along a
/// spanning tree. Edges between consecutive poses come first, then the others in their order, and last those that do
/// not measure every direction, so that the tree follows the odometry chain as far as there is one.
///
/// # Errors
/// As [`solve`](crate::solve): every component needs an anchored pose.
pub fn odometry_poses(graph: &PoseGraph) -> Result<Vec<Pose>, SolveError> {
    check(graph)?;
    let closures = closures(graph);
    let mut neighbors = vec![Vec::new(); graph.poses().len()];
    for (edge, _) in graph.edges().iter().zip(&closures).filter(|&(_, &closes)| !closes) {
        neighbors[edge.from.index()].push((edge.to, edge.relative_pose));
        neighbors[edge.to.index()].push((edge.from, edge.relative_pose.inverse()));
    }
    let mut poses: Vec<Option<Pose>> =
        graph.pose_ids().map(|pose| graph.is_anchored(pose).then(|| graph.pose(pose))).collect();
    let mut reached: VecDeque<_> = graph.pose_ids().filter(|&pose| graph.is_anchored(pose)).collect();
    while let Some(here) = reached.pop_front() {
        for &(there, relative_pose) in &neighbors[here.index()] {
            if poses[there.index()].is_none() {
                poses[there.index()] = poses[here.index()].map(|pose| pose.compose(relative_pose));
                reached.push_back(there);
            }
        }
    }
    Ok(poses.into_iter().map(|pose| pose.expect("every component has an anchored pose")).collect())
}

/// Whether each edge closes a loop: all do but those of the spanning tree along which [`odometry_poses`] goes,
/// in the order of the graph's edges. Anchored poses count as joined from the start.
#[must_use]
pub fn closures(graph: &PoseGraph) -> Vec<bool> {
    let mut sets = DisjointSets::singletons(graph.poses().len());
    let anchored: Vec<_> = graph.pose_ids().filter(|&pose| graph.is_anchored(pose)).collect();
    for pair in anchored.windows(2) {
        sets.join(pair[0].0, pair[1].0);
    }
    let turn = |edge: &Edge| match edge.from.0.abs_diff(edge.to.0) {
        _ if edge.information.rank() < 3 => 2,
        1 => 0,
        _ => 1,
    };
    let turns: Vec<u8> = graph.edges().iter().map(turn).collect();
    let mut closes = vec![true; graph.edges().len()];
    for turn in 0..=2 {
        let edges = graph.edges().iter().zip(&turns).zip(&mut closes);
        for ((edge, _), closes) in edges.filter(|((_, its), _)| **its == turn) {
            *closes = !sets.join(edge.from.0, edge.to.0);
        }
    }
    closes
}

/// Chordal relaxation: rotations as unconstrained pairs (cos θ, sin θ), which makes agreement with the
/// measured turns a linear least-squares problem; each pair is then scaled to length one. With the
/// rotations fixed, χ² is quadratic in the positions, and a second linear problem gives them.
///
/// It needs no poses to start from, and from where it ends the solvers reach the optimum of graphs that
/// trap them when started from dead reckoning.
///
/// # Errors
/// As [`solve`](crate::solve).
pub fn chordal_poses(graph: &PoseGraph) -> Result<Vec<Pose>, SolveError> {
    check(graph)?;
    let rotations = chordal_rotations(graph)?;
    positions(graph, &rotations)
}

/// The angles of the poses from min Σ Ω_θθ ‖r_e − R(θ°) r_s‖² over r = (cos θ, sin θ) without |r| = 1.
fn chordal_rotations(graph: &PoseGraph) -> Result<Vec<f64>, SolveError> {
    let known = |pose: Pose| Vector2::new(pose.theta.cos(), pose.theta.sin());
    let problem = EdgeSum::new(graph, known, |edge| {
        let weight = edge.information.matrix()[(2, 2)];
        LinearEdge {
            by_start: -edge.relative_pose.rotation(),
            weight: Matrix2::identity() * weight,
            constant: Vector2::zeros(),
        }
    });
    let directions = problem.minimum()?;
    // What no measured turn joins to a known direction has none; where all turns are measured, they cancel each other.
    let is_unmeasured = |edge: &Edge| edge.information.matrix()[(2, 2)] == 0.0;
    if graph.edges().iter().any(is_unmeasured)
        && directions.iter().any(|direction| direction.norm() < NO_DIRECTION)
    {
        return Err(SolveError::Singular);
    }
    Ok(directions.iter().map(|direction| direction.y.atan2(direction.x)).collect())
}

/// The poses that minimize χ² over the positions when the angles of the free poses are fixed.
fn positions(graph: &PoseGraph, angles: &[f64]) -> Result<Vec<Pose>, SolveError> {
    let problem = EdgeSum::new(graph, Pose::translation, |edge| {
        // With the angles known, the error is a linear function R(−θ_s − θ°)(t_e − t_s − R(θ_s) t°) of the
        // positions and a constant in θ; completing the square moves the constant into the former.
        let (start, end) = (Pose::new(0.0, 0.0, angles[edge.from.index()]), angles[edge.to.index()]);
        let turn = edge.error(start, Pose::new(0.0, 0.0, end)).z;
        let measured = start.compose(edge.relative_pose);
        let information = edge.information.rotated(measured.theta);
        let weight: Matrix2<f64> = information.matrix().fixed_view::<2, 2>(0, 0).into();
        let coupling: Vector2<f64> = information.matrix().fixed_view::<2, 1>(0, 2).into();
        let shift = pseudo_inverse(&weight) * coupling * turn;
        LinearEdge { by_start: -Matrix2::identity(), weight, constant: shift - measured.translation() }
    });
    let pose = |(position, angle): (&Vector2<f64>, &f64)| Pose::new(position.x, position.y, *angle);
    Ok(problem.minimum()?.iter().zip(angles).map(pose).collect())
}

/// W⁻¹; of a matrix that is zero in some direction, the inverse in the others.
fn pseudo_inverse(weight: &Matrix2<f64>) -> Matrix2<f64> {
    if let Some(cholesky) = weight.cholesky() {
        return cholesky.inverse();
    }
    let eigen = weight.symmetric_eigen();
    let zero = 1e-9 * eigen.eigenvalues.max();
    let inverse = eigen.eigenvalues.map(|value| if value > zero { 1.0 / value } else { 0.0 });
    eigen.eigenvectors * Matrix2::from_diagonal(&inverse) * eigen.eigenvectors.transpose()
}

/// An edge that asks for v_e + B v_s + c = 0 with weight W.
struct LinearEdge {
    by_start: Matrix2<f64>,
    weight: Matrix2<f64>,
    constant: Vector2<f64>,
}

/// Σ ‖v_e + B v_s + c‖²_W over the edges of a graph, one vector v of two numbers per pose.
struct EdgeSum {
    /// What is known of each pose, or which unknown it is.
    vectors: Vec<Result<usize, Vector2<f64>>>,
    matrix: BlockMatrix<2>,
    right_hand_side: Vec<f64>,
}

impl EdgeSum {
    fn new(
        graph: &PoseGraph,
        known: impl Fn(Pose) -> Vector2<f64>,
        linear: impl Fn(&Edge) -> LinearEdge,
    ) -> Self {
        let unknown = number_free_poses(graph);
        let matrix = BlockMatrix::new(graph.free_poses(), free_pairs(graph, &unknown));
        let vectors: Vec<_> = unknown
            .iter()
            .zip(graph.poses())
            .map(|(unknown, &pose)| unknown.ok_or_else(|| known(pose)))
            .collect();
        let right_hand_side = vec![0.0; 2 * graph.free_poses()];
        let mut sum = EdgeSum { vectors, matrix, right_hand_side };
        for edge in graph.edges() {
            sum.add(edge, &linear(edge));
        }
        sum
    }

    fn add(&mut self, edge: &Edge, LinearEdge { by_start, weight, constant }: &LinearEdge) {
        let (start, end) = (self.vectors[edge.from.index()], self.vectors[edge.to.index()]);
        let known_part =
            constant + end.err().unwrap_or_default() + by_start * start.err().unwrap_or_default();
        let weighted_start = by_start.transpose() * weight;
        if let Ok(s) = start {
            self.matrix.add(s, s, &(weighted_start * by_start));
            self.subtract(s, weighted_start * known_part);
        }
        if let Ok(e) = end {
            self.matrix.add(e, e, weight);
            self.subtract(e, weight * known_part);
        }
        if let (Ok(s), Ok(e)) = (start, end) {
            self.matrix.add(s, e, &weighted_start);
        }
    }

    fn subtract(&mut self, block: usize, part: Vector2<f64>) {
        self.right_hand_side[2 * block] -= part.x;
        self.right_hand_side[2 * block + 1] -= part.y;
    }

    /// One vector per pose: the known ones as they are, the others where the sum is least.
    fn minimum(self) -> Result<Vec<Vector2<f64>>, SolveError> {
        let factor = self.matrix.factorize(0.0).map_err(|_| SolveError::Singular)?;
        let solution = factor.solve(&self.right_hand_side);
        let vector = |unknown: &Result<usize, Vector2<f64>>| match unknown {
            Ok(block) => Vector2::new(solution[2 * block], solution[2 * block + 1]),
            Err(known) => *known,
        };
        Ok(self.vectors.iter().map(vector).collect())
    }
}
