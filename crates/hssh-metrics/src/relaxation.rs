//! Relaxation: one pose after the other moves to where its own measurements want it (section 4.4, after
//! Duckett, Marsland and Shapiro 2002).

use nalgebra::{Matrix3, Vector3};

use crate::graph::{Edge, PoseGraph, PoseId};
use crate::linearization::{LinearizationPoint, LinearizedEdge};
use crate::pose::Pose;
use crate::solution::{Options, SolveError, check};

/// A pose graph relaxed.
#[derive(Clone, PartialEq, Debug)]
pub struct Relaxation {
    /// The poses, by [`PoseId`].
    pub poses: Vec<Pose>,
    /// χ² of the graph at these poses.
    pub chi2: f64,
    /// How many times every pose had its turn.
    pub sweeps: usize,
    /// Whether the last sweep lowered χ² by less than the tolerance.
    pub converged: bool,
}

/// Lowers χ² without ever factorizing a large matrix: in each sweep, every free pose in its order makes one
/// Gauss–Newton step of its own while all others stand still, unless that would raise χ². Of the options, the number of
/// iterations is that of sweeps, and the method does not matter.
///
/// A sweep costs time in proportion to the edges. Errors spread over neighbors soon and around long loops
/// only slowly, so it is for polishing, for graphs that change a little at a time, and for checking
/// [`solve`](crate::solve), with which it shares no linear algebra. It has converged when a sweep lowers χ² by less
/// than the tolerance · (1 + χ²), which says less about the distance to the minimum than a solver's promise.
///
/// # Errors
/// As [`solve`](crate::solve).
pub fn relax(graph: &PoseGraph, options: &Options) -> Result<Relaxation, SolveError> {
    let Options { max_iterations: max_sweeps, tolerance, interrupted, .. } = *options;
    check(graph)?;
    let mut incident = vec![Vec::new(); graph.poses().len()];
    for edge in graph.edges() {
        let weighted = (*edge, *edge.start_frame_information().matrix());
        incident[edge.from.index()].push(weighted);
        incident[edge.to.index()].push(weighted);
    }
    let mut poses = graph.poses().to_vec();
    let mut chi2 = graph.chi2();
    if !chi2.is_finite() {
        return Err(SolveError::Overflow);
    }
    for sweep in 1..=max_sweeps {
        if interrupted() {
            return Ok(Relaxation { poses, chi2, sweeps: sweep - 1, converged: false });
        }
        for pose in graph.pose_ids().filter(|&pose| !graph.is_anchored(pose)) {
            relax_pose(pose, &incident[pose.index()], &mut poses);
        }
        let before = chi2;
        chi2 = graph.chi2_at(&poses);
        if before - chi2 <= tolerance * (1.0 + chi2) {
            return Ok(Relaxation { poses, chi2, sweeps: sweep, converged: true });
        }
    }
    Ok(Relaxation { poses, chi2, sweeps: max_sweeps, converged: false })
}

/// Moves one pose to the minimum of its linearized edges, if χ² falls there.
fn relax_pose(pose: PoseId, incident: &[(Edge, Matrix3<f64>)], poses: &mut [Pose]) {
    let (mut matrix, mut right_hand_side) = (Matrix3::zeros(), Vector3::zeros());
    for (edge, information) in incident {
        let (start, end) = (poses[edge.from.index()], poses[edge.to.index()]);
        let linearized = LinearizedEdge::new(edge, start, end, LinearizationPoint::Estimate);
        let jacobian = if edge.from == pose { linearized.by_start } else { linearized.by_end };
        let weighted = jacobian.transpose() * information;
        matrix += weighted * jacobian;
        right_hand_side -= weighted * linearized.residual;
    }
    let Some(cholesky) = matrix.cholesky() else { return };
    let step = cholesky.solve(&right_hand_side);
    let chi2 = |poses: &[Pose]| -> f64 {
        incident.iter().map(|(edge, _)| edge.chi2(poses[edge.from.index()], poses[edge.to.index()])).sum()
    };
    let (here, before) = (poses[pose.index()], chi2(poses));
    poses[pose.index()] = Pose::new(here.x + step.x, here.y + step.y, here.theta + step.z);
    // Written so that a χ² which is no number is refused as well.
    let falls = chi2(poses) < before;
    if !falls {
        poses[pose.index()] = here;
    }
}
