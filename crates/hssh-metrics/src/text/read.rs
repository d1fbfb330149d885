//! Reading pose graphs: the record type decides how a line is read, and one line decides for all what `EDGE2` means.

use std::io::BufRead;

use super::error::{ReadError, ReadProblem, shown};
use super::fields::Fields;
use super::file::{GraphFile, SkippedRecords};
use super::lines::Lines;
use super::records::{EdgeRecord, Entries, Key, Records};

const VERTEX_FORM: &str = "VERTEX_SE2 id x y theta";
const POINT_FORM: &str = "VERTEX_XY id x y";
const G2O_EDGE_FORM: &str = "EDGE_SE2 from to x y theta I11 I12 I13 I22 I23 I33";
const TORO_EDGE_FORM: &str = "EDGE2 from to x y theta Ixx Ixy Iyy Itt Ixt Iyt";
const ISAM_EDGE_FORM: &str = "ODOMETRY from to x y theta R11 R12 R13 R22 R23 R33";
const SIGHTING_FORM: &str = "EDGE_SE2_XY pose landmark x y I11 I12 I22";
const ISAM_SIGHTING_FORM: &str = "LANDMARK pose landmark x y R11 R12 R22";
const PRIOR_FORM: &str = "EDGE_PRIOR_SE2 id x y theta I11 I12 I13 I22 I23 I33";
const POSITION_FORM: &str = "EDGE_PRIOR_SE2_XY id x y I11 I12 I22";
const SWITCHABLE_FORM: &str = "EDGE_SE2_SWITCHABLE from to switch x y theta I11 I12 I13 I22 I23 I33";
const MIXTURE_FORM: &str = "EDGE_SE2_MAXMIX from to weight x y theta I11 I12 I13 I22 I23 I33";
const SWITCH_FORM: &str = "VERTEX_SWITCH id value";
const SWITCH_PRIOR_FORM: &str = "EDGE_SWITCH_PRIOR id 1 information";
const FIX_FORM: &str = "FIX id [id ...]";

/// What is no pose graph has no record of one on so many lines.
const MOST_LINES_BEFORE_A_RECORD: usize = 100_000;
/// Types of records that are not read are told apart up to this many.
const MOST_SKIPPED_TYPES: usize = 50;

/// Reads a pose graph.
///
/// | record | from | read as |
/// |---|---|---|
/// | `VERTEX_SE2`, `VERTEX2` | g2o, TORO | a pose |
/// | `EDGE_SE2`, `EDGE2` | g2o, TORO | a measured relative pose |
/// | `FIX` | g2o | poses that are held where they are |
/// | `EDGE_PRIOR_SE2`, `EDGE_PRIOR_SE2_XY` | g2o | a pose, or its position, measured in the frame of the world |
/// | `VERTEX_XY`, `EDGE_SE2_XY` | g2o | a landmark, and where a pose saw it |
/// | `EDGE_SE2_SWITCHABLE`, `EDGE_SE2_MAXMIX` | Vertigo | a measurement that the file holds for doubtful |
/// | `VERTEX_SWITCH`, `EDGE_SWITCH_PRIOR` | Vertigo | not needed: whether it is believed is decided anew |
/// | `ODOMETRY`, `LANDMARK` | iSAM | an edge, a sighting, with the square root of the information |
///
/// A file with an `ODOMETRY` record is iSAM's, whose `EDGE2` has the square root of the information, row by row, of
/// errors along the axes of the start pose. Empty lines and what follows a `#` are comments. Files without vertices
/// are welcome. A matrix may be zero in some directions: they are not measured then.
///
/// # Errors
/// If a line of these types is incomplete, has a word too many, or says something impossible.
///
/// ```
/// let text = "EDGE_SE2 7 9 1.0 0.0 0.5 1 0 0 1 0 1\nEDGE_BEARING_SE2_XY 7 3 1 1\n";
/// let file = hssh_metrics::read_pose_graph(text.as_bytes())?;
/// assert_eq!(file.labels, [7, 9]);
/// assert_eq!(file.skipped[0].record, "EDGE_BEARING_SE2_XY");
/// assert!(file.skipped[0].matters());
/// # Ok::<(), hssh_metrics::ReadError>(())
/// ```
pub fn read_pose_graph(text: impl BufRead) -> Result<GraphFile, ReadError> {
    let mut lines = Lines::new(text);
    let mut reader = Reader::default();
    loop {
        let content = lines.next_line();
        let line = lines.number();
        let read = match content {
            Ok(None) => return reader.records.into_file(reader.skipped),
            Ok(Some(content)) => reader.read_line(line, &content),
            Err(problem) => Err(problem),
        };
        read.map_err(|problem| ReadError { line, problem })?;
    }
}

/// What the lines said so far.
#[derive(Default)]
struct Reader {
    records: Records,
    skipped: Vec<SkippedRecords>,
    /// Whether there was a record of a known type.
    knows_any: bool,
}

impl Reader {
    fn read_line(&mut self, line: usize, content: &str) -> Result<(), ReadProblem> {
        // Some programs begin comments by a percent sign.
        let content = content.split(['#', '%']).next().unwrap_or_default();
        let mut words = content.split_whitespace();
        let Some(record) = words.next() else { return Ok(()) };
        if self.records.read(line, &record.to_ascii_uppercase(), words)? {
            self.knows_any = true;
        } else {
            self.skip(line, shown(record));
        }
        if !self.knows_any && line >= MOST_LINES_BEFORE_A_RECORD {
            return Err(ReadProblem::NoRecords);
        }
        Ok(())
    }

    fn skip(&mut self, line: usize, record: String) {
        let record = if self.skipped.len() < MOST_SKIPPED_TYPES { record } else { "others".to_owned() };
        match self.skipped.iter_mut().find(|skipped| skipped.record == record) {
            Some(known) => known.count += 1,
            None => self.skipped.push(SkippedRecords { line, record, count: 1 }),
        }
    }
}

impl Records {
    /// Reads the words after a record type, in capitals; false if the type is not known.
    fn read(
        &mut self,
        line: usize,
        record: &str,
        words: std::str::SplitWhitespace<'_>,
    ) -> Result<bool, ReadProblem> {
        let fields = |record, form| Fields { words: words.clone(), record, form };
        match record {
            "VERTEX_SE2" | "VERTEX2" => {
                let mut fields = fields("a vertex", VERTEX_FORM);
                let label = fields.label("pose")?;
                let (pose, _) = fields.pose()?;
                fields.end()?;
                self.add_vertex(line, Key::pose(label), pose)?;
            }
            "VERTEX_XY" => {
                let mut fields = fields("a landmark", POINT_FORM);
                let label = fields.label("landmark")?;
                let point = fields.point()?;
                fields.end()?;
                self.add_vertex(line, Key::pose(label), point)?;
                self.points.insert(Key::pose(label), line);
            }
            "EDGE_SE2" => self.edges.push(edge(fields("an edge", G2O_EDGE_FORM), line, Entries::Rows)?),
            "EDGE2" => self.edges.push(edge(fields("an edge", TORO_EDGE_FORM), line, Entries::Edge2)?),
            "ODOMETRY" => {
                self.is_isam = true;
                self.edges.push(edge(fields("an edge", ISAM_EDGE_FORM), line, Entries::Edge2)?);
            }
            "EDGE_SE2_XY" => {
                let sighting =
                    sighting(fields("a sighting", SIGHTING_FORM), line, Key::pose, Entries::Point)?;
                self.points.entry(sighting.to).or_insert(line);
                self.edges.push(sighting);
            }
            "LANDMARK" => {
                let fields = fields("a sighting", ISAM_SIGHTING_FORM);
                self.isam_sightings.push(sighting(fields, line, Key::landmark, Entries::PointRoot));
            }
            "EDGE_PRIOR_SE2" => {
                let mut fields = fields("a prior", PRIOR_FORM);
                let to = Key::pose(fields.label("pose")?);
                let (relative_pose, turn) = fields.pose()?;
                let entries = Entries::Rows(fields.entries("information matrix of six numbers")?);
                fields.end()?;
                self.priors.push(EdgeRecord {
                    line,
                    from: None,
                    to,
                    relative_pose,
                    turn,
                    entries,
                    is_doubtful: false,
                });
            }
            "EDGE_PRIOR_SE2_XY" => {
                let mut fields = fields("a prior", POSITION_FORM);
                let to = Key::pose(fields.label("pose")?);
                let relative_pose = fields.point()?;
                let entries = Entries::Point(fields.entries("information matrix of three numbers")?);
                fields.end()?;
                let (from, turn, is_doubtful) = (None, 0.0, false);
                self.priors.push(EdgeRecord { line, from, to, relative_pose, turn, entries, is_doubtful });
            }
            "EDGE_SE2_SWITCHABLE" => {
                let mut fields = fields("a switchable edge", SWITCHABLE_FORM);
                let ends = ends(&mut fields)?;
                fields.label("switch")?;
                self.edges.push(measured(fields, line, ends, Entries::Rows, true)?);
            }
            "EDGE_SE2_MAXMIX" => {
                let mut fields = fields("a mixture", MIXTURE_FORM);
                let ends = ends(&mut fields)?;
                fields.part("weight of the null hypothesis")?;
                self.edges.push(measured(fields, line, ends, Entries::Rows, true)?);
            }
            "VERTEX_SWITCH" => {
                let mut fields = fields("a switch", SWITCH_FORM);
                fields.label("switch")?;
                fields.number("value")?;
                fields.end()?;
            }
            "EDGE_SWITCH_PRIOR" => {
                let mut fields = fields("the prior of a switch", SWITCH_PRIOR_FORM);
                fields.label("switch")?;
                fields.one("value that is expected")?;
                fields.positive("information")?;
                fields.end()?;
            }
            "FIX" => {
                let count = words.clone().count().max(1);
                let mut fields = fields("a fixed pose", FIX_FORM);
                for _ in 0..count {
                    self.fixed.push((line, Key::pose(fields.label("pose")?)));
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn add_vertex(&mut self, line: usize, key: Key, pose: crate::Pose) -> Result<(), ReadProblem> {
        match self.vertices.insert(key, (line, pose)) {
            Some((first, _)) => Err(ReadProblem::RepeatedPose { label: key.label, first }),
            None => Ok(()),
        }
    }
}

/// The two poses of an edge.
fn ends(fields: &mut Fields<'_>) -> Result<[u64; 2], ReadProblem> {
    let ends = [fields.label("start pose")?, fields.label("end pose")?];
    if ends[0] == ends[1] { Err(ReadProblem::SelfEdge(ends[0])) } else { Ok(ends) }
}

/// `from to x y theta`, and six numbers.
fn edge(
    mut fields: Fields<'_>,
    line: usize,
    arrange: fn([f64; 6]) -> Entries,
) -> Result<EdgeRecord, ReadProblem> {
    let ends = ends(&mut fields)?;
    measured(fields, line, ends, arrange, false)
}

/// `x y theta`, and six numbers.
fn measured(
    mut fields: Fields<'_>,
    line: usize,
    ends: [u64; 2],
    arrange: fn([f64; 6]) -> Entries,
    is_doubtful: bool,
) -> Result<EdgeRecord, ReadProblem> {
    let [from, to] = ends.map(Key::pose);
    let (relative_pose, turn) = fields.pose()?;
    let entries = arrange(fields.entries("information matrix of six numbers")?);
    fields.end()?;
    Ok(EdgeRecord { line, from: Some(from), to, relative_pose, turn, entries, is_doubtful })
}

/// `pose landmark x y`, and three numbers.
fn sighting(
    mut fields: Fields<'_>,
    line: usize,
    key: fn(u64) -> Key,
    arrange: fn([f64; 3]) -> Entries,
) -> Result<EdgeRecord, ReadProblem> {
    let (from, to) = (Key::pose(fields.label("pose")?), key(fields.label("landmark")?));
    if from == to {
        return Err(ReadProblem::SelfEdge(from.label));
    }
    let relative_pose = fields.point()?;
    let entries = arrange(fields.entries("information matrix of three numbers")?);
    fields.end()?;
    Ok(EdgeRecord { line, from: Some(from), to, relative_pose, turn: 0.0, entries, is_doubtful: false })
}
