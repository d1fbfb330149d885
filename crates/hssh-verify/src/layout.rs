//! Layouts of a map: dense nonlinear least squares over the poses of its places.
//!
//! A measured travel from place p to place q says `⊖π_p ⊕ π_q = τ` with covariance C. The layout minimises
//! χ² = Σ eᵀ C⁻¹ e with e = (⊖π_p ⊕ π_q) − τ, the first place fixed at the origin.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix3};

use crate::pose::{Pose, wrap};

/// A travel placed in a map.
#[derive(Clone)]
pub(crate) struct Factor {
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// The pose of `to` in the frame of `from`.
    pub(crate) tau: Pose,
    pub(crate) covariance: Matrix3<f64>,
    pub(crate) information: Matrix3<f64>,
}

/// The poses of all places and what they leave of χ²/2.
#[derive(Clone)]
pub(crate) struct Layout {
    pub(crate) poses: Vec<Pose>,
    pub(crate) bend: f64,
}

/// The Gauss–Newton matrix of a layout, decomposed.
pub(crate) type Curvature = Cholesky<f64, Dyn>;

impl Factor {
    /// Half of what it adds to χ².
    fn bend(&self, poses: &[Pose]) -> f64 {
        let error = if self.from == self.to {
            Pose::ORIGIN.minus(self.tau)
        } else {
            poses[self.from].sees(poses[self.to]).minus(self.tau)
        };
        0.5 * error.dot(&(self.information * error))
    }
}

/// χ²/2 of a layout.
pub(crate) fn bend(poses: &[Pose], factors: &[Factor]) -> f64 {
    factors.iter().map(|factor| factor.bend(poses)).sum()
}

/// The Gauss–Newton matrix and the gradient of χ²/2; the first pose has no columns.
pub(crate) fn normal_equations(poses: &[Pose], factors: &[Factor]) -> (DMatrix<f64>, DVector<f64>) {
    let n = 3 * (poses.len() - 1);
    let (mut matrix, mut gradient) = (DMatrix::zeros(n, n), DVector::zeros(n));
    for factor in factors.iter().filter(|factor| factor.from != factor.to) {
        let (from, to) = (poses[factor.from], poses[factor.to]);
        let error = from.sees(to).minus(factor.tau);
        let derivatives = from.sees_derivatives(to);
        let places = [factor.from, factor.to];
        for (&row, by_row) in places.iter().zip(&derivatives).filter(|(row, _)| **row > 0) {
            let weighted = by_row.transpose() * factor.information;
            let mut part = gradient.fixed_rows_mut::<3>(3 * (row - 1));
            part += weighted * error;
            for (&column, by_column) in places.iter().zip(&derivatives).filter(|(column, _)| **column > 0) {
                let mut block = matrix.fixed_view_mut::<3, 3>(3 * (row - 1), 3 * (column - 1));
                block += weighted * by_column;
            }
        }
    }
    (matrix, gradient)
}

/// The decomposed Gauss–Newton matrix at a layout, if it is positive definite.
pub(crate) fn curvature(poses: &[Pose], factors: &[Factor]) -> Option<Curvature> {
    normal_equations(poses, factors).0.cholesky()
}

fn moved(poses: &[Pose], step: &DVector<f64>) -> Vec<Pose> {
    let mut moved = poses.to_vec();
    for (pose, by) in moved[1..].iter_mut().zip(step.as_slice().chunks_exact(3)) {
        *pose = Pose::new(pose.x + by[0], pose.y + by[1], pose.theta + by[2]);
    }
    moved
}

/// Descends from a layout to a minimum by Gauss–Newton steps, damped where they do not descend.
pub(crate) fn descend(start: Vec<Pose>, factors: &[Factor]) -> Layout {
    const MOST_STEPS: usize = 200;
    let mut layout = Layout { bend: bend(&start, factors), poses: start };
    if layout.poses.len() < 2 {
        return layout;
    }
    let mut damping = 0.0;
    for _ in 0..MOST_STEPS {
        let (matrix, gradient) = normal_equations(&layout.poses, factors);
        let mut descended = None;
        while descended.is_none() && damping < 1e12 {
            let mut damped = matrix.clone();
            for i in 0..damped.nrows() {
                damped[(i, i)] *= 1.0 + damping;
            }
            if let Some(decomposed) = damped.cholesky() {
                let step = -decomposed.solve(&gradient);
                let poses = moved(&layout.poses, &step);
                let lower = bend(&poses, factors);
                let promised = -0.5 * gradient.dot(&step);
                if lower <= layout.bend || promised <= 1e-13 * (1.0 + layout.bend) {
                    descended = Some((poses, lower, promised));
                    break;
                }
            }
            damping = if damping == 0.0 { 1e-4 } else { damping * 10.0 };
        }
        let Some((poses, lower, promised)) = descended else { return layout };
        if lower <= layout.bend {
            layout = Layout { poses, bend: lower };
        }
        if promised <= 1e-13 * (1.0 + layout.bend) {
            return layout;
        }
        damping = if damping < 1e-6 { 0.0 } else { damping / 10.0 };
    }
    layout
}

/// Descends from several layouts and keeps the lowest minimum. When they part, or end far above `before`, what
/// χ²/2 was without the last travel, one more start is made with the headings solved first.
pub(crate) fn lowest(starts: Vec<Vec<Pose>>, factors: &[Factor], before: f64) -> Layout {
    const FAR: f64 = 3.0;
    let mut minima: Vec<Layout> = starts.into_iter().map(|start| descend(start, factors)).collect();
    let bends = || minima.iter().map(|layout| layout.bend);
    let (least, most) = (bends().fold(f64::INFINITY, f64::min), bends().fold(0.0, f64::max));
    if most - least > 1e-7 * (1.0 + least) || least - before > FAR {
        let first = minima.first().map(|layout| layout.poses.clone());
        let headed = first.and_then(|poses| headings_first(&poses, factors));
        minima.extend(headed.map(|start| descend(start, factors)));
    }
    let least = minima.into_iter().min_by(|a, b| a.bend.total_cmp(&b.bend));
    least.expect("a layout is sought from at least one start")
}

/// A start that owes nothing to positions: headings from the turns alone, then positions given the headings.
fn headings_first(poses: &[Pose], factors: &[Factor]) -> Option<Vec<Pose>> {
    let n = poses.len() - 1;
    let linked = || factors.iter().filter(|factor| factor.from != factor.to);
    let mut matrix = DMatrix::zeros(n, n);
    let mut right = DVector::zeros(n);
    for factor in linked() {
        let turned = poses[factor.to].theta - poses[factor.from].theta;
        let miss = wrap(factor.tau.theta - turned) / factor.covariance[(2, 2)];
        for (row, sign) in [(factor.from, -1.0), (factor.to, 1.0)] {
            if row > 0 {
                right[row - 1] += sign * miss;
                for (column, other) in [(factor.from, -1.0), (factor.to, 1.0)] {
                    if column > 0 {
                        matrix[(row - 1, column - 1)] += sign * other / factor.covariance[(2, 2)];
                    }
                }
            }
        }
    }
    let turns = matrix.cholesky()?.solve(&right);
    let mut start = poses.to_vec();
    for (pose, turn) in start[1..].iter_mut().zip(turns.iter()) {
        pose.theta += turn;
    }
    // With the headings held fast, positions are a linear problem: one step over x and y only.
    let (full, gradient) = normal_equations(&start, factors);
    let at = |i: usize| 3 * (i / 2) + i % 2;
    let positions = DMatrix::from_fn(2 * n, 2 * n, |row, column| full[(at(row), at(column))]);
    let slope = DVector::from_fn(2 * n, |row, _| gradient[at(row)]);
    let step = positions.cholesky()?.solve(&slope);
    for (place, pose) in start[1..].iter_mut().enumerate() {
        pose.x -= step[2 * place];
        pose.y -= step[2 * place + 1];
    }
    Some(start)
}

/// ½ ln(|C + H Σ Hᵀ| / |C|): how vaguely a layout predicts a travel between two of its places.
pub(crate) fn vagueness(poses: &[Pose], curvature: Option<&Curvature>, factor: &Factor) -> f64 {
    let Some(curvature) = curvature else { return 0.0 };
    if factor.from == factor.to {
        return 0.0;
    }
    let derivatives = poses[factor.from].sees_derivatives(poses[factor.to]);
    let mut transposed = DMatrix::zeros(3 * (poses.len() - 1), 3);
    for (place, by) in [factor.from, factor.to].into_iter().zip(derivatives).filter(|(place, _)| *place > 0) {
        transposed.fixed_view_mut::<3, 3>(3 * (place - 1), 0).copy_from(&by.transpose());
    }
    let spread = transposed.transpose() * curvature.solve(&transposed);
    let predicted = factor.covariance + spread.fixed_view::<3, 3>(0, 0);
    (0.5 * (predicted.determinant() / factor.covariance.determinant()).ln()).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn factor(from: usize, to: usize, tau: Pose) -> Factor {
        let covariance = Matrix3::new(0.04, 0.01, 0.001, 0.01, 0.09, 0.0, 0.001, 0.0, 0.002);
        let information = covariance.try_inverse().unwrap();
        Factor { from, to, tau, covariance, information }
    }

    fn square(noise: f64) -> (Vec<Pose>, Vec<Factor>) {
        let side =
            |k: usize, way: f64| factor(k, (k + 1) % 4, Pose::new(way, 0.1 * noise, PI / 2.0 + 0.05 * noise));
        let factors = (0..4).map(|k| side(k, 8.0 + noise * k as f64 / 3.0)).collect::<Vec<_>>();
        let mut poses = vec![Pose::ORIGIN];
        for factor in &factors[..3] {
            poses.push(poses.last().unwrap().compose(factor.tau));
        }
        (poses, factors)
    }

    #[test]
    fn the_gradient_is_that_of_finite_differences() {
        let (mut poses, factors) = square(1.0);
        for (k, pose) in poses[1..].iter_mut().enumerate() {
            *pose = Pose::new(pose.x + 0.3, pose.y - 0.2 * k as f64, pose.theta + 2.0 * k as f64);
        }
        let (_, gradient) = normal_equations(&poses, &factors);
        for i in 0..9 {
            let shifted = |by: f64| {
                bend(&moved(&poses, &DVector::from_fn(9, |j, _| if i == j { by } else { 0.0 })), &factors)
            };
            let slope = (shifted(1e-6) - shifted(-1e-6)) / 2e-6;
            assert!((gradient[i] - slope).abs() < 1e-4 * (1.0 + slope.abs()), "{i}: {} {slope}", gradient[i]);
        }
    }

    #[test]
    fn derivatives_of_poses_are_those_of_finite_differences() {
        let (a, b) = (Pose::new(1.0, -2.0, 2.5), Pose::new(-3.0, 0.5, -1.2));
        type Join = fn(Pose, Pose) -> Pose;
        type Derive = fn(Pose, Pose) -> [Matrix3<f64>; 2];
        let both: [(Join, Derive); 2] =
            [(Pose::sees, Pose::sees_derivatives), (Pose::compose, Pose::compose_derivatives)];
        for (join, derive) in both {
            for which in 0..2 {
                for column in 0..3 {
                    let shifted = |by: f64| {
                        let mut pair = [a, b];
                        let pose = &mut pair[which];
                        *[&mut pose.x, &mut pose.y, &mut pose.theta][column] += by;
                        join(pair[0], pair[1])
                    };
                    let slope = shifted(1e-6).minus(shifted(-1e-6)) / 2e-6;
                    assert!((derive(a, b)[which].column(column) - slope).norm() < 1e-8);
                }
            }
        }
    }

    #[test]
    fn a_loop_without_errors_closes_from_a_bad_start() {
        let (poses, factors) = square(0.0);
        let start =
            poses.iter().map(|pose| Pose::new(pose.x * 1.2, pose.y - 0.3 * pose.x, pose.theta)).collect();
        assert!(descend(start, &factors).bend < 1e-18);
    }

    #[test]
    fn at_the_minimum_nothing_near_is_lower_and_odometry_agrees() {
        let (poses, factors) = square(1.0);
        let layout = lowest(
            vec![poses.clone(), poses.iter().map(|p| Pose::new(p.x, p.y + 1.0, p.theta)).collect()],
            &factors,
            0.0,
        );
        let (_, gradient) = normal_equations(&layout.poses, &factors);
        assert!(gradient.norm() < 1e-5, "{gradient}");
        let headed = headings_first(&poses, &factors).unwrap();
        assert!((descend(headed, &factors).bend - layout.bend).abs() < 1e-9);
    }

    /// Along a line everything is linear: two ways of length 10 and 11 with equal variances meet at 10.5.
    #[test]
    fn two_measurements_of_one_way_are_averaged() {
        let one = |way: f64| {
            let covariance = Matrix3::from_diagonal_element(0.5);
            Factor {
                from: 0,
                to: 1,
                tau: Pose::new(way, 0.0, 0.0),
                covariance,
                information: covariance.try_inverse().unwrap(),
            }
        };
        let factors = [one(10.0), one(11.0)];
        let layout = descend(vec![Pose::ORIGIN, Pose::new(3.0, 1.0, 0.4)], &factors);
        assert!((layout.poses[1].x - 10.5).abs() < 1e-9);
        assert!((layout.bend - 0.5).abs() < 1e-12);
        // The first way leaves a covariance of C, so that the second is predicted with 2 C, twice in each direction.
        let curvature = curvature(&[Pose::ORIGIN, Pose::new(10.0, 0.0, 0.0)], &factors[..1]);
        let spread = vagueness(&[Pose::ORIGIN, Pose::new(10.0, 0.0, 0.0)], curvature.as_ref(), &factors[1]);
        assert!((spread - 1.5 * 2.0_f64.ln()).abs() < 1e-12);
    }
}
