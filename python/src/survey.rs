//! What was found along a log: the places that the robot visited.

use std::sync::Arc;

use hssh::account::SurveyAccount;
use hssh::answer::AnswerWarning;
use hssh::pipeline::SurveyedLog;
use hssh_metrics::GraphFile;
use pyo3::prelude::*;

use crate::arrays::poses;
use crate::errors::{Kind, error};
use crate::exploration::PyExploration;
use crate::pose_graph::PyPoseGraph;

/// The places that a robot visited along a log, found by its scans. Poses are in the frame of the first scan.
#[pyclass(name = "Survey", module = "hssh", frozen)]
pub(crate) struct PySurvey {
    pub(crate) surveyed: Arc<SurveyedLog>,
    pub(crate) name: String,
}

#[pymethods]
impl PySurvey {
    /// Exploration: What the robot saw and did, with the odometry of each travel.
    #[getter]
    fn exploration(&self) -> PyResult<PyExploration> {
        let exploration =
            self.surveyed.survey.exploration().map_err(|problem| error(Kind::Survey, problem))?;
        Ok(PyExploration::of(exploration, self.name.clone()))
    }

    /// ndarray of float64, shape (N, 3): Where each scan that can be used was taken, with the loops closed.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.surveyed.survey.track.scans.iter().map(|scan| scan.pose))
    }

    /// ndarray of float64, shape (V, 3): The frame of each visit, which is turned as the first scan's.
    #[getter]
    fn frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.surveyed.survey.visits.iter().map(|visit| visit.frame))
    }

    /// PoseGraph: The tracked steps of all scans and what closes their loops.
    #[getter]
    fn graph(&self) -> PyPoseGraph {
        let graph = self.surveyed.survey.graph.clone();
        PyPoseGraph::of(GraphFile::from(graph), format!("the scans of {}", self.name))
    }

    /// list of str: What was left out, or decided with little reason.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.surveyed.warnings().iter().map(AnswerWarning::to_string).collect()
    }

    /// Everything as JSON, as the program's ``hssh explore --json`` prints it.
    fn to_json(&self) -> PyResult<String> {
        let account = SurveyAccount::new(&self.name, &self.surveyed);
        let text =
            serde_json::to_string_pretty(&account).map_err(|problem| error(Kind::Internal, problem))?;
        Ok(text + "\n")
    }

    /// What was found, in words.
    fn __str__(&self) -> String {
        SurveyAccount::new(&self.name, &self.surveyed).to_string()
    }

    /// How many visits there are.
    fn __len__(&self) -> usize {
        self.surveyed.survey.visits.len()
    }

    fn __repr__(&self) -> String {
        format!("<Survey: {} visits along {} scans>", self.__len__(), self.surveyed.log.scans.len())
    }
}
