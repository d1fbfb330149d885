//! What the lines of a pose graph say, before poses are numbered; and the graph that it makes.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, matrix};

use super::error::{ReadError, ReadProblem};
use super::fields::{as_toro, by_rows, of_point, squared};
use super::file::{GraphFile, SkippedRecords};
use crate::graph::{Edge, PoseGraph, PoseId};
use crate::pose::Pose;
use crate::uncertainty::{Information, UncertaintyError};

/// A turn that is larger is no angle in radians, as a rule; a full circle with some room for rounding.
const LARGE_TURN: f64 = 6.4;

/// What a record names: iSAM numbers landmarks apart from poses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Key {
    is_apart: bool,
    pub(super) label: u64,
}

impl Key {
    pub(super) fn pose(label: u64) -> Self {
        Key { is_apart: false, label }
    }

    pub(super) fn landmark(label: u64) -> Self {
        Key { is_apart: true, label }
    }
}

/// The numbers of an information matrix as they stand in a line.
#[derive(Clone, Copy)]
pub(super) enum Entries {
    /// The upper triangle row by row.
    Rows([f64; 6]),
    /// In TORO's order, or, in a file of iSAM's, its square root row by row.
    Edge2([f64; 6]),
    /// Of x and y alone.
    Point([f64; 3]),
    /// The square root of the same.
    PointRoot([f64; 3]),
}

/// An edge as its line gives it; a prior comes from nowhere.
pub(super) struct EdgeRecord {
    pub(super) line: usize,
    pub(super) from: Option<Key>,
    pub(super) to: Key,
    pub(super) relative_pose: Pose,
    /// The angle before it was wrapped.
    pub(super) turn: f64,
    pub(super) entries: Entries,
    /// Whether the file itself says that it may be wrong.
    pub(super) is_doubtful: bool,
}

/// What the lines say.
#[derive(Default)]
pub(super) struct Records {
    pub(super) vertices: BTreeMap<Key, (usize, Pose)>,
    pub(super) edges: Vec<EdgeRecord>,
    pub(super) priors: Vec<EdgeRecord>,
    /// What counts if the file is iSAM's, and is another program's otherwise.
    pub(super) isam_sightings: Vec<Result<EdgeRecord, ReadProblem>>,
    pub(super) is_isam: bool,
    /// Which keys are landmarks, and since which line that is known.
    pub(super) points: BTreeMap<Key, usize>,
    pub(super) fixed: Vec<(usize, Key)>,
}

impl Records {
    /// The graph, with poses in the order of their labels and priors behind all other edges.
    pub(super) fn into_file(mut self, skipped: Vec<SkippedRecords>) -> Result<GraphFile, ReadError> {
        let skipped = self.take_isam_sightings(skipped)?;
        self.check_points()?;
        let mut placed: BTreeMap<Key, Option<Pose>> =
            self.vertices.iter().map(|(&key, &(_, pose))| (key, Some(pose))).collect();
        for edge in self.edges.iter().chain(&self.priors) {
            for key in edge.from.into_iter().chain([edge.to]) {
                placed.entry(key).or_default();
            }
        }
        let mut file = GraphFile::from(PoseGraph::new());
        file.skipped = skipped;
        let mut ids = BTreeMap::new();
        for (&key, pose) in &placed {
            let id = file.graph.add_pose(pose.unwrap_or_default());
            ids.insert(key, id);
            if pose.is_none() {
                file.unplaced.push(id);
            }
            if self.points.contains_key(&key) {
                file.landmarks.push(id);
            }
        }
        file.labels = placed.into_keys().map(|key| key.label).collect();
        if !self.priors.is_empty() {
            let world = file.graph.add_pose(Pose::IDENTITY);
            file.world = Some(world);
            anchor(&mut file.graph, world, 0)?;
        }
        self.add_edges(&mut file, &ids)?;
        for (line, key) in self.fixed {
            let unknown = ReadError { line, problem: ReadProblem::UnknownFixedPose(key.label) };
            anchor(&mut file.graph, *ids.get(&key).ok_or(unknown)?, line)?;
        }
        Ok(file)
    }

    /// In a file of iSAM's, `LANDMARK` is a sighting; elsewhere it is a record of a type that is not known.
    fn take_isam_sightings(
        &mut self,
        mut skipped: Vec<SkippedRecords>,
    ) -> Result<Vec<SkippedRecords>, ReadError> {
        let sightings = std::mem::take(&mut self.isam_sightings);
        if !self.is_isam {
            if let Some(Ok(EdgeRecord { line, .. })) = sightings.first() {
                let (record, count) = ("LANDMARK".to_owned(), sightings.len());
                skipped.push(SkippedRecords { line: *line, record, count });
            }
            return Ok(skipped);
        }
        for sighting in sightings {
            let sighting = sighting.map_err(|problem| ReadError { line: 0, problem })?;
            self.points.entry(sighting.to).or_insert(sighting.line);
            self.edges.push(sighting);
        }
        Ok(skipped)
    }

    /// Nothing is both a landmark and a pose.
    fn check_points(&self) -> Result<(), ReadError> {
        let both =
            |line: usize, key: Key| Err(ReadError { line, problem: ReadProblem::PoseAndLandmark(key.label) });
        for edge in &self.edges {
            let is_sighting = matches!(edge.entries, Entries::Point(_) | Entries::PointRoot(_));
            let ends = edge.from.into_iter().chain((!is_sighting).then_some(edge.to));
            if let Some(key) = ends.into_iter().find(|key| self.points.contains_key(key)) {
                return both(edge.line, key);
            }
        }
        Ok(())
    }

    fn add_edges(&self, file: &mut GraphFile, ids: &BTreeMap<Key, PoseId>) -> Result<(), ReadError> {
        // Each landmark's heading is tied by the first sighting that says anything.
        let mut untied = file.landmarks.clone();
        for edge in self.edges.iter().chain(&self.priors) {
            let (line, relative_pose) = (edge.line, edge.relative_pose);
            if edge.turn.abs() > LARGE_TURN && file.large_turn.is_none() {
                file.large_turn = Some((line, edge.turn));
            }
            let mut matrix = self.matrix(edge.entries);
            if matrix == Matrix3::zeros() {
                file.empty_edges += 1;
                continue;
            }
            let to = ids[&edge.to];
            if let Ok(tied) = untied.binary_search(&to) {
                untied.remove(tied);
                matrix[(2, 2)] = 1.0;
            }
            let refused = |problem| {
                let problem = match edge.from {
                    Some(from) => ReadProblem::Information { from: from.label, to: edge.to.label, problem },
                    None => ReadProblem::PriorInformation { pose: edge.to.label, problem },
                };
                ReadError { line, problem }
            };
            let information = self.information(edge, matrix).map_err(refused)?;
            let from = edge.from.map(|from| ids[&from]).or(file.world).unwrap_or_default();
            if edge.is_doubtful {
                file.doubtful.insert(file.graph.edges().len());
            }
            let added = file.graph.add_edge(Edge { from, to, relative_pose, information });
            added.map_err(|problem| ReadError { line, problem: problem.into() })?;
        }
        // What nobody saw stays where the file has it.
        for landmark in untied {
            anchor(&mut file.graph, landmark, 0)?;
        }
        Ok(())
    }

    fn matrix(&self, entries: Entries) -> Matrix3<f64> {
        match entries {
            Entries::Rows(entries) => by_rows(entries),
            Entries::Edge2(entries) if self.is_isam => squared(entries),
            Entries::Edge2(entries) => as_toro(entries),
            Entries::Point([xx, xy, yy]) => of_point(matrix![xx, xy; xy, yy]),
            Entries::PointRoot([xx, xy, yy]) => {
                let root: Matrix2<f64> = matrix![xx, xy; 0.0, yy];
                of_point(root.transpose() * root)
            }
        }
    }

    /// The information along the axes of the measured end pose; iSAM's is along those of the start pose.
    fn information(&self, edge: &EdgeRecord, matrix: Matrix3<f64>) -> Result<Information, UncertaintyError> {
        let information = Information::semidefinite(matrix)?;
        let is_isam = self.is_isam && matches!(edge.entries, Entries::Edge2(_));
        Ok(if is_isam { information.rotated(-edge.relative_pose.theta) } else { information })
    }
}

fn anchor(graph: &mut PoseGraph, pose: PoseId, line: usize) -> Result<(), ReadError> {
    graph.anchor(pose).map_err(|problem| ReadError { line, problem: problem.into() })
}
