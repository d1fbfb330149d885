//! What is found of a pose graph, in numbers.

use hssh::account::{JudgedEdge, LabeledPose, PoseGraphAccount, SkippedRecord};
use hssh_draw::EdgeKind;
use hssh_metrics::{Edge, GraphFile, PoseId};

use super::optimize::Optimum;

/// What was found; `seconds` are those of reading and of solving.
pub(super) fn account(
    name: String,
    file: &GraphFile,
    held: &[PoseId],
    kinds: &[EdgeKind],
    optimum: &Optimum,
    seconds: [f64; 2],
) -> PoseGraphAccount {
    let graph = &file.graph;
    let label = |pose: PoseId| file.labels[pose.index()];
    let judged = |(edge, &weight): (&Edge, &f64)| {
        let ends = [edge.from, edge.to].map(|pose| optimum.poses[pose.index()]);
        JudgedEdge { from: label(edge.from), to: label(edge.to), chi2: edge.chi2(ends[0], ends[1]), weight }
    };
    let edges: Vec<JudgedEdge> = graph.edges().iter().zip(&optimum.weights).map(judged).collect();
    let believed = edges.iter().filter(|edge| edge.weight > 0.0);
    let worst = believed.clone().max_by(|a, b| a.chi2.total_cmp(&b.chi2)).cloned();
    let degrees_of_freedom = 3 * (believed.count() as i64 - graph.free_poses() as i64);
    let pose = |(&pose, found): (&u64, &hssh_metrics::Pose)| LabeledPose {
        pose,
        x: found.x,
        y: found.y,
        theta: found.theta,
    };
    let skipped = file.skipped.iter();
    PoseGraphAccount {
        format: "hssh-pose-graph".to_owned(),
        version: 1,
        name,
        edges: edges.len(),
        closures: kinds.iter().filter(|&&kind| kind != EdgeKind::Odometry).count(),
        held: held.iter().map(|&pose| label(pose)).collect(),
        degrees_of_freedom,
        file_chi2: file.unplaced.is_empty().then(|| graph.chi2()),
        initial_chi2: optimum.initial_chi2,
        chi2: optimum.chi2,
        robust_cost: optimum.robust_cost,
        worst,
        steps: optimum.steps,
        counted: optimum.counted.to_owned(),
        finished: optimum.finished,
        ending: optimum.ending.to_owned(),
        seconds_reading: seconds[0],
        seconds_solving: seconds[1],
        doubted: edges.into_iter().filter(|edge| edge.weight < 1.0).collect(),
        skipped: skipped.map(|line| SkippedRecord { line: line.line, record: line.record.clone() }).collect(),
        poses: file.labels.iter().zip(&optimum.poses).map(pose).collect(),
    }
}
