//! Files as input: what they hold decides what is made of them.

use std::path::{Path, PathBuf};

use hssh::file::{Source, TopicChoice};
use hssh::kind::FileKind;
use pyo3::prelude::*;

use crate::errors::{argument, of_file};
use crate::exploration::PyExploration;
use crate::grid::PyGrid;
use crate::log::{PyLog, laser_choice};
use crate::pose_graph::PyPoseGraph;

fn open(path: &Path) -> PyResult<Source> {
    if path.as_os_str() == "-" {
        return Err(argument("`-` is standard input to the program, and no file: give the path of one"));
    }
    Source::open(path).map_err(of_file)
}

/// Reads an exploration: a RON file (docs/exploration-format.md), plain or gzip.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file.
///
/// Returns
/// -------
/// Exploration
#[pyfunction]
pub(crate) fn read_exploration(path: PathBuf) -> PyResult<PyExploration> {
    let source = open(&path)?;
    PyExploration::open(path, source)
}

/// Reads a pose graph: g2o, GTSAM's and Vertigo's files of that form, TORO or iSAM, plain or gzip.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file.
///
/// Returns
/// -------
/// PoseGraph
#[pyfunction]
pub(crate) fn read_pose_graph(path: PathBuf) -> PyResult<PyPoseGraph> {
    let source = open(&path)?;
    PyPoseGraph::open(path, source)
}

/// Reads a laser log: CARMEN text, a ROS bag (.bag, .mcap, .db3, folder) or a table of scans, plain or gzip.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file, or the folder of a ROS 2 bag.
/// scan, odometry, base_frame : str, optional
///     Of bags: the topic with the scans; the topic with the odometry, the frame of /tf in which the robot moves, or "none" for scan
///     matching alone; the frame of the robot that odometry moves. What is not said is found.
/// laser_view : float, optional
///     How wide the laser looks, where the log does not say it: radians.
/// laser_pose : (float, float, float), optional
///     Where the laser sits: metres ahead of the robot's axis, metres to its left, and radians that it is turned to the left.
///
/// Returns
/// -------
/// Log
#[pyfunction]
#[pyo3(signature = (path, *, scan = None, odometry = None, base_frame = None, laser_view = None, laser_pose = None))]
pub(crate) fn read_log(
    py: Python<'_>,
    path: PathBuf,
    scan: Option<String>,
    odometry: Option<String>,
    base_frame: Option<String>,
    laser_view: Option<f64>,
    laser_pose: Option<[f64; 3]>,
) -> PyResult<PyLog> {
    let laser = laser_choice(laser_view, laser_pose)?;
    let topics = TopicChoice { scan, odometry, base_frame };
    let opened = path.clone();
    let source = move || {
        let source = open(&opened)?;
        let is_log = matches!(
            source.kind(),
            FileKind::LaserLog(_)
                | FileKind::Recording(_)
                | FileKind::Table
                | FileKind::JsonLines
                | FileKind::Text
                | FileKind::Empty
        );
        if is_log { Ok(source) } else { Err(of_file(source.unfit("a laser log"))) }
    };
    PyLog::open(py, path, source, &laser, &topics)
}

/// Reads a grid map: the YAML file of ROS's map_server, or an image.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The YAML file, or an image (PGM, PNG, BMP, JPEG, TIFF, WebP).
/// resolution : float, optional
///     Of an image: metres per pixel.
///
/// Returns
/// -------
/// Grid
#[pyfunction]
#[pyo3(signature = (path, resolution = None))]
pub(crate) fn read_grid(py: Python<'_>, path: PathBuf, resolution: Option<f64>) -> PyResult<PyGrid> {
    let source = open(&path)?;
    let is_yaml = path.extension().is_some_and(|ending| ending == "yaml" || ending == "yml");
    match source.kind() {
        FileKind::MapDescription if resolution.is_some() => Err(argument(format!(
            "{} says itself how large its pixels are: leave out resolution, or give the image instead",
            path.display()
        ))),
        FileKind::Image(_) if resolution.is_none() => Err(argument(format!(
            "{} has no YAML file to say how large its pixels are: add resolution with the metres per pixel, such as 0.05",
            path.display()
        ))),
        FileKind::MapDescription | FileKind::Image(_) => PyGrid::open(py, path, resolution),
        FileKind::Text | FileKind::Empty if is_yaml => PyGrid::open(py, path, resolution),
        _ => Err(of_file(source.unfit("a grid map (YAML or image)"))),
    }
}

/// Reads whatever a file holds: an exploration, a laser log, a pose graph or a grid map. Its content decides, not its name.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file.
///
/// Returns
/// -------
/// Exploration, Log, PoseGraph or Grid
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Py<PyAny>> {
    let kind = open(&path)?.kind().clone();
    Ok(match kind {
        FileKind::LaserLog(_) | FileKind::Recording(_) | FileKind::Table | FileKind::JsonLines => {
            Py::new(py, read_log(py, path, None, None, None, None, None)?)?.into_any()
        }
        FileKind::PoseGraph(_) => Py::new(py, read_pose_graph(path)?)?.into_any(),
        FileKind::MapDescription | FileKind::Image(_) => Py::new(py, read_grid(py, path, None)?)?.into_any(),
        _ => Py::new(py, read_exploration(path)?)?.into_any(),
    })
}
