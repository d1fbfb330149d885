//! What `hssh graph` says of a pose graph and of what was found: as text, and as JSON.

use std::fmt;

use hssh::answer::counted;
use hssh_draw::EdgeKind;
use hssh_metrics::{Edge, GraphFile, PoseId};
use serde::Serialize;

use super::optimize::Optimum;

/// How many edges and skipped lines the text lists.
const MOST_LISTED: usize = 8;

/// An answer in numbers. Poses have the file's labels.
#[derive(Serialize)]
pub(super) struct Report {
    file: String,
    edges: usize,
    closures: usize,
    /// Poses that are held where they are because nothing else holds their component.
    held: Vec<u64>,
    /// Degrees of freedom: what χ² is expected to be if the covariances are honest.
    degrees_of_freedom: i64,
    /// χ² of the file's poses, if it has all of them.
    file_chi2: Option<f64>,
    initial_chi2: f64,
    chi2: f64,
    robust_cost: Option<f64>,
    worst: Option<JudgedEdge>,
    steps: usize,
    counted: &'static str,
    finished: bool,
    ending: &'static str,
    seconds_reading: f64,
    seconds_solving: f64,
    /// Edges that count less than the others, or not at all.
    doubted: Vec<JudgedEdge>,
    skipped: Vec<Skipped>,
    poses: Vec<LabeledPose>,
}

#[derive(Clone, Serialize)]
struct JudgedEdge {
    from: u64,
    to: u64,
    chi2: f64,
    weight: f64,
}

#[derive(Serialize)]
struct Skipped {
    line: usize,
    record: String,
}

#[derive(Serialize)]
struct LabeledPose {
    pose: u64,
    x: f64,
    y: f64,
    theta: f64,
}

impl Report {
    /// `seconds` are those of reading and of solving.
    pub(super) fn new(
        name: String,
        file: &GraphFile,
        held: &[PoseId],
        kinds: &[EdgeKind],
        optimum: &Optimum,
        seconds: [f64; 2],
    ) -> Self {
        let graph = &file.graph;
        let label = |pose: PoseId| file.labels[pose.index()];
        let judged = |(edge, &weight): (&Edge, &f64)| {
            let ends = [edge.from, edge.to].map(|pose| optimum.poses[pose.index()]);
            JudgedEdge {
                from: label(edge.from),
                to: label(edge.to),
                chi2: edge.chi2(ends[0], ends[1]),
                weight,
            }
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
        Report {
            file: name,
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
            counted: optimum.counted,
            finished: optimum.finished,
            ending: optimum.ending,
            seconds_reading: seconds[0],
            seconds_solving: seconds[1],
            doubted: edges.into_iter().filter(|edge| edge.weight < 1.0).collect(),
            skipped: skipped.map(|line| Skipped { line: line.line, record: line.record.clone() }).collect(),
            poses: file.labels.iter().zip(&optimum.poses).map(pose).collect(),
        }
    }

    /// Whether χ² is far beyond what chance makes of honest covariances: its standard deviation is √(2 f).
    fn is_contradictory(&self) -> bool {
        let freedom = self.degrees_of_freedom as f64;
        self.finished && self.chi2 > freedom + 10.0 * (2.0 * freedom).sqrt()
    }

    /// What holds the graph in place.
    fn anchorage(&self) -> String {
        match &self.held[..] {
            [] => "held where the file fixes it".to_owned(),
            [only] => format!("pose {only} is held where it is"),
            [first, ..] => format!(
                "in {} parts that no edge joins, each held at its first pose: {first}, …",
                self.held.len()
            ),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: {}, {}, of which {}; {}",
            self.file,
            counted(self.poses.len(), "pose"),
            counted(self.edges, "edge"),
            match self.closures {
                0 => "none closes a loop".to_owned(),
                1 => "1 closes a loop".to_owned(),
                many => format!("{many} close loops"),
            },
            self.anchorage()
        )?;
        if let Some(chi2) = self.file_chi2 {
            writeln!(f, "  the file's poses   χ² {}", significant(chi2))?;
        }
        writeln!(f, "  at the start       χ² {}", significant(self.initial_chi2))?;
        let expected = match self.degrees_of_freedom {
            0 => "0 expected: nothing is measured twice".to_owned(),
            freedom => format!("about {freedom} expected if the covariances are honest"),
        };
        writeln!(f, "  at the end         χ² {}; {expected}", significant(self.chi2))?;
        if let Some(cost) = self.robust_cost {
            writeln!(f, "  robust cost        {}", significant(cost))?;
        }
        if let Some(JudgedEdge { from, to, chi2, .. }) = self.worst {
            writeln!(f, "  worst edge         {from} → {to}, χ² {}", significant(chi2))?;
        }
        writeln!(f, "  {:<18} {}", counted(self.steps, self.counted), self.ending)?;
        if self.is_contradictory() && self.doubted.is_empty() {
            writeln!(
                f,
                "  remark             the measurements contradict each other: --graduated finds wrong closures, if \
                 the covariances are not too small"
            )?;
        }
        let [reading, solving] = [self.seconds_reading, self.seconds_solving].map(|seconds| 1e3 * seconds);
        writeln!(f, "  time               reading {reading:.1} ms, solving {solving:.1} ms")?;
        let doubted = self.doubted.iter().map(|edge| match edge.weight {
            0.0 => format!("{} → {} refused, χ² {}", edge.from, edge.to, significant(edge.chi2)),
            weight => {
                format!("{} → {} counts {weight:.1e}, χ² {}", edge.from, edge.to, significant(edge.chi2))
            }
        });
        list(f, "doubted", doubted)?;
        let skipped = self.skipped.iter();
        list(f, "skipped", skipped.map(|skipped| format!("line {}: {}", skipped.line, skipped.record)))
    }
}

/// The first entries under a heading with their number; nothing if there are none.
fn list(
    f: &mut fmt::Formatter<'_>,
    heading: &str,
    entries: impl ExactSizeIterator<Item = String>,
) -> fmt::Result {
    let count = entries.len();
    if count > 0 {
        writeln!(f, "  {heading}: {count}")?;
    }
    for entry in entries.take(MOST_LISTED) {
        writeln!(f, "    {entry}")?;
    }
    match count.checked_sub(MOST_LISTED) {
        None | Some(0) => Ok(()),
        Some(more) => writeln!(f, "    … and {more} more (--json lists them)"),
    }
}

/// A number with eight significant digits, without a power of ten where it is short enough.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned(); // the sum over no edges is −0
    }
    let exponent = value.abs().log10().floor() as i32;
    match exponent {
        -5..=11 => format!("{value:.*}", usize::try_from(7 - exponent).unwrap_or(0)),
        _ => format!("{value:.7e}"), // what is not finite, too
    }
}
