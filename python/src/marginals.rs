//! How well the poses of a graph are known.

use hssh_metrics::{Marginals, Pose, PoseGraph, PoseId};
use pyo3::prelude::*;

use crate::arrays::{selection, shaped, square, stack};
use crate::errors::{argument, of_graph};
use crate::watch::detached;

/// The Gaussian around the poses of a graph. Covariances are of (x, y, θ) in the frame of the graph: m², m·rad, rad².
#[pyclass(name = "Marginals", module = "hssh", frozen)]
pub(crate) struct PyMarginals {
    marginals: Marginals,
    count: usize,
}

impl PyMarginals {
    /// Of a graph of which every part is anchored, and which has so many poses besides the world.
    pub(crate) fn of(py: Python<'_>, graph: PoseGraph, count: usize) -> PyResult<Self> {
        let marginals = detached(py, || Marginals::new(&graph))?;
        Ok(PyMarginals { marginals: marginals.map_err(|problem| of_graph(problem.into()))?, count })
    }

    fn existing(&self, pose: usize) -> PyResult<PoseId> {
        if pose < self.count {
            return Ok(PoseId(pose as u32));
        }
        Err(argument(format!(
            "pose {pose} does not exist: the graph has {} poses, counted from 0",
            self.count
        )))
    }
}

#[pymethods]
impl PyMarginals {
    /// The covariance of a pose, shape (3, 3); zero if it is anchored.
    fn covariance<'py>(&self, py: Python<'py>, pose: usize) -> PyResult<Bound<'py, PyAny>> {
        let pose = self.existing(pose)?;
        square(py, &detached(py, || self.marginals.covariance(pose))?)
    }

    /// The covariances of poses, shape (K, 3, 3).
    ///
    /// Parameters
    /// ----------
    /// poses : array_like of int, shape (K,), or of bool, shape (N,), optional
    ///     Which; all if nothing is said.
    #[pyo3(signature = (poses = None))]
    fn covariances<'py>(
        &self,
        py: Python<'py>,
        poses: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let chosen = poses.map(|poses| selection("poses", poses, self.count)).transpose()?;
        let all = detached(py, || self.marginals.covariances())?;
        match chosen {
            None => stack(py, &all),
            Some(chosen) => {
                let chosen: Vec<_> = chosen.into_iter().map(|pose| all[pose as usize]).collect();
                stack(py, &chosen)
            }
        }
    }

    /// The covariance of two poses, shape (6, 6), the first in the upper left block.
    fn joint<'py>(&self, py: Python<'py>, first: usize, second: usize) -> PyResult<Bound<'py, PyAny>> {
        let (first, second) = (self.existing(first)?, self.existing(second)?);
        square(py, &detached(py, || self.marginals.joint(first, second))?)
    }

    /// The pose of `end` in the frame of `start`, shape (3,), and its covariance, shape (3, 3), along the axes of `start`.
    fn relative<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        end: usize,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (start, end) = (self.existing(start)?, self.existing(end)?);
        let (Pose { x, y, theta }, covariance) = detached(py, || self.marginals.relative(start, end))?;
        Ok((shaped(py, vec![x, y, theta], [3])?, square(py, &covariance)?))
    }

    /// float: ln |A|, A being the inverse of the covariance of all poses together.
    #[getter]
    fn log_determinant(&self) -> f64 {
        self.marginals.log_determinant()
    }

    fn __repr__(&self) -> String {
        format!("<Marginals of {} poses>", self.count)
    }
}
