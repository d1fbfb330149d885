//! One edge linearized (appendix B.1), and the normal equations of a whole graph (appendix B.2).

use nalgebra::{Matrix3, Vector3, vector};

use crate::angle::wrap_angle;
use crate::graph::{Edge, PoseGraph, quadratic_form};
use crate::linear::BlockMatrix;
use crate::pose::{Pose, between_jacobian_by_start, frame_rotation};

/// Where the end pose of an edge is linearized.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LinearizationPoint {
    /// l_e = l_s ⊕ τ°: where the measurement says that the end pose is, (B.4).
    Measurement,
    /// l_e = π_e: where it is at present. Repeated to convergence, this is Gauss–Newton.
    Estimate,
}

/// λ(π_s, π_e) − τ° ≈ residual + S Δπ_s + E Δπ_e around the present estimates, (B.6): three numbers along
/// the axes of the start pose, to be weighted with [`Edge::start_frame_information`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LinearizedEdge {
    /// E (π_e − l_e) at the present estimates, with l_e = l_s ⊕ τ°: what is left of (B.6) when Δ = 0.
    pub residual: Vector3<f64>,
    /// S, (B.7).
    pub by_start: Matrix3<f64>,
    /// E, (B.8).
    pub by_end: Matrix3<f64>,
}

impl LinearizedEdge {
    /// Linearizes an edge whose poses are at present `start` and `end`.
    #[must_use]
    pub fn new(edge: &Edge, start: Pose, end: Pose, point: LinearizationPoint) -> Self {
        let by_end = frame_rotation(-start.theta); // (B.8)
        let measured_end = start.compose(edge.relative_pose); // (B.4)
        let offset = vector![
            end.x - measured_end.x,
            end.y - measured_end.y,
            wrap_angle(end.theta - measured_end.theta) // after a loop it may be off by 2πk
        ];
        let tau = match point {
            LinearizationPoint::Measurement => edge.relative_pose,
            LinearizationPoint::Estimate => start.between(end),
        };
        let by_start = between_jacobian_by_start(start.theta, tau); // (B.7)
        LinearizedEdge { residual: by_end * offset, by_start, by_end }
    }
}

/// A Δ = b of (B.11) and (B.12) for the free poses of a graph, solved for increments Δ = π − l: the sum in
/// b then holds the residuals only, which is better conditioned than absolute poses.
pub(crate) struct NormalEquations {
    /// Which three rows belong to a pose; anchored poses have none.
    unknown: Vec<Option<usize>>,
    /// Σ of the blocks of (B.11).
    pub(crate) matrix: BlockMatrix<3>,
    /// Σ of the blocks of (B.12).
    pub(crate) right_hand_side: Vec<f64>,
    /// Σ rᵀ Ω r at the present estimates.
    pub(crate) chi2: f64,
    information: Vec<Matrix3<f64>>,
}

impl NormalEquations {
    /// Lays out the equations; [`NormalEquations::linearize`] fills them.
    pub(crate) fn new(graph: &PoseGraph) -> Self {
        let unknown = number_free_poses(graph);
        let unknowns = graph.free_poses();
        let pairs = free_pairs(graph, &unknown);
        NormalEquations {
            matrix: BlockMatrix::new(unknowns, pairs),
            right_hand_side: vec![0.0; 3 * unknowns],
            chi2: 0.0,
            information: graph.edges().iter().map(|edge| *edge.start_frame_information().matrix()).collect(),
            unknown,
        }
    }

    /// Fills A and b at the given poses.
    pub(crate) fn linearize(&mut self, graph: &PoseGraph, poses: &[Pose], point: LinearizationPoint) {
        self.matrix.set_zero();
        self.right_hand_side.fill(0.0);
        self.chi2 = 0.0;
        for (edge, information) in graph.edges().iter().zip(&self.information) {
            let (start, end) = (edge.from.index(), edge.to.index());
            let LinearizedEdge { residual, by_start, by_end } =
                LinearizedEdge::new(edge, poses[start], poses[end], point);
            self.chi2 += quadratic_form(information, &residual);
            let weighted_start = by_start.transpose() * information; // Sᵀ C⁻¹
            let weighted_end = by_end.transpose() * information; // Eᵀ C⁻¹
            if let Some(s) = self.unknown[start] {
                self.matrix.add(s, s, &(weighted_start * by_start)); // (B.11)
                subtract(&mut self.right_hand_side, s, weighted_start * residual); // (B.12)
            }
            if let Some(e) = self.unknown[end] {
                self.matrix.add(e, e, &(weighted_end * by_end));
                subtract(&mut self.right_hand_side, e, weighted_end * residual);
            }
            if let (Some(s), Some(e)) = (self.unknown[start], self.unknown[end]) {
                self.matrix.add(s, e, &(weighted_start * by_end));
            }
        }
    }

    /// The poses moved by the increments of their unknowns.
    pub(crate) fn moved(&self, poses: &[Pose], increments: &[f64]) -> Vec<Pose> {
        let moved = |(pose, unknown): (&Pose, &Option<usize>)| match unknown {
            None => *pose,
            Some(block) => {
                let increment = &increments[3 * block..][..3];
                Pose::new(pose.x + increment[0], pose.y + increment[1], pose.theta + increment[2])
            }
        };
        poses.iter().zip(&self.unknown).map(moved).collect()
    }

    /// The diagonal of A at the poses that a graph holds.
    pub(crate) fn diagonal(&self, graph: &PoseGraph) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.right_hand_side.len()];
        for (edge, information) in graph.edges().iter().zip(&self.information) {
            let [start, end] = [edge.from, edge.to].map(|pose| graph.pose(pose));
            let linearized = LinearizedEdge::new(edge, start, end, LinearizationPoint::Estimate);
            let sides = [(edge.from, linearized.by_start), (edge.to, linearized.by_end)];
            for (pose, jacobian) in sides {
                let Some(block) = self.unknown[pose.index()] else { continue };
                let weighted = jacobian.transpose() * information * jacobian;
                for (entry, value) in diagonal[3 * block..][..3].iter_mut().zip(weighted.diagonal().iter()) {
                    *entry += value;
                }
            }
        }
        diagonal
    }

    /// Which three rows belong to each pose, if it is free.
    pub(crate) fn unknowns(&self) -> &[Option<usize>] {
        &self.unknown
    }

    /// The same, for good.
    pub(crate) fn into_unknowns(self) -> Vec<Option<usize>> {
        self.unknown
    }
}

fn subtract(vector: &mut [f64], block: usize, part: Vector3<f64>) {
    for (entry, value) in vector[3 * block..][..3].iter_mut().zip(part.iter()) {
        *entry -= value;
    }
}

/// Numbers the free poses from 0.
pub(crate) fn number_free_poses(graph: &PoseGraph) -> Vec<Option<usize>> {
    let mut count = 0..;
    graph.pose_ids().map(|pose| if graph.is_anchored(pose) { None } else { count.next() }).collect()
}

/// The unknowns at the two ends of every edge between free poses.
pub(crate) fn free_pairs(graph: &PoseGraph, unknown: &[Option<usize>]) -> Vec<(usize, usize)> {
    let pair = |edge: &Edge| Some((unknown[edge.from.index()]?, unknown[edge.to.index()]?));
    graph.edges().iter().filter_map(pair).collect()
}
