//! What is found of a pose graph, in numbers.

use hssh_draw::EdgeKind;
use hssh_metrics::{Edge, GraphFile, PoseId, SkippedRecords};

use super::Optimized;
use crate::account::{JudgedEdge, LabeledPoint, LabeledPose, PoseGraphAccount, SkippedRecord};
use crate::answer::counted;

impl Optimized {
    /// The account of it, with a name and the time of reading.
    #[must_use]
    pub fn account(&self, name: String, seconds_reading: f64) -> PoseGraphAccount {
        let Optimized { file, optimum, .. } = self;
        let kinds = self.edge_kinds();
        let graph = &file.graph;
        let label = |pose: PoseId| file.label(pose);
        let labels = |poses: &[PoseId]| poses.iter().filter_map(|&pose| label(pose)).collect();
        let judged = |(edge, &weight): (&Edge, &f64)| {
            let ends = [edge.from, edge.to].map(|pose| optimum.poses[pose.index()]);
            let to = label(edge.to).unwrap_or_default();
            JudgedEdge { from: label(edge.from), to, chi2: edge.chi2(ends[0], ends[1]), weight }
        };
        let edges: Vec<JudgedEdge> = graph.edges().iter().zip(&optimum.weights).map(judged).collect();
        let believed = edges.iter().filter(|edge| edge.weight > 0.0);
        let worst = believed.max_by(|a, b| a.chi2.total_cmp(&b.chi2)).cloned();
        let ranks = graph.edges().iter().zip(&optimum.weights).filter(|&(_, &weight)| weight > 0.0);
        let measured: usize = ranks.map(|(edge, _)| edge.information.rank()).sum();
        let degrees_of_freedom = measured as i64 - 3 * graph.free_poses() as i64;
        let poses = graph
            .pose_ids()
            .zip(&optimum.poses)
            .filter_map(|(pose, found)| Some((pose, label(pose)?, found)));
        let (landmarks, poses): (Vec<_>, Vec<_>) = poses.partition(|&(pose, ..)| file.is_landmark(pose));
        let priors = graph.edges().iter().filter(|edge| file.is_prior(edge)).count();
        let closes = |(&kind, edge): (&EdgeKind, &Edge)| kind != EdgeKind::Odometry && !file.is_prior(edge);
        PoseGraphAccount {
            format: "hssh-pose-graph".to_owned(),
            version: 1,
            name,
            partial: partial(file),
            doubt: doubt(file),
            edges: edges.len() - priors,
            closures: kinds.iter().zip(graph.edges()).filter(|&pair| closes(pair)).count(),
            priors,
            parts: parts(file),
            fixed: labels(&self.fixed),
            held: labels(&self.held),
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
            seconds_reading,
            seconds_solving: self.seconds,
            doubted: edges.into_iter().filter(|edge| edge.weight < 1.0).collect(),
            remarks: remarks(file),
            skipped: file.skipped.iter().map(skipped).collect(),
            poses: poses
                .into_iter()
                .map(|(_, pose, found)| LabeledPose { pose, x: found.x, y: found.y, theta: found.theta })
                .collect(),
            landmarks: landmarks
                .into_iter()
                .map(|(_, landmark, found)| LabeledPoint { landmark, x: found.x, y: found.y })
                .collect(),
        }
    }
}

fn skipped(records: &SkippedRecords) -> SkippedRecord {
    SkippedRecord { line: records.line, record: records.record.clone(), count: records.count }
}

/// What of the file should be in the answer and is not, if there is anything.
fn partial(file: &GraphFile) -> Option<String> {
    let lost: Vec<&SkippedRecords> = file.skipped.iter().filter(|skipped| skipped.matters()).collect();
    let count: usize = lost.iter().map(|skipped| skipped.count).sum();
    let first = lost.first()?;
    let rest = if lost.len() > 1 { " and others" } else { "" };
    let records = if count == 1 { "record of the file is" } else { "records of the file are" };
    let space =
        if first.is_spatial() { "; it is of a graph in space, and hssh solves in the plane" } else { "" };
    Some(format!(
        "{count} {records} not in this answer: `{}` on line {}{rest}{space}",
        first.record, first.line
    ))
}

/// Why the whole answer may mean nothing.
fn doubt(file: &GraphFile) -> Option<String> {
    if let Some((line, turn)) = file.large_turn {
        return Some(format!(
            "line {line} turns by {turn} rad, more than a full circle: are these degrees? hssh takes radians"
        ));
    }
    (file.empty_edges > 0 && file.graph.edges().is_empty()).then(|| {
        "every measurement of the file has an information of zero in all directions: nothing says where a pose is".to_owned()
    })
}

/// Into how many parts the graph falls that no measurement joins; landmarks that nobody saw are none.
fn parts(file: &GraphFile) -> usize {
    let is_part = |component: &&Vec<PoseId>| {
        component.iter().any(|&pose| file.world != Some(pose) && !file.is_landmark(pose))
    };
    file.graph.components().iter().filter(is_part).count()
}

/// What is worth knowing about how the file was read.
fn remarks(file: &GraphFile) -> Vec<String> {
    let mut remarks = Vec::new();
    match file.empty_edges {
        0 => {}
        1 => remarks.push(
            "one measurement has an information of zero in all directions and counts as absent".to_owned(),
        ),
        many => remarks.push(format!(
            "{many} measurements have an information of zero in all directions and count as absent"
        )),
    }
    if !file.doubtful.is_empty() {
        let count = counted(file.doubtful.len(), "closure");
        remarks.push(format!(
            "the file holds {count} for doubtful: whether to believe them is decided as by --graduated, which takes the \
             place of switches and null hypotheses"
        ));
    }
    remarks
}
