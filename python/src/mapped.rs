//! What a search found, behind the answer that Python shows.

use std::sync::Arc;

use hssh::answer::{Answer, Explanation, Listing, MapPicture};
use hssh::export::export_map;
use hssh::pipeline::{Input, Mapped, MappingOptions, PipelineError, SurveyedLog, map};
use hssh_draw::{Bearings, SearchTree, TreeOptions, draw_tree, tree_to_dot};
use hssh_metrics::GraphFile;
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::poses;
use crate::errors::{Kind, argument, error, format_error, interrupted, of_pipeline};
use crate::exploration::PyExploration;
use crate::grid::PyGrid;
use crate::places::{export_kind, spacing_of};
use crate::pose_graph::PyPoseGraph;
use crate::survey::PySurvey;
use crate::watch::{Stop, calmly, finished, watched};

/// An answer, with what it was made of if it was not read from a text.
#[pyclass(name = "Mapped", module = "hssh._hssh", frozen)]
pub(crate) struct PyMapped {
    told: Told,
}

enum Told {
    Answer(Box<Answer>),
    Mapped { input: Box<Input>, mapped: Box<Mapped>, options: Box<MappingOptions> },
}

/// Options as JSON text.
pub(crate) fn options(json: &str) -> PyResult<MappingOptions> {
    let read: Result<MappingOptions, _> = serde_json::from_str(json);
    let options = read.map_err(|problem| {
        let words = problem.to_string();
        argument(words.split(" at line ").next().unwrap_or_default())
    })?;
    options.check().map_err(of_pipeline)?;
    Ok(options)
}

/// Finds the maps that explain an exploration, or a log that was surveyed.
#[pyfunction]
#[pyo3(signature = (source, options_json))]
pub(crate) fn map_source(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    options_json: &str,
) -> PyResult<PyMapped> {
    let options = options(options_json)?;
    let input = if let Ok(exploration) = source.cast::<PyExploration>() {
        let PyExploration { exploration, name } = exploration.get();
        Input::exploration(name.clone(), (**exploration).clone())
    } else {
        let PySurvey { surveyed, name, .. } = source.cast::<PySurvey>()?.get();
        let surveyed: SurveyedLog = (**surveyed).clone();
        Input::surveyed(name.clone(), surveyed).map_err(|problem| error(Kind::Survey, problem))?
    };
    let stop = Arc::new(Stop::default());
    let done = watched(py, &stop, |stop| map(&input, &options, &stop.monitor))?;
    let mapped = done.value.map_err(of_pipeline)?;
    let told = Told::Mapped { input: Box::new(input), mapped: Box::new(mapped), options: Box::new(options) };
    match done.stopped {
        None => Ok(PyMapped { told }),
        Some(_) => Err(interrupted(py, Some(Py::new(py, PyMapped { told })?.into_any()))),
    }
}

impl PyMapped {
    pub(crate) fn of_answer(answer: Answer) -> Self {
        PyMapped { told: Told::Answer(Box::new(answer)) }
    }

    fn answer(&self) -> &Answer {
        match &self.told {
            Told::Answer(answer) => answer,
            Told::Mapped { mapped, .. } => &mapped.answer,
        }
    }

    /// What only an answer has that a search has just given.
    fn whole(&self) -> PyResult<(&Input, &Mapped, &MappingOptions)> {
        match &self.told {
            Told::Mapped { input, mapped, options } => Ok((input, mapped, options)),
            Told::Answer(_) => Err(argument(
                "only what hssh.map gives has this: an answer that was read from a text or found on-line does not",
            )),
        }
    }

    /// Refuses a rank that is not there.
    fn existing(&self, rank: usize) -> PyResult<()> {
        match self.answer().map(rank) {
            Some(_) => Ok(()),
            None => {
                let found = self.answer().maps.len();
                Err(argument(PipelineError::NoSuchRank { asked: rank, found }))
            }
        }
    }

    fn tree(&self) -> PyResult<(SearchTree, TreeOptions)> {
        let (input, mapped, _) = self.whole()?;
        let named = mapped.exploration(input).star_types().iter();
        let bearings = Bearings(named.map(|named| named.bearings.clone()).collect());
        let drawn = TreeOptions { bearings, ..TreeOptions::default() };
        let tree = mapped.tree(drawn.most_maps);
        Ok((tree.ok_or_else(|| argument("counting keeps no tree to draw: search in another way"))?, drawn))
    }
}

#[pymethods]
impl PyMapped {
    /// An answer as `to_json` writes it.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let read = calmly(|| Ok(Answer::from_json(text)))?;
        Ok(PyMapped::of_answer(read.map_err(|problem| format_error(problem, None, None))?))
    }

    fn to_json(&self) -> PyResult<String> {
        calmly(|| Ok(self.answer().to_json()))
    }

    /// The answer without its maps.
    fn head_json(&self) -> PyResult<String> {
        let Answer {
            format,
            version,
            input,
            search,
            verdict,
            certificate,
            maps: _,
            visits,
            readings,
            building,
            warnings,
        } = self.answer();
        let head = Answer {
            format: format.clone(),
            version: *version,
            input: input.clone(),
            search: search.clone(),
            verdict: verdict.clone(),
            certificate: certificate.clone(),
            maps: Vec::new(),
            visits: visits.clone(),
            readings: readings.clone(),
            building: building.clone(),
            warnings: warnings.clone(),
        };
        calmly(|| Ok(head.to_json()))
    }

    fn map_count(&self) -> usize {
        self.answer().maps.len()
    }

    /// The map with an index.
    fn map_json(&self, index: usize) -> PyResult<String> {
        self.existing(index + 1)?;
        serde_json::to_string(&self.answer().maps[index]).map_err(|problem| error(Kind::Internal, problem))
    }

    fn to_text(&self, levels: bool) -> PyResult<String> {
        calmly(|| Ok(self.answer().to_text(Listing { levels, flags: false })))
    }

    fn doubt(&self) -> Option<String> {
        self.answer().doubt()
    }

    /// The picture of a map, and whether as DOT.
    fn picture(&self, py: Python<'_>, rank: usize, title: Option<String>, dot: bool) -> PyResult<String> {
        self.existing(rank)?;
        let map = &self.answer().maps[rank - 1];
        let drawn = finished(py, |_| {
            let picture = MapPicture::new(map, title)?;
            Ok(if dot { picture.to_dot() } else { picture.to_svg() })
        })?;
        drawn.map_err(|problem: hssh::answer::PictureError| error(Kind::Search, problem))
    }

    /// A map for another program, and what whoever uses it should know.
    fn export(&self, kind: &str, rank: Option<usize>, spacing: f64) -> PyResult<(String, Vec<String>)> {
        let (kind, spacing) = (export_kind(kind)?, spacing_of(spacing)?);
        calmly(|| {
            let exported = export_map(self.answer(), rank, kind, spacing).map_err(argument)?;
            Ok((exported.text, exported.warnings))
        })
    }

    /// The picture of the search tree, and whether as DOT.
    fn tree_picture(&self, py: Python<'_>, dot: bool) -> PyResult<String> {
        let (tree, drawn) = self.tree()?;
        let picture =
            finished(py, |_| if dot { tree_to_dot(&tree, &drawn) } else { draw_tree(&tree, &drawn) })?;
        picture.map_err(|problem| {
            error(Kind::Search, format!("cannot draw the search tree: {problem}\nhelp: the option travels draws that of the first travels"))
        })
    }

    fn pose_graph(&self, rank: usize) -> PyResult<Option<PyPoseGraph>> {
        self.existing(rank)?;
        let (_, mapped, _) = self.whole()?;
        let name = format!("map {rank} of {}", self.answer().input.name);
        Ok(mapped.pose_graph(rank).map(|graph| PyPoseGraph::of(GraphFile::from(graph.clone()), name)))
    }

    fn scan_graph(&self, py: Python<'_>, rank: usize) -> PyResult<Option<PyPoseGraph>> {
        self.existing(rank)?;
        let (input, mapped, _) = self.whole()?;
        let name = format!("the scans of {}", self.answer().input.name);
        let graph = finished(py, |_| mapped.scan_graph(input, rank))?;
        Ok(graph.map(|graph| PyPoseGraph::of(GraphFile::from(graph), name)))
    }

    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        rank: usize,
    ) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        self.existing(rank)?;
        let (input, mapped, _) = self.whole()?;
        let Some(timed) = finished(py, |_| mapped.trajectory(input, rank))? else { return Ok(None) };
        let times = PyArray1::from_vec(py, timed.iter().map(|(time, _)| *time).collect()).into_any();
        Ok(Some((times, poses(py, timed.iter().map(|(_, pose)| *pose))?)))
    }

    fn building(&self, py: Python<'_>, rank: usize) -> PyResult<PyGrid> {
        self.existing(rank)?;
        let (input, mapped, _) = self.whole()?;
        let grid = finished(py, |_| mapped.building(input, rank))?.map_err(of_pipeline)?;
        Ok(PyGrid::of(grid, format!("the building of {}", self.answer().input.name)))
    }

    fn certificate(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let (input, mapped, _) = self.whole()?;
        finished(py, |_| mapped.certificate(input))
    }

    fn explanation_json(&self, py: Python<'_>, rank: usize) -> PyResult<String> {
        self.existing(rank)?;
        let (input, mapped, options) = self.whole()?;
        let told = finished(py, |_| {
            Explanation::new(&mapped.answer, rank, mapped.exploration(input), &options.axioms)
        })?;
        let told = told.map_err(|problem| of_pipeline(problem.into()))?;
        serde_json::to_string(&told).map_err(|problem| error(Kind::Internal, problem))
    }

    fn exploration(&self) -> PyResult<PyExploration> {
        let (input, mapped, _) = self.whole()?;
        Ok(PyExploration::of(mapped.exploration(input).clone(), self.answer().input.name.clone()))
    }
}
