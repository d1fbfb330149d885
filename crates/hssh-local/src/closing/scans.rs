//! All scans of a log in one pose graph, once the loops between its keyframes are closed.

use hssh_metrics::{Edge, Options, Pose, PoseGraph, PoseId, solve};

use super::close::ClosingError;
use super::keyframe::Keyframe;
use crate::matching::Track;

/// A pose for every scan, an edge for every tracked step, and one for each of the keyframes' edges that closes a loop. The poses
/// are those of its least squares. `between` is the solved graph of the keyframes.
pub(super) fn all_scans(
    track: &Track,
    keyframes: &[Keyframe],
    between: &PoseGraph,
) -> Result<PoseGraph, ClosingError> {
    let mut graph = PoseGraph::new();
    for pose in spread(keyframes, between.poses(), track) {
        graph.add_pose(pose);
    }
    for (scan, tracked) in (0_u32..).zip(&track.scans) {
        if let (Some(before), Some(step)) = (scan.checked_sub(1), &tracked.step) {
            graph.add_edge(Edge::observed(PoseId(before), PoseId(scan), step.mean, &step.covariance))?;
        }
    }
    let scan = |keyframe: PoseId| PoseId(keyframes[keyframe.index()].scan as u32);
    for edge in between.edges().iter().filter(|edge| edge.to.0 != edge.from.0 + 1) {
        graph.add_edge(Edge { from: scan(edge.from), to: scan(edge.to), ..*edge })?;
    }
    graph.anchor_components();
    let solution = solve(&graph, &Options::default())?;
    graph.set_poses(solution.poses)?;
    Ok(graph)
}

/// Where least squares begin: between keyframes the tracked motion, bent so that it begins and ends at theirs.
fn spread(keyframes: &[Keyframe], poses: &[Pose], track: &Track) -> Vec<Pose> {
    let mut all = vec![Pose::IDENTITY; track.scans.len()];
    for (index, pair) in keyframes.windows(2).enumerate() {
        let (start, end) = (poses[index], poses[index + 1]);
        let last = start.compose(pair[0].tracked.between(pair[1].tracked));
        let correction = last.between(end).log();
        let length = (pair[1].scan - pair[0].scan) as f64;
        let scans = pair[0].scan..=pair[1].scan;
        for (number, scan) in scans.enumerate() {
            let moved = start.compose(pair[0].tracked.between(track.scans[scan].pose));
            all[scan] = moved.compose(Pose::exp(correction * (number as f64 / length)));
        }
    }
    if let ([_], [only]) = (keyframes, poses) {
        all.fill(*only);
    }
    all
}
