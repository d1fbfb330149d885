//! What was found of a pose graph: its poses, how well they fit, and which edges are doubted.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::answer::counted;

/// How many edges and skipped lines the text lists.
const MOST_LISTED: usize = 8;

/// A pose graph, optimized. Poses have the labels of the file; metres and radians in its frame.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PoseGraphAccount {
    /// `hssh-pose-graph`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The file, as it was given.
    pub name: String,
    /// What of the file should be in this answer and is not, in words, if there is anything.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<String>,
    /// Why the whole answer may mean nothing, if it may.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// How many edges there are, priors not among them.
    pub edges: usize,
    /// How many of them close loops.
    pub closures: usize,
    /// How many priors there are: poses measured in the frame of the world.
    pub priors: usize,
    /// Into how many parts the graph falls that no measurement joins.
    pub parts: usize,
    /// Poses that the file holds where they are.
    pub fixed: Vec<u64>,
    /// Poses that are held where they are because nothing else holds their component.
    pub held: Vec<u64>,
    /// Degrees of freedom: what χ² is expected to be if the covariances are honest.
    pub degrees_of_freedom: i64,
    /// χ² of the file's poses, if it has all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file_chi2: Option<f64>,
    /// χ² of all edges where the search began.
    pub initial_chi2: f64,
    /// χ² of the edges that were not refused.
    pub chi2: f64,
    /// What was minimized instead of χ², if anything.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robust_cost: Option<f64>,
    /// The edge that fits worst of those that were not refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<JudgedEdge>,
    /// How often whatever is `counted` was done.
    pub steps: usize,
    /// `linear system`, `sweep` or `round`.
    pub counted: String,
    /// Whether it ended as it should.
    pub finished: bool,
    /// Why it ended, in words.
    pub ending: String,
    /// Time of reading the file.
    pub seconds_reading: f64,
    /// Time of solving.
    pub seconds_solving: f64,
    /// Edges that count less than the others, or not at all.
    pub doubted: Vec<JudgedEdge>,
    /// What is worth knowing about how the file was read.
    pub remarks: Vec<String>,
    /// Records of the file that are no pose or edge in the plane, each type once.
    pub skipped: Vec<SkippedRecord>,
    /// The poses.
    pub poses: Vec<LabeledPose>,
    /// The landmarks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub landmarks: Vec<LabeledPoint>,
}

/// An edge, and how it fits.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct JudgedEdge {
    /// The label of its first pose; absent of a prior.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<u64>,
    /// The label of its second pose.
    pub to: u64,
    /// Its χ².
    pub chi2: f64,
    /// By which factor it counts; 0 if it was refused.
    pub weight: f64,
}

/// Lines of a file that were passed over, all of one type.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct SkippedRecord {
    /// The number of the first, from 1 on.
    pub line: usize,
    /// Their first word.
    pub record: String,
    /// How many there are.
    pub count: usize,
}

/// A landmark under its label.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct LabeledPoint {
    /// The label.
    pub landmark: u64,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
}

/// A pose under its label.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct LabeledPose {
    /// The label.
    pub pose: u64,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians.
    pub theta: f64,
}

impl PoseGraphAccount {
    /// Whether χ² is far beyond what chance makes of honest covariances: its standard deviation is √(2 f).
    fn is_contradictory(&self) -> bool {
        let freedom = self.degrees_of_freedom as f64;
        self.finished && self.degrees_of_freedom > 0 && self.chi2 > freedom + 10.0 * (2.0 * freedom).sqrt()
    }

    /// What holds the graph in place.
    fn anchorage(&self) -> String {
        let mut held = Vec::new();
        if self.priors > 0 {
            held.push(format!("{} in the frame of the world", counted(self.priors, "prior")));
        }
        if !self.fixed.is_empty() {
            held.push(format!("{} fixed by the file", named(&self.fixed)));
        }
        match &self.held[..] {
            [] => {}
            [only] if held.is_empty() => held.push(format!("pose {only} is held where it is")),
            _ => held.push(format!("{} held, for nothing else holds its part", named(&self.held))),
        }
        let parts = if self.parts > 1 {
            format!("in {} parts that no edge joins; ", self.parts)
        } else {
            String::new()
        };
        parts + &held.join(", ")
    }

    /// How an edge is named.
    fn name(edge: &JudgedEdge) -> String {
        edge.from.map_or_else(|| format!("prior of {}", edge.to), |from| format!("{from} → {}", edge.to))
    }
}

/// Poses by their labels, the first few of them.
fn named(poses: &[u64]) -> String {
    let shown: Vec<String> = poses.iter().take(4).map(u64::to_string).collect();
    let more = if poses.len() > shown.len() { ", …" } else { "" };
    format!("{} {}{more}", if poses.len() == 1 { "pose" } else { "poses" }, shown.join(", "))
}

impl fmt::Display for PoseGraphAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(partial) = &self.partial {
            writeln!(f, "PARTIAL: {partial}")?;
        }
        if let Some(doubt) = &self.doubt {
            writeln!(f, "DOUBTFUL: {doubt}")?;
        }
        let landmarks = match self.landmarks.len() {
            0 => String::new(),
            some => format!(", {}", counted(some, "landmark")),
        };
        writeln!(
            f,
            "{}: {}{landmarks}, {}, of which {}; {}",
            self.name,
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
        if let Some(worst) = &self.worst {
            writeln!(f, "  worst edge         {}, χ² {}", Self::name(worst), significant(worst.chi2))?;
        }
        for remark in &self.remarks {
            writeln!(f, "  remark             {remark}")?;
        }
        writeln!(f, "  {:<18} {}", counted(self.steps, &self.counted), self.ending)?;
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
            0.0 => format!("{} refused, χ² {}", Self::name(edge), significant(edge.chi2)),
            weight => format!("{} counts {weight:.1e}, χ² {}", Self::name(edge), significant(edge.chi2)),
        });
        list(f, "doubted", doubted)?;
        let skipped = self.skipped.iter();
        list(
            f,
            "skipped",
            skipped.map(|SkippedRecord { line, record, count }| match count {
                1 => format!("line {line}: {record}"),
                _ => format!("from line {line} on: {record}, {count} times"),
            }),
        )
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
