//! Reading pose graphs from g2o and TORO text; the record type decides which of the two a line is.

use std::collections::BTreeMap;
use std::io::BufRead;

use nalgebra::{Matrix3, matrix};

use super::file::{GraphFile, SkippedLine};
use crate::graph::{Edge, GraphError, PoseGraph, PoseId};
use crate::pose::Pose;
use crate::uncertainty::{Information, UncertaintyError};

/// What is wrong with a text that should be a pose graph, and where.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ReadError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    #[source]
    pub problem: ReadProblem,
}

/// What is wrong with a line.
#[derive(Debug, thiserror::Error)]
pub enum ReadProblem {
    /// The text cannot be read any further.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
    /// The line ends too early.
    #[error("{record} ends before its {field}; a complete line is `{form}`")]
    Missing {
        /// The record type.
        record: &'static str,
        /// What should come next.
        field: &'static str,
        /// How the record is written.
        form: &'static str,
    },
    /// A word that is not what stands there.
    #[error(
        "`{token}` stands where {record} has its {field}, which must be {expected}; a complete line is `{form}`"
    )]
    Malformed {
        /// The record type.
        record: &'static str,
        /// The word.
        token: String,
        /// What it should be.
        field: &'static str,
        /// How that is written.
        expected: &'static str,
        /// How the record is written.
        form: &'static str,
    },
    /// The line goes on after its last field.
    #[error("`{token}` is one word too many for {record}; a complete line is `{form}`")]
    Superfluous {
        /// The record type.
        record: &'static str,
        /// The first word too many.
        token: String,
        /// How the record is written.
        form: &'static str,
    },
    /// Two vertex records for one pose.
    #[error("pose {label} was given on line {first} already: every pose has one vertex record")]
    RepeatedPose {
        /// The file's number for the pose.
        label: u64,
        /// The line that gave it first.
        first: usize,
    },
    /// An anchor for a pose that occurs nowhere.
    #[error("pose {0} is fixed, but no vertex and no edge mentions it")]
    UnknownFixedPose(u64),
    /// The information matrix is none.
    #[error("the information matrix from pose {from} to pose {to} is {problem}")]
    Information {
        /// The file's number for the start pose.
        from: u64,
        /// The file's number for the end pose.
        to: u64,
        /// What is wrong with it.
        problem: UncertaintyError,
    },
    /// An edge from a pose to itself.
    #[error("the edge leads from pose {0} to itself: it says nothing about where the pose is, leave it out")]
    SelfEdge(u64),
    /// The edge does not fit into the graph; poses are named by [`PoseId`].
    #[error(transparent)]
    Edge(#[from] GraphError),
}

const VERTEX_FORM: &str = "VERTEX_SE2 id x y theta";
const G2O_EDGE_FORM: &str = "EDGE_SE2 from to x y theta I11 I12 I13 I22 I23 I33";
const TORO_EDGE_FORM: &str = "EDGE2 from to x y theta Ixx Ixy Iyy Itt Ixt Iyt";
const FIX_FORM: &str = "FIX id [id ...]";

/// Reads a pose graph: `VERTEX_SE2`, `EDGE_SE2` and `FIX` as g2o writes them, `VERTEX2` and `EDGE2` as TORO
/// does. Empty lines and what follows a `#` are comments. Files without vertices are welcome.
///
/// # Errors
/// If a line of these types is incomplete, has a word too many, or says something impossible.
///
/// ```
/// let text = "EDGE_SE2 7 9 1.0 0.0 0.5 1 0 0 1 0 1\nEDGE_SE2_XY 7 3 1 1 1 0 1\n";
/// let file = hssh_metrics::read_pose_graph(text.as_bytes())?;
/// assert_eq!(file.labels, [7, 9]);
/// assert_eq!(file.skipped[0].record, "EDGE_SE2_XY");
/// # Ok::<(), hssh_metrics::ReadError>(())
/// ```
pub fn read_pose_graph(text: impl BufRead) -> Result<GraphFile, ReadError> {
    let mut records = Records::default();
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let read = content.map_err(ReadProblem::from).and_then(|content| records.read_line(line, &content));
        read.map_err(|problem| ReadError { line, problem })?;
    }
    records.into_file()
}

/// An edge as its line gives it.
struct EdgeRecord {
    line: usize,
    from: u64,
    to: u64,
    relative_pose: Pose,
    information: Information,
}

/// What the lines say, before poses are numbered.
#[derive(Default)]
struct Records {
    vertices: BTreeMap<u64, (usize, Pose)>,
    edges: Vec<EdgeRecord>,
    fixed: Vec<(usize, u64)>,
    skipped: Vec<SkippedLine>,
}

impl Records {
    fn read_line(&mut self, line: usize, content: &str) -> Result<(), ReadProblem> {
        let content = content.split('#').next().unwrap_or_default();
        let mut words = content.split_whitespace();
        let Some(record) = words.next() else { return Ok(()) };
        match record {
            "VERTEX_SE2" | "VERTEX2" => {
                let mut fields = Fields { words, record: "a vertex", form: VERTEX_FORM };
                let label = fields.label("pose")?;
                let pose = fields.pose()?;
                fields.end()?;
                if let Some((first, _)) = self.vertices.insert(label, (line, pose)) {
                    return Err(ReadProblem::RepeatedPose { label, first });
                }
            }
            "EDGE_SE2" => {
                let fields = Fields { words, record: "an edge", form: G2O_EDGE_FORM };
                self.edges.push(fields.edge(
                    line,
                    |[i11, i12, i13, i22, i23, i33]| matrix![i11, i12, i13; i12, i22, i23; i13, i23, i33],
                )?);
            }
            "EDGE2" => {
                let fields = Fields { words, record: "an edge", form: TORO_EDGE_FORM };
                self.edges.push(fields.edge(
                    line,
                    |[ixx, ixy, iyy, itt, ixt, iyt]| matrix![ixx, ixy, ixt; ixy, iyy, iyt; ixt, iyt, itt],
                )?);
            }
            "FIX" => {
                let count = words.clone().count().max(1);
                let mut fields = Fields { words, record: "a fixed pose", form: FIX_FORM };
                for _ in 0..count {
                    self.fixed.push((line, fields.label("pose")?));
                }
            }
            other => self.skipped.push(SkippedLine { line, record: other.to_owned() }),
        }
        Ok(())
    }

    fn into_file(self) -> Result<GraphFile, ReadError> {
        let mut placed: BTreeMap<u64, Option<Pose>> =
            self.vertices.into_iter().map(|(label, (_, pose))| (label, Some(pose))).collect();
        for edge in &self.edges {
            placed.entry(edge.from).or_default();
            placed.entry(edge.to).or_default();
        }
        let mut graph = PoseGraph::new();
        let (mut ids, mut unplaced) = (BTreeMap::new(), Vec::new());
        for (&label, pose) in &placed {
            let id = graph.add_pose(pose.unwrap_or_default());
            ids.insert(label, id);
            if pose.is_none() {
                unplaced.push(id);
            }
        }
        for EdgeRecord { line, from, to, relative_pose, information } in self.edges {
            graph
                .add_edge(Edge { from: ids[&from], to: ids[&to], relative_pose, information })
                .map_err(|problem| ReadError { line, problem: problem.into() })?;
        }
        for (line, label) in self.fixed {
            let unknown = ReadError { line, problem: ReadProblem::UnknownFixedPose(label) };
            let pose: &PoseId = ids.get(&label).ok_or(unknown)?;
            graph.anchor(*pose).map_err(|problem| ReadError { line, problem: problem.into() })?;
        }
        Ok(GraphFile { graph, labels: placed.into_keys().collect(), unplaced, skipped: self.skipped })
    }
}

/// The words of one line after its record type.
struct Fields<'a> {
    words: std::str::SplitWhitespace<'a>,
    record: &'static str,
    form: &'static str,
}

impl Fields<'_> {
    fn parse<T: std::str::FromStr>(
        &mut self,
        field: &'static str,
        expected: &'static str,
        accept: impl Fn(&T) -> bool,
    ) -> Result<T, ReadProblem> {
        let Fields { record, form, .. } = *self;
        let token = self.words.next().ok_or(ReadProblem::Missing { record, field, form })?;
        let value = token.parse().ok().filter(accept);
        value.ok_or_else(|| ReadProblem::Malformed { record, token: token.to_owned(), field, expected, form })
    }

    fn label(&mut self, field: &'static str) -> Result<u64, ReadProblem> {
        self.parse(field, "a whole number from 0", |_| true)
    }

    fn number(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        self.parse(field, "a finite number", |value: &f64| value.is_finite())
    }

    fn pose(&mut self) -> Result<Pose, ReadProblem> {
        Ok(Pose::new(self.number("x")?, self.number("y")?, self.number("angle")?))
    }

    fn edge(
        mut self,
        line: usize,
        arrange: impl Fn([f64; 6]) -> Matrix3<f64>,
    ) -> Result<EdgeRecord, ReadProblem> {
        let (from, to) = (self.label("start pose")?, self.label("end pose")?);
        if from == to {
            return Err(ReadProblem::SelfEdge(from));
        }
        let relative_pose = self.pose()?;
        let mut entries = [0.0; 6];
        for entry in &mut entries {
            *entry = self.number("information matrix of six numbers")?;
        }
        self.end()?;
        let information = Information::new(arrange(entries)).map_err(|problem| ReadProblem::Information {
            from,
            to,
            problem,
        })?;
        Ok(EdgeRecord { line, from, to, relative_pose, information })
    }

    fn end(mut self) -> Result<(), ReadProblem> {
        let Fields { record, form, .. } = self;
        match self.words.next() {
            None => Ok(()),
            Some(token) => Err(ReadProblem::Superfluous { record, token: token.to_owned(), form }),
        }
    }
}
