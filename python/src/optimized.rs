//! A pose graph with the poses that were found for it.

use std::sync::Arc;

use hssh::graph::Optimized;
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::poses;
use crate::errors::{Kind, error, of_graph};
use crate::marginals::PyMarginals;
use crate::pose_graph::PyPoseGraph;
use crate::watch::{calmly, finished};

/// The poses that contradict the measurements of a pose graph least, and how they were found.
#[pyclass(name = "PoseGraphSolution", module = "hssh", frozen)]
pub(crate) struct PySolution {
    optimized: Arc<Optimized>,
    name: String,
}

impl PySolution {
    pub(crate) fn of(optimized: Optimized, name: String) -> Self {
        PySolution { optimized: Arc::new(optimized), name }
    }

    fn account(&self) -> hssh::account::PoseGraphAccount {
        self.optimized.account(self.name.clone(), 0.0)
    }
}

#[pymethods]
impl PySolution {
    /// ndarray of float64, shape (N, 3): The poses x, y, θ: metres, metres, radians in (−π, π]; those that were held are where they were.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let count = self.optimized.file.labels.len();
        poses(py, self.optimized.optimum.poses[..count].iter().copied())
    }

    /// ndarray of uint64, shape (N,): The number that the file gives to each pose; else its index.
    #[getter]
    fn labels<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_slice(py, &self.optimized.file.labels).into_any()
    }

    /// float: χ² of the measurements that were not refused.
    #[getter]
    fn chi2(&self) -> f64 {
        self.optimized.optimum.chi2 + 0.0
    }

    /// float: χ² of all measurements where the descent began.
    #[getter]
    fn initial_chi2(&self) -> f64 {
        self.optimized.optimum.initial_chi2 + 0.0
    }

    /// float or None: What was minimized instead of χ², with a kernel.
    #[getter]
    fn robust_cost(&self) -> Option<f64> {
        self.optimized.optimum.robust_cost
    }

    /// ndarray of float64, shape (M,): By which factor each measurement counts; 0 if it was refused.
    #[getter]
    fn weights<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_slice(py, &self.optimized.optimum.weights).into_any()
    }

    /// ndarray of float64, shape (M,): χ² of each measurement.
    #[getter]
    fn edge_chi2<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let Optimized { file, optimum, .. } = &*self.optimized;
        let chi2 = |edge: &hssh_metrics::Edge| {
            edge.chi2(optimum.poses[edge.from.index()], optimum.poses[edge.to.index()])
        };
        PyArray1::from_vec(py, file.graph.edges().iter().map(chi2).collect()).into_any()
    }

    /// int: What χ² is expected to be if the covariances are honest.
    #[getter]
    fn degrees_of_freedom(&self) -> i64 {
        self.account().degrees_of_freedom
    }

    /// bool: Whether it ended as it should.
    #[getter]
    fn converged(&self) -> bool {
        self.optimized.optimum.finished
    }

    /// str: Why it ended, in words.
    #[getter]
    fn ending(&self) -> &'static str {
        self.optimized.optimum.ending
    }

    /// int: How many linear systems (with a kernel or "graduated": rounds; with relaxation: sweeps) it took.
    #[getter]
    fn iterations(&self) -> usize {
        self.optimized.optimum.steps
    }

    /// float: Seconds of solving.
    #[getter]
    fn seconds(&self) -> f64 {
        self.optimized.seconds
    }

    /// PoseGraph: The graph at these poses, without the measurements that were refused.
    #[getter]
    fn graph(&self) -> PyPoseGraph {
        PyPoseGraph::of((*self.optimized).clone().into_file(), self.name.clone())
    }

    /// The Gaussian around these poses, each measurement with the weight that it had.
    fn marginals(&self, py: Python<'_>) -> PyResult<PyMarginals> {
        let count = self.optimized.file.labels.len();
        PyMarginals::of(py, self.optimized.believed(), count)
    }

    /// Everything as JSON, as the program's ``hssh graph --json`` prints it.
    fn to_json(&self) -> PyResult<String> {
        calmly(|| {
            serde_json::to_string_pretty(&self.account())
                .map(|text| text + "\n")
                .map_err(|problem| error(Kind::Internal, problem))
        })
    }

    /// The picture as SVG: trajectory, closures, what was refused, and of some poses the covariance.
    fn to_svg(&self, py: Python<'_>) -> PyResult<String> {
        finished(py, |_| self.optimized.to_svg(&self.name))?.map_err(|problem| of_graph(problem.into()))
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        self.to_svg(py)
    }

    /// What was found, in words.
    fn __str__(&self) -> String {
        self.account().to_string()
    }

    fn __repr__(&self) -> String {
        let account = self.account();
        format!(
            "<PoseGraphSolution: {} poses, chi2 {:.6}, {}>",
            account.poses.len(),
            account.chi2,
            account.ending
        )
    }
}
