//! Covariances of the poses of a solved graph, and what one more measurement would change.

use nalgebra::{DMatrix, Matrix3, Matrix6, SMatrix, Vector3, vector};

use crate::angle::wrap_angle;
use crate::graph::{PoseGraph, PoseId, quadratic_form};
use crate::linear::Factor;
use crate::linearization::{LinearizationPoint, NormalEquations};
use crate::pose::Pose;
use crate::solution::{SolveError, check};
use crate::uncertainty::Covariance;

/// The Gaussian around the poses that a graph holds, with covariance A⁻¹, A of (B.11) linearized there.
///
/// It is the posterior distribution of the poses if the graph holds a minimum of χ². All covariances are
/// of (x, y, θ) in the global frame: m², m·rad, rad².
pub struct Marginals {
    poses: Vec<Pose>,
    unknown: Vec<Option<usize>>,
    /// How many scalars are unknown.
    unknowns: usize,
    factor: Factor<3>,
    /// A⁻¹, if it was asked for.
    table: Option<DMatrix<f64>>,
}

/// What one more measured relative pose would do to a solved graph, to first order.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NewConstraint {
    /// By how much the minimum of χ² would rise: rᵀ (C + H Σ Hᵀ)⁻¹ r.
    pub chi2_rise: f64,
    /// By how much ln |A| would rise: ln |C + H Σ Hᵀ| − ln |C|.
    pub log_determinant_rise: f64,
    /// ln N(τ°; predicted, C + H Σ Hᵀ): how probable the measurement is, given all others.
    pub log_density: f64,
    /// The variance of the difference between the measured turn and the predicted one: rad². The estimates hold
    /// as long as it is small.
    pub heading_variance: f64,
}

impl Marginals {
    /// Linearizes and factorizes at the poses that the graph holds.
    ///
    /// # Errors
    /// As [`solve`](crate::solve).
    pub fn new(graph: &PoseGraph) -> Result<Self, SolveError> {
        check(graph)?;
        let mut equations = NormalEquations::new(graph);
        equations.linearize(graph, graph.poses(), LinearizationPoint::Estimate);
        let factor = equations.matrix.factorize(0.0).map_err(|_| SolveError::Singular)?;
        Ok(Marginals {
            poses: graph.poses().to_vec(),
            unknowns: 3 * graph.free_poses(),
            unknown: equations.into_unknowns(),
            factor,
            table: None,
        })
    }

    /// The same with all covariances computed beforehand: worth it for many questions about a small graph, as
    /// closures pose them.
    ///
    /// It solves for three right-hand sides per free pose and keeps 72 bytes for each pair of them; every question
    /// is a look-up from then on.
    #[must_use]
    pub fn tabulated(mut self) -> Self {
        let columns = (0..self.unknowns).flat_map(|unknown| self.column(unknown));
        self.table = Some(DMatrix::from_iterator(self.unknowns, self.unknowns, columns));
        self
    }

    /// ln |A|.
    #[must_use]
    pub fn log_determinant(&self) -> f64 {
        self.factor.log_determinant()
    }

    /// The covariance of one pose; zero if it is anchored.
    ///
    /// # Panics
    /// If the graph has no such pose.
    #[must_use]
    pub fn covariance(&self, pose: PoseId) -> Matrix3<f64> {
        let [covariance] = self.blocks([pose], pose);
        0.5 * (covariance + covariance.transpose())
    }

    /// The covariance of each pose, as [`covariance`](Self::covariance) has it.
    ///
    /// All of them together cost about as much as the factorization.
    #[must_use]
    pub fn covariances(&self) -> Vec<Matrix3<f64>> {
        let blocks = self.factor.inverse_diagonal_blocks();
        let of_pose = |block: &Option<usize>| {
            block.map_or_else(Matrix3::zeros, |block| 0.5 * (blocks[block] + blocks[block].transpose()))
        };
        self.unknown.iter().map(of_pose).collect()
    }

    /// The covariance of two poses, the first in the upper left block.
    ///
    /// # Panics
    /// If the graph has no such pose.
    #[must_use]
    pub fn joint(&self, first: PoseId, second: PoseId) -> Matrix6<f64> {
        let mut covariance = Matrix6::zeros();
        for (column, pose) in [first, second].into_iter().enumerate() {
            for (row, block) in self.blocks([first, second], pose).iter().enumerate() {
                covariance.fixed_view_mut::<3, 3>(3 * row, 3 * column).copy_from(block);
            }
        }
        0.5 * (covariance + covariance.transpose())
    }

    /// The relative pose of `to` in the frame of `from`, (4.1), and its covariance H Σ Hᵀ with H = (S E):
    /// x and y along the axes of `from`.
    ///
    /// # Panics
    /// If the graph has no such pose.
    #[must_use]
    pub fn relative(&self, from: PoseId, to: PoseId) -> (Pose, Matrix3<f64>) {
        let (start, end) = (self.poses[from.index()], self.poses[to.index()]);
        let (by_start, by_end) = start.between_jacobians(end);
        let mut jacobian = SMatrix::<f64, 3, 6>::zeros();
        jacobian.fixed_columns_mut::<3>(0).copy_from(&by_start);
        jacobian.fixed_columns_mut::<3>(3).copy_from(&by_end);
        (start.between(end), jacobian * self.joint(from, to) * jacobian.transpose())
    }

    /// What measuring τ° with covariance C° (of its three numbers, along the axes of `from`) would change:
    /// the price of closing a loop, without solving again.
    ///
    /// # Errors
    /// If the graph is so much vaguer than the measurement that double precision cannot compare the two.
    ///
    /// # Panics
    /// If the graph has no such pose.
    pub fn new_constraint(
        &self,
        from: PoseId,
        to: PoseId,
        relative_pose: Pose,
        covariance: &Covariance,
    ) -> Result<NewConstraint, SolveError> {
        let (predicted, spread) = self.relative(from, to);
        let residual: Vector3<f64> = vector![
            relative_pose.x - predicted.x,
            relative_pose.y - predicted.y,
            wrap_angle(relative_pose.theta - predicted.theta)
        ];
        let spread = covariance.matrix() + spread;
        // Positive definite by itself, but not in double precision if the graph is much vaguer than the measurement.
        let total = spread.cholesky().ok_or(SolveError::Singular)?;
        let log_determinant = 2.0 * total.l_dirty().diagonal().map(f64::ln).sum();
        let chi2_rise = quadratic_form(&total.inverse(), &residual);
        Ok(NewConstraint {
            chi2_rise,
            log_determinant_rise: log_determinant - covariance.log_determinant(),
            log_density: -0.5 * (chi2_rise + log_determinant + 3.0 * std::f64::consts::TAU.ln()),
            heading_variance: spread[(2, 2)],
        })
    }

    /// The 3×3 blocks of A⁻¹ in the columns of one pose and the rows of others.
    fn blocks<const ROWS: usize>(&self, rows: [PoseId; ROWS], column: PoseId) -> [Matrix3<f64>; ROWS] {
        let mut blocks = [Matrix3::zeros(); ROWS];
        let Some(first) = self.unknown[column.index()].map(|block| 3 * block) else { return blocks };
        let rows = rows.map(|row| self.unknown[row.index()].map(|block| 3 * block));
        match &self.table {
            Some(table) => {
                for (block, row) in blocks.iter_mut().zip(rows) {
                    if let Some(row) = row {
                        block.copy_from(&table.fixed_view::<3, 3>(row, first));
                    }
                }
            }
            None => {
                for axis in 0..3 {
                    let solved = self.column(first + axis);
                    for (block, row) in blocks.iter_mut().zip(rows) {
                        if let Some(row) = row {
                            block.column_mut(axis).copy_from_slice(&solved[row..row + 3]);
                        }
                    }
                }
            }
        }
        blocks
    }

    /// One column of A⁻¹.
    fn column(&self, unknown: usize) -> Vec<f64> {
        let mut unit = vec![0.0; self.unknowns];
        unit[unknown] = 1.0;
        self.factor.solve(&unit)
    }
}
