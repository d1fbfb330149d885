//! Pose graphs: poses, the relative poses measured between them, and where the poses are by least squares.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use clap::ValueEnum;
use hssh::file::{Source, read_graph};
use hssh::graph::{
    GraphOptions, KernelChoice, MethodChoice, Optimized, StartChoice, WrongClosures, optimize,
};
use hssh_draw::{EdgeKind, PoseGraphOptions, draw_pose_graph};
use hssh_metrics::{
    Edge, GraphFile, Information, Pose, PoseGraph, PoseId, chordal_poses, closures, floating_poses,
    odometry_poses, read_pose_graph,
};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{indices, matrices, pose, poses, selection, shaped, stack, table};
use crate::errors::{argument, format_error, interrupted, of_file, of_graph};
use crate::marginals::PyMarginals;
use crate::optimized::PySolution;
use crate::watch::{attended, calmly, detached, finished, is_interrupted};

/// Poses in the plane with the relative poses measured between them.
///
/// Lengths are in metres and angles in radians, counterclockwise. The measurement of an edge is the pose of its end in the frame of its start.
/// Its error is e = ⊖measurement ⊕ (⊖start ⊕ end), and its χ² is eᵀ Ω e without a factor ½, Ω being the information; x and y of e
/// and Ω lie along the axes of the *measured end pose*, as in g2o.
///
/// A graph does not change; what changes one makes another.
///
/// Parameters
/// ----------
/// poses : array_like of float, shape (N, 3), or None
///     The estimate of each pose: x, y, θ in one frame. None if nothing is known but the measurements: there are as many poses
///     as the edges mention.
/// edges : array_like of int, shape (M, 2)
///     The poses that each measurement leads from and to, counted from 0.
/// measurements : array_like of float, shape (M, 3)
///     The measured relative poses: x, y, θ of the end in the frame of the start.
/// information : array_like of float, shape (M, 3, 3) or (3, 3)
///     The information matrix of each measurement, the inverse of its covariance, or one for all: 1/m², 1/(m·rad), 1/rad².
///     It may be zero in some directions, which then are not measured.
/// anchored : array_like of int, shape (K,), or of bool, shape (N,), optional
///     The poses that are held where they are. Parts of the graph that none holds are held by their first pose when they are optimized.
///
/// Raises
/// ------
/// ArgumentError
///     If shapes do not fit, numbers are not finite, indices do not exist, an edge leads from a pose to itself, or a matrix is no
///     information.
///
/// Examples
/// --------
/// >>> import hssh, numpy as np
/// >>> graph = hssh.PoseGraph(None, [(0, 1), (0, 1)], [(1, 0, 0), (3, 0, 0)], np.eye(3))
/// >>> found = graph.optimize()
/// >>> found.poses[1]
/// array([2., 0., 0.])
/// >>> found.chi2
/// 2.0
#[pyclass(name = "PoseGraph", module = "hssh", frozen)]
pub(crate) struct PyPoseGraph {
    pub(crate) file: Arc<GraphFile>,
    pub(crate) name: String,
}

/// What a graph is called that no file names.
const UNNAMED: &str = "pose graph";

impl PyPoseGraph {
    pub(crate) fn of(file: GraphFile, name: String) -> Self {
        PyPoseGraph { file: Arc::new(file), name }
    }

    /// Opens a file that holds one.
    pub(crate) fn open(path: PathBuf, source: Source) -> PyResult<Self> {
        let file = read_graph(&path, source).map_err(of_file)?;
        Ok(PyPoseGraph::of(file, path.display().to_string()))
    }

    fn graph(&self) -> &PoseGraph {
        &self.file.graph
    }

    /// How many poses there are, the frame of the world not being one.
    fn count(&self) -> usize {
        self.file.labels.len()
    }

    /// Poses given for those of the graph.
    fn given(&self, value: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
        let rows = table::<3>("poses", value)?;
        if rows.len() != self.count() {
            return Err(argument(format!("{} poses were given for a graph of {}", rows.len(), self.count())));
        }
        let world = self.graph().poses()[self.count()..].iter().copied();
        Ok(rows.into_iter().map(pose).chain(world).collect())
    }

    /// The poses given, or those that the graph has.
    fn poses_or_own(&self, value: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Pose>> {
        value.map_or_else(|| Ok(self.graph().poses().to_vec()), |value| self.given(value))
    }

    /// The graph with all its parts anchored.
    fn anchored_graph(&self) -> PoseGraph {
        let mut graph = self.graph().clone();
        graph.anchor_components();
        graph
    }
}

#[pymethods]
impl PyPoseGraph {
    #[new]
    #[pyo3(signature = (poses, edges, measurements, information, *, anchored = None))]
    fn new(
        poses: Option<&Bound<'_, PyAny>>,
        edges: &Bound<'_, PyAny>,
        measurements: &Bound<'_, PyAny>,
        information: &Bound<'_, PyAny>,
        anchored: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let estimates = poses.map(|poses| table::<3>("poses", poses)).transpose()?;
        let ends = indices::<2>("edges", edges, estimates.as_ref().map(Vec::len))?;
        let measured = table::<3>("measurements", measurements)?;
        if measured.len() != ends.len() {
            return Err(argument(format!(
                "there are {} edges and {} measurements: each edge has one",
                ends.len(),
                measured.len()
            )));
        }
        let informations = matrices("information", information, ends.len())?;
        let mentioned = ends.iter().flatten().map(|&end| end as usize + 1).max().unwrap_or(0);
        let count = estimates.as_ref().map_or(mentioned, Vec::len);
        let most = 1 << 26;
        if count > most {
            return Err(argument(format!(
                "the edges mention {count} poses, and {most} are the most that are taken"
            )));
        }
        let anchors = anchored.map_or(Ok(Vec::new()), |anchored| selection("anchored", anchored, count))?;
        calmly(|| {
            let mut graph = PoseGraph::new();
            for index in 0..count {
                graph.add_pose(estimates.as_ref().map_or(Pose::IDENTITY, |estimates| pose(estimates[index])));
            }
            for (index, ((&[from, to], &tau), matrix)) in
                ends.iter().zip(&measured).zip(informations).enumerate()
            {
                let information = Information::semidefinite(matrix)
                    .map_err(|problem| argument(format!("information[{index}] is none: {problem}")))?;
                let (from, to, relative_pose) = (PoseId(from), PoseId(to), pose(tau));
                let added = graph.add_edge(Edge { from, to, relative_pose, information });
                added.map_err(|problem| argument(format!("edges[{index}]: {problem}")))?;
            }
            for anchor in anchors {
                graph.anchor(PoseId(anchor)).map_err(argument)?;
            }
            let unplaced: Vec<PoseId> =
                if estimates.is_none() { graph.pose_ids().collect() } else { Vec::new() };
            let file = GraphFile { unplaced, ..GraphFile::from(graph) };
            Ok(PyPoseGraph::of(file, UNNAMED.to_owned()))
        })
    }

    /// The pose graph in a text as g2o, TORO, iSAM and Vertigo write it.
    #[staticmethod]
    fn from_text(text: &str) -> PyResult<Self> {
        let read = calmly(|| Ok(read_pose_graph(text.as_bytes())))?;
        let file = read.map_err(|error| format_error(&error, Some(error.line), None))?;
        Ok(PyPoseGraph::of(file, UNNAMED.to_owned()))
    }

    /// ndarray of float64, shape (N, 3): The estimates x, y, θ: metres, metres, radians. Landmarks have a heading that means nothing.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.graph().poses()[..self.count()].iter().copied())
    }

    /// ndarray of int64, shape (M, 2): The poses that each measurement leads from and to; a prior, which is measured in the
    /// frame of the world, leads from -1.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let from = |edge: &Edge| if self.file.is_prior(edge) { -1 } else { i64::from(edge.from.0) };
        let flat = self.graph().edges().iter().flat_map(|edge| [from(edge), i64::from(edge.to.0)]).collect();
        shaped(py, flat, [self.graph().edges().len(), 2])
    }

    /// ndarray of float64, shape (M, 3): The measured relative poses, x, y, θ.
    #[getter]
    fn measurements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.graph().edges().iter().map(|edge| edge.relative_pose))
    }

    /// ndarray of float64, shape (M, 3, 3): The information of each measurement, along the axes of its measured end.
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let all: Vec<_> = self.graph().edges().iter().map(|edge| *edge.information.matrix()).collect();
        stack(py, &all)
    }

    /// ndarray of bool, shape (N,): Which poses are held where they are.
    #[getter]
    fn anchored<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let held = self.graph().pose_ids().take(self.count()).map(|pose| self.graph().is_anchored(pose));
        PyArray1::from_vec(py, held.collect()).into_any()
    }

    /// ndarray of uint64, shape (N,): The number that the file gives to each pose; else its index.
    #[getter]
    fn labels<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_slice(py, &self.file.labels).into_any()
    }

    /// ndarray of int64: The poses that are landmarks: points, of which the heading means nothing.
    #[getter]
    fn landmarks<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let landmarks = self.file.landmarks.iter().map(|pose| i64::from(pose.0));
        PyArray1::from_vec(py, landmarks.collect()).into_any()
    }

    /// list of str: Records of the file that were not read, and how often they occur.
    #[getter]
    fn skipped(&self) -> Vec<String> {
        let told = self.file.skipped.iter();
        told.map(|skipped| format!("line {}: {} × {}", skipped.line, skipped.count, skipped.record)).collect()
    }

    /// str: What the graph is called: its file, if it has one.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// χ² of the measurements: Σ eᵀ Ω e.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like of float, shape (N, 3), optional
    ///     Other poses than those of the graph.
    #[pyo3(signature = (poses = None))]
    fn chi2(&self, poses: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        Ok(self.graph().chi2_at(&self.poses_or_own(poses)?) + 0.0)
    }

    /// χ² of each measurement, shape (M,).
    #[pyo3(signature = (poses = None))]
    fn edge_chi2<'py>(
        &self,
        py: Python<'py>,
        poses: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let poses = self.poses_or_own(poses)?;
        let chi2 = |edge: &Edge| edge.chi2(poses[edge.from.index()], poses[edge.to.index()]);
        Ok(PyArray1::from_vec(py, self.graph().edges().iter().map(chi2).collect()).into_any())
    }

    /// The error e of each measurement, shape (M, 3): metres, metres, radians in (−π, π].
    #[pyo3(signature = (poses = None))]
    fn errors<'py>(&self, py: Python<'py>, poses: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let poses = self.poses_or_own(poses)?;
        let error = |edge: &Edge| edge.error(poses[edge.from.index()], poses[edge.to.index()]);
        let flat = self.graph().edges().iter().flat_map(|edge| <[f64; 3]>::from(error(edge))).collect();
        shaped(py, flat, [self.graph().edges().len(), 3])
    }

    /// Whether each measurement closes a loop, shape (M,): all do but those of the tree along which dead reckoning goes.
    fn closures<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_vec(py, closures(self.graph())).into_any()
    }

    /// The connected components: a list of lists of poses.
    fn components(&self) -> Vec<Vec<u32>> {
        let own = |component: Vec<PoseId>| -> Vec<u32> {
            component.iter().map(|pose| pose.0).filter(|&pose| (pose as usize) < self.count()).collect()
        };
        let components = self.graph().components().into_iter().map(own);
        components.filter(|component| !component.is_empty()).collect()
    }

    /// Poses that could move without any measurement noticing once the parts that float as a whole are held.
    fn floating(&self, py: Python<'_>) -> PyResult<Vec<u32>> {
        let mut graph = self.anchored_graph();
        detached(py, || {
            let placed = odometry_poses(&graph)?;
            graph.set_poses(placed).expect("there is one pose for each");
            Ok(floating_poses(&graph).iter().map(|pose| pose.0).collect())
        })?
        .map_err(|problem: hssh_metrics::SolveError| of_graph(problem.into()))
    }

    /// The same graph with other poses.
    fn with_poses(&self, poses: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = self.given(poses)?;
        let mut file = (*self.file).clone();
        file.graph.set_poses(given).map_err(argument)?;
        file.unplaced.clear();
        Ok(PyPoseGraph::of(file, self.name.clone()))
    }

    /// Poses to start from, made of the measurements alone.
    ///
    /// Parameters
    /// ----------
    /// how : {"chordal", "odometry"}
    ///     Chordal relaxation, or dead reckoning along a spanning tree.
    ///
    /// Returns
    /// -------
    /// ndarray of float64, shape (N, 3)
    #[pyo3(signature = (how = "chordal"))]
    fn initial_poses<'py>(&self, py: Python<'py>, how: &str) -> PyResult<Bound<'py, PyAny>> {
        let make: fn(&PoseGraph) -> _ = match how {
            "chordal" => chordal_poses,
            "odometry" => odometry_poses,
            _ => return Err(argument(format!("how is \"{how}\": write \"chordal\" or \"odometry\""))),
        };
        let graph = self.anchored_graph();
        let found = detached(py, || make(&graph))?.map_err(|problem| of_graph(problem.into()))?;
        poses(py, found[..self.count()].iter().copied())
    }

    /// Finds the poses that contradict the measurements least.
    ///
    /// Parts of the graph that nothing holds are held by their first pose. It does the same as the program's ``hssh graph``.
    ///
    /// Parameters
    /// ----------
    /// method : {"safeguarded", "gauss_newton", "levenberg_marquardt", "linearize_once", "relaxation"}
    ///     How to minimize χ².
    /// start : {"best", "chordal", "poses", "odometry"}
    ///     Where to begin: "best" begins at chordal poses and takes those of the graph into account if they fit better.
    /// robust : {None, "huber", "cauchy", "dcs", "graduated"}
    ///     What becomes of closures that do not fit: with a kernel they count the less the worse they fit, by graduated
    ///     non-convexity (also "gnc") each is believed or refused.
    /// deviations : float
    ///     With a kernel: from how many standard deviations on.
    /// threshold : float
    ///     With "graduated": the χ² from which on a closure is refused; 11.34 refuses one correct closure in a hundred.
    /// max_iterations : int, optional
    ///     How many linear systems to solve at most.
    /// tolerance : float
    ///     Converged when χ² can fall by no more than this part of it.
    ///
    /// Returns
    /// -------
    /// PoseGraphSolution
    ///
    /// Raises
    /// ------
    /// SolveError
    ///     If there is no solution: something could move freely, or numbers are out of all proportion.
    /// Interrupted
    ///     On Ctrl-C, with the poses reached as its ``partial``.
    #[pyo3(signature = (*, method = "safeguarded", start = "best", robust = None, deviations = 3.0, threshold = 11.34,
        max_iterations = None, tolerance = 1e-9))]
    #[allow(clippy::too_many_arguments)] // keywords, each with its default
    fn optimize(
        &self,
        py: Python<'_>,
        method: &str,
        start: &str,
        robust: Option<&str>,
        deviations: f64,
        threshold: f64,
        max_iterations: Option<usize>,
        tolerance: f64,
    ) -> PyResult<PySolution> {
        for (name, number) in [("deviations", deviations), ("threshold", threshold), ("tolerance", tolerance)]
        {
            if !(number > 0.0 && number.is_finite()) {
                return Err(argument(format!("{name} is {number}: write a positive number, like 0.5")));
            }
        }
        let wrong = match robust {
            None => WrongClosures::None,
            Some("graduated" | "gnc") => WrongClosures::Refused { threshold },
            Some(kernel) => WrongClosures::Weighed {
                kernel: choice::<KernelChoice>("robust", kernel, &["graduated"])?,
                deviations,
            },
        };
        let start = if start == "poses" { "file" } else { start };
        let options = GraphOptions {
            method: choice::<MethodChoice>("method", method, &[])?,
            start: choice::<StartChoice>("start", start, &["poses"])?,
            max_iterations,
            tolerance,
            wrong,
            interrupted: is_interrupted,
        };
        let file = (*self.file).clone();
        let done = attended(py, || optimize(file, &options))?;
        let optimized: Optimized = done.value.map_err(of_graph)?;
        let solution = PySolution::of(optimized, self.name.clone());
        match done.stopped {
            None => Ok(solution),
            Some(_) => Err(interrupted(py, Some(Py::new(py, solution)?.into_any()))),
        }
    }

    /// The Gaussian around the poses that the graph holds: their covariances, if they are at a minimum of χ².
    fn marginals(&self, py: Python<'_>) -> PyResult<PyMarginals> {
        PyMarginals::of(py, self.anchored_graph(), self.count())
    }

    /// The graph as g2o text.
    fn to_g2o(&self) -> String {
        self.file.to_g2o()
    }

    /// The graph as TORO text, which has no word for an anchor, for a prior and for a landmark.
    fn to_toro(&self) -> String {
        self.file.to_toro()
    }

    /// The graph as SVG: trajectory and closures.
    fn to_svg(&self, py: Python<'_>) -> PyResult<String> {
        finished(py, |_| {
            let mut drawn = PoseGraph::new();
            for &pose in &self.graph().poses()[..self.count()] {
                drawn.add_pose(pose);
            }
            let mut kinds = Vec::new();
            for (&edge, closes) in self.graph().edges().iter().zip(closures(self.graph())) {
                if !self.file.is_prior(&edge) && drawn.add_edge(edge).is_ok() {
                    kinds.push(if closes { EdgeKind::Closure } else { EdgeKind::Odometry });
                }
            }
            let title = Some(format!("{}: {} poses, {} edges", self.name, self.count(), kinds.len()));
            draw_pose_graph(&drawn, &PoseGraphOptions { title, kinds, covariances: Vec::new() })
        })
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        // Where nothing is known of poses there is nothing to draw.
        let unplaced: BTreeSet<PoseId> = self.file.unplaced.iter().copied().collect();
        if self.count() == 0 || !unplaced.is_empty() { Ok(None) } else { self.to_svg(py).map(Some) }
    }

    /// How many poses there are.
    fn __len__(&self) -> usize {
        self.count()
    }

    fn __repr__(&self) -> String {
        format!("<PoseGraph: {} poses, {} edges>", self.count(), self.graph().edges().len())
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, (String,))> {
        let file = &slf.get().file;
        // What nobody placed has no vertex.
        let unplaced = |line: &&str| {
            let label =
                line.strip_prefix("VERTEX_SE2 ").and_then(|rest| rest.split(' ').next()?.parse().ok());
            label.is_some_and(|label| file.unplaced.iter().any(|&pose| file.label(pose) == Some(label)))
        };
        let mut text = file.to_g2o();
        if !file.unplaced.is_empty() {
            text = text.lines().filter(|line| !unplaced(line)).map(|line| line.to_owned() + "\n").collect();
        }
        Ok((slf.get_type().getattr("from_text")?.unbind(), (text,)))
    }
}

/// One of the choices of an option, spelled with underscores.
fn choice<T: ValueEnum>(name: &str, value: &str, more: &[&str]) -> PyResult<T> {
    T::from_str(&value.replace('_', "-"), false).map_err(|_| {
        let known = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let mut known: Vec<String> = known.map(|known| known.get_name().replace('-', "_")).collect();
        known.retain(|known| known != "file");
        known.extend(more.iter().map(|more| (*more).to_owned()));
        argument(format!("{name} is \"{value}\": write one of {}", known.join(", ")))
    })
}
