//! How far a way bends at least that comes back to where it began: a single loop, closed and laid out by itself.

use hssh_metrics::wrap_angle;
use nalgebra::{Matrix3, Vector3, vector};

use crate::measured::MeasuredTravel;

/// Of the bend that is found, so much is relied on, for it is found only to within rounding.
pub(super) const RELIED_ON: f64 = 0.9;

/// Steps of the descent, after which nothing is claimed.
const MOST_STEPS: usize = 30;

/// A closed loop misses its beginning by no more than that, m and rad.
const CLOSED: f64 = 1e-6;

/// χ²/2 of travels that lead back to where they began, into a frame turned by `turn`, at its minimum; nothing if the descent finds none.
///
/// With travels τ that are bent by δ, the way ends at P(δ). Every step bends as little as the condition allows that the loop closes, linearized
/// at the bends so far: δ = C Eᵀ λ with E = ∂P/∂δ.
pub(super) fn least_bend(travels: &[MeasuredTravel], turn: f64) -> Option<f64> {
    let mut bends = vec![Vector3::zeros(); travels.len()];
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (corners, end) = corners(travels, &bends);
        let miss = vector![-end.x, -end.y, wrap_angle(turn - end.z)];
        if miss.amax() <= CLOSED && before.is_finite() {
            return Some(before);
        }
        let mut to_close = miss;
        let mut slack = Matrix3::zeros();
        for ((travel, bend), corner) in travels.iter().zip(&bends).zip(corners.windows(2)) {
            let effect = effect(corner[0].z, corner[1], end);
            to_close += effect * bend;
            slack += effect * travel.covariance.matrix() * effect.transpose();
        }
        let force = slack.cholesky()?.solve(&to_close);
        before = 0.5 * to_close.dot(&force);
        for ((travel, bend), corner) in travels.iter().zip(&mut bends).zip(corners.windows(2)) {
            *bend = travel.covariance.matrix() * effect(corner[0].z, corner[1], end).transpose() * force;
        }
    }
    None
}

/// Where each travel begins, and the last one ends: x, y and the heading, not wrapped.
fn corners(travels: &[MeasuredTravel], bends: &[Vector3<f64>]) -> (Vec<Vector3<f64>>, Vector3<f64>) {
    let mut at: Vector3<f64> = Vector3::zeros();
    let mut corners = Vec::with_capacity(travels.len() + 1);
    corners.push(at);
    for (travel, bend) in travels.iter().zip(bends) {
        let (s, c) = at.z.sin_cos();
        let (x, y) = (travel.pose.x + bend.x, travel.pose.y + bend.y);
        at += vector![c * x - s * y, s * x + c * y, travel.pose.theta + bend.z];
        corners.push(at);
    }
    (corners, at)
}

/// By how much the end moves if a travel is bent that leaves with a heading and leads to a corner: its turn swings whatever comes after.
fn effect(heading: f64, corner: Vector3<f64>, end: Vector3<f64>) -> Matrix3<f64> {
    let (s, c) = heading.sin_cos();
    Matrix3::new(c, -s, corner.y - end.y, s, c, end.x - corner.x, 0.0, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use hssh_metrics::{Covariance, Edge, Options, Pose, PoseGraph, PoseId, solve};

    use super::*;

    fn travels(number: u32, misfit: f64) -> Vec<MeasuredTravel> {
        let covariance = Matrix3::new(0.04, 0.01, 0.001, 0.01, 0.09, 0.0, 0.001, 0.0, 0.002);
        let covariance = Covariance::new(covariance).unwrap();
        let turn = std::f64::consts::TAU / f64::from(number);
        let pose = |k: u32| Pose::new(6.0 + misfit * f64::from(k), 0.2 - 0.1 * misfit, turn + 0.02 * misfit);
        (0..number).map(|k| MeasuredTravel { pose: pose(k), covariance }).collect()
    }

    /// As a pose graph that least squares lay out.
    #[test]
    fn a_loop_bends_as_its_pose_graph_does() {
        for (number, misfit) in [(2, 0.1), (4, 0.2), (5, 0.6), (12, 0.3), (24, 0.1)] {
            let (travels, turn) = (travels(number, misfit), 0.2);
            let mut graph = PoseGraph::new();
            let mut at = Pose::IDENTITY;
            for travel in &travels {
                graph.add_pose(at);
                at = at.compose(travel.pose);
            }
            for (from, travel) in travels.iter().enumerate() {
                let is_last = from + 1 == travels.len();
                // The last travel leads to the first place, whose frame the last visit sees turned.
                let pose =
                    if is_last { travel.pose.compose(Pose::new(0.0, 0.0, -turn)) } else { travel.pose };
                let [from, to] = [from, (from + 1) % travels.len()].map(|place| PoseId(place as u32));
                graph.add_edge(Edge::observed(from, to, pose, &travel.covariance)).unwrap();
            }
            graph.anchor(PoseId(0)).unwrap();
            let expected = 0.5 * solve(&graph, &Options::default()).unwrap().chi2;
            let bend = least_bend(&travels, turn).unwrap();
            assert!(
                (bend - expected).abs() < 1e-4 * (1.0 + expected),
                "{number}, {misfit}: {bend}, {expected}"
            );
        }
    }
}
