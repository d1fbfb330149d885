//! Laser logs: scans with their geometry, and where odometry believed the robot to be.

use std::path::PathBuf;
use std::sync::Arc;

use hssh::account::TrackAccount;
use hssh::answer::AnswerWarning;
use hssh::file::{Source, TopicChoice, read_log};
use hssh::pipeline::{LaserChoice, SurveyedLog, TrackedLog};
use hssh_local::{LaserLog, LoggedScan, MatchOptions, RecordedScan, Recording, Scan, TimedPose};
use hssh_metrics::{GraphFile, Pose};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{pose, poses, row, shaped, sweeps, table};
use crate::errors::{Kind, argument, error, interrupted, of_file};
use crate::grid::PyGrid;
use crate::mapped::options;
use crate::pose_graph::PyPoseGraph;
use crate::survey::PySurvey;
use crate::watch::{Stop, finished, watched};

/// A robot's laser log: scans, each with its geometry and time, and raw odometry.
///
/// ``hssh.read_log`` reads one; ``Log.from_arrays`` makes one. Ranges are in metres, infinite where nothing came back; angles in
/// radians, counterclockwise from straight ahead; poses x, y, θ in metres and radians.
#[pyclass(name = "Log", module = "hssh", frozen)]
pub(crate) struct PyLog {
    pub(crate) log: Arc<LaserLog>,
    pub(crate) name: String,
    used: Vec<String>,
}

/// One sweep of a laser.
#[pyclass(name = "LaserScan", module = "hssh", frozen)]
pub(crate) struct PyScan {
    scan: LoggedScan,
}

impl PyLog {
    /// Opens a file that holds one.
    pub(crate) fn open(
        py: Python<'_>,
        path: PathBuf,
        source: impl FnOnce() -> PyResult<Source> + Send,
        laser: &LaserChoice,
        topics: &TopicChoice,
    ) -> PyResult<Self> {
        let read = finished(py, |_| read_log(&path, source()?, laser, topics).map_err(of_file))??;
        Ok(PyLog { log: Arc::new(read.log), name: path.display().to_string(), used: read.used })
    }
}

/// How a laser looks and sits.
pub(crate) fn laser_choice(view: Option<f64>, pose: Option<[f64; 3]>) -> PyResult<LaserChoice> {
    let is_view = |view: f64| (1f64.to_radians()..=360.1f64.to_radians()).contains(&view);
    if let Some(view) = view.filter(|&view| !is_view(view)) {
        return Err(argument(format!("laser_view is {view}: write radians, from one degree to a full turn")));
    }
    let pose = pose.map(|[x, y, turn]| (x, y, turn.to_degrees()));
    if let Some((x, y, turn)) = pose
        && !(x.abs() <= 10.0 && y.abs() <= 10.0 && turn.abs() <= 360.0)
    {
        return Err(argument(
            "laser_pose is metres ahead and to the left, no more than 10, and radians to the left",
        ));
    }
    Ok(LaserChoice { view: view.map(|view| view.to_degrees().min(360.0)), pose })
}

#[pymethods]
impl PyLog {
    /// A log from arrays.
    ///
    /// Parameters
    /// ----------
    /// ranges : array_like of float, shape (N, B)
    ///     Metres along each beam of each scan, counterclockwise; infinite or NaN where nothing came back.
    /// angle_min : float
    ///     The direction of the first beam: radians, counterclockwise from straight ahead.
    /// angle_increment : float
    ///     From each beam to the next: radians, positive.
    /// times : array_like of float, shape (N,), optional
    ///     When each scan was taken: seconds, ascending.
    /// odometry : array_like of float, shape (N, 3), optional
    ///     Where odometry believed the robot to be at each scan. Without it, the scans alone tell.
    /// laser_pose : (float, float), optional
    ///     Where the laser sits on the robot: metres ahead and to the left.
    /// range_min, range_max : float
    ///     What is nearer or farther counts as not come back.
    ///
    /// Returns
    /// -------
    /// Log
    #[staticmethod]
    #[pyo3(signature = (ranges, *, angle_min, angle_increment, times = None, odometry = None, laser_pose = [0.0, 0.0],
        range_min = 0.0, range_max = f64::INFINITY, name = "log"))]
    #[allow(clippy::too_many_arguments)] // keywords, each with its default
    fn from_arrays(
        py: Python<'_>,
        ranges: &Bound<'_, PyAny>,
        angle_min: f64,
        angle_increment: f64,
        times: Option<&Bound<'_, PyAny>>,
        odometry: Option<&Bound<'_, PyAny>>,
        laser_pose: [f64; 2],
        range_min: f64,
        range_max: f64,
        name: &str,
    ) -> PyResult<Self> {
        let ranges = sweeps("ranges", ranges)?;
        let beams = ranges.first().map_or(0, Vec::len);
        let numbers = [
            ("angle_min", angle_min),
            ("angle_increment", angle_increment),
            ("laser_pose", laser_pose[0] + laser_pose[1]),
        ];
        for (name, number) in numbers {
            if !number.is_finite() {
                return Err(argument(format!("{name} is {number}, which is no finite number")));
            }
        }
        // An even number of beams is a view without its last beam: see `Scan::bearing`.
        let view = angle_increment * (beams - beams % 2) as f64;
        if beams < 2 || angle_increment <= 0.0 || view > 1.001 * std::f64::consts::TAU {
            return Err(argument(format!(
                "{beams} beams, each {angle_increment} rad from the next, are no sweep of a laser: there are two or more, \
                 counterclockwise, and no more than a full turn"
            )));
        }
        let times = match times {
            Some(times) => row("times", times)?,
            None => (0..ranges.len()).map(|index| index as f64).collect(),
        };
        let odometry = odometry.map(|odometry| table::<3>("odometry", odometry)).transpose()?;
        let lengths = [("times", Some(times.len())), ("odometry", odometry.as_ref().map(Vec::len))];
        for (name, length) in lengths {
            if length.is_some_and(|length| length != ranges.len()) {
                return Err(argument(format!(
                    "there are {} scans, and {} rows of {name}: each scan has one",
                    ranges.len(),
                    length.unwrap_or_default()
                )));
            }
        }
        if let Some(index) = times.windows(2).position(|pair| pair[1] < pair[0]) {
            return Err(argument(format!(
                "times[{}] is less than times[{index}]: scans come in order",
                index + 1
            )));
        }
        let turn = angle_min + view / 2.0;
        let came_back = |range: f64| range >= range_min && range <= range_max;
        let kept = |range: f64| if came_back(range) { range } else { f64::INFINITY };
        let scan = |(ranges, &time): (Vec<f64>, &f64)| RecordedScan {
            scan: Scan {
                ranges: ranges.into_iter().map(kept).collect(),
                view: view.min(std::f64::consts::TAU),
                turn,
            },
            time,
        };
        let scans = ranges.into_iter().zip(&times).map(scan).collect();
        let odometry = odometry.unwrap_or_default().into_iter().zip(&times);
        let odometry = odometry.map(|(robot, &time)| TimedPose { time, pose: pose(robot) }).collect();
        let recording = Recording { scans, odometry, laser: laser_pose, ..Recording::default() };
        let log = finished(py, |_| LaserLog::from_recording(recording))?;
        let log = log.map_err(|problem| error(Kind::Format, problem))?;
        Ok(PyLog { log: Arc::new(log), name: name.to_owned(), used: Vec::new() })
    }

    /// str: What the log is called: its file, if it has one.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// list of str: What of a bag is used.
    #[getter]
    fn used(&self) -> Vec<String> {
        self.used.clone()
    }

    /// list of str: What was left out of the log, or decided with little reason.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.log.warnings.iter().map(ToString::to_string).collect()
    }

    /// float: From which range on nothing came back: metres.
    #[getter]
    fn max_range(&self) -> f64 {
        self.log.max_range
    }

    /// ndarray of float64, shape (N,): When each scan was taken: seconds; NaN where the log does not say.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let times = self.log.scans.iter().map(|scan| scan.time.unwrap_or(f64::NAN));
        PyArray1::from_vec(py, times.collect()).into_any()
    }

    /// ndarray of float64, shape (N, 3): Where raw odometry believed the laser to be at each scan.
    #[getter]
    fn odometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.log.scans.iter().map(|scan| scan.odometry))
    }

    /// ndarray of float64, shape (K, 3): All raw odometry of the laser, also between the scans.
    #[getter]
    fn trajectory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.log.trajectory.iter().copied())
    }

    /// ndarray of float64, shape (N, B): The ranges of all scans: metres, infinite where nothing came back.
    ///
    /// Raises ArgumentError if scans have different numbers of beams; ``log[i].ranges`` has those of one.
    #[getter]
    fn ranges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let beams = self.log.beams();
        if let Some(odd) = self.log.scans.iter().position(|scan| scan.scan.ranges.len() != beams) {
            return Err(argument(format!(
                "scan {odd} has {} beams, and most have {beams}: take the scans one by one",
                self.log.scans[odd].scan.ranges.len()
            )));
        }
        let flat = self.log.scans.iter().flat_map(|scan| scan.scan.ranges.iter().copied()).collect();
        shaped(py, flat, [self.log.scans.len(), beams])
    }

    /// Corrects the odometry from scan to scan: no places, no loops. What ``hssh track`` does.
    ///
    /// Returns
    /// -------
    /// Track
    ///
    /// Raises
    /// ------
    /// Interrupted
    ///     On Ctrl-C, with the track so far as its ``partial``.
    fn track(&self, py: Python<'_>) -> PyResult<PyTrack> {
        let log = (*self.log).clone();
        let done = watched(py, &Arc::new(Stop::default()), |stop| {
            TrackedLog::new(log, &MatchOptions::default(), |_| stop.reply())
        })?;
        let track = PyTrack { tracked: Arc::new(done.value), name: self.name.clone() };
        match done.stopped {
            None => Ok(track),
            Some(_) => Err(interrupted(py, Some(Py::new(py, track)?.into_any()))),
        }
    }

    /// A survey with options as JSON text; `hssh.survey` makes them.
    fn _survey(&self, py: Python<'_>, options_json: &str) -> PyResult<PySurvey> {
        let options = options(options_json)?;
        let log = (*self.log).clone();
        let done = watched(py, &Arc::new(Stop::default()), |stop| {
            SurveyedLog::new(log, &options, |_, _| stop.reply())
        })?;
        let named = |problem| error(Kind::Survey, format!("{}: {problem}", self.name));
        match (done.value, done.stopped) {
            (Ok(surveyed), None) => Ok(PySurvey { surveyed: Arc::new(surveyed), name: self.name.clone() }),
            (Err(problem), None) => Err(named(problem)),
            (Ok(surveyed), Some(_)) => {
                let survey = PySurvey { surveyed: Arc::new(surveyed), name: self.name.clone() };
                Err(interrupted(py, Some(Py::new(py, survey)?.into_any())))
            }
            (Err(_), Some(_)) => Err(interrupted(py, None)),
        }
    }

    /// A scan.
    fn __getitem__(&self, index: isize) -> PyResult<PyScan> {
        let count = self.log.scans.len();
        let position = if index < 0 { index.checked_add_unsigned(count) } else { Some(index) };
        let found = position.and_then(|position| self.log.scans.get(usize::try_from(position).ok()?));
        let scan = found.ok_or_else(|| {
            pyo3::exceptions::PyIndexError::new_err(format!("there is no scan {index}: the log has {count}"))
        })?;
        Ok(PyScan { scan: scan.clone() })
    }

    /// How many scans can be used.
    fn __len__(&self) -> usize {
        self.log.scans.len()
    }

    fn __repr__(&self) -> String {
        format!("<Log: {} scans of {} beams>", self.log.scans.len(), self.log.beams())
    }
}

#[pymethods]
impl PyScan {
    /// ndarray of float64, shape (B,): Metres along each beam, counterclockwise; infinite where nothing came back.
    #[getter]
    fn ranges<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_slice(py, &self.scan.scan.ranges).into_any()
    }

    /// ndarray of float64, shape (B,): The direction of each beam: radians, counterclockwise from straight ahead; not wrapped.
    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let scan = &self.scan.scan;
        PyArray1::from_vec(py, (0..scan.ranges.len()).map(|beam| scan.bearing(beam)).collect()).into_any()
    }

    /// float or None: When it was taken: seconds of the recording program's clock.
    #[getter]
    fn time(&self) -> Option<f64> {
        self.scan.time
    }

    /// ndarray of float64, shape (3,): Where raw odometry believed the laser to be.
    #[getter]
    fn odometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Pose { x, y, theta } = self.scan.odometry;
        shaped(py, vec![x, y, theta], [3])
    }

    /// The points that beams hit, shape (K, 2): metres ahead of the laser and to its left.
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let hits: Vec<[f64; 2]> =
            self.scan.scan.hits(f64::INFINITY).map(|(_, point)| [point.x, point.y]).collect();
        let count = hits.len();
        shaped(py, hits.concat(), [count, 2])
    }

    fn __len__(&self) -> usize {
        self.scan.scan.ranges.len()
    }

    fn __repr__(&self) -> String {
        let Scan { ranges, view, .. } = &self.scan.scan;
        format!("<LaserScan: {} beams, {:.1} degrees wide>", ranges.len(), view.to_degrees())
    }
}

/// A log whose odometry was corrected from scan to scan. Poses are in the frame of the first scan.
#[pyclass(name = "Track", module = "hssh", frozen)]
pub(crate) struct PyTrack {
    tracked: Arc<TrackedLog>,
    name: String,
}

#[pymethods]
impl PyTrack {
    /// ndarray of float64, shape (N, 3): Where each scan that can be used was taken.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        poses(py, self.tracked.poses().into_iter())
    }

    /// When every scan of the log was taken and where.
    ///
    /// Returns
    /// -------
    /// times : ndarray of float64, shape (N,)
    ///     Seconds, or the number of the scan if the log has no times.
    /// poses : ndarray of float64, shape (N, 3)
    ///     A scan that cannot be used has the pose of the one before.
    fn trajectory<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let timed = self.tracked.trajectory();
        let times = PyArray1::from_vec(py, timed.iter().map(|(time, _)| *time).collect()).into_any();
        Ok((times, poses(py, timed.iter().map(|(_, pose)| *pose))?))
    }

    /// list of str: What was left out of the log, or where the robot is lost.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.tracked.warnings().iter().map(AnswerWarning::to_string).collect()
    }

    /// What the scans draw where the track has them.
    fn grid(&self, py: Python<'_>) -> PyResult<PyGrid> {
        let grid = finished(py, |_| self.tracked.grid())?.map_err(|problem| error(Kind::Survey, problem))?;
        Ok(PyGrid::of(grid, format!("the track of {}", self.name)))
    }

    /// A pose for each scan, and a measurement for each step.
    #[getter]
    fn graph(&self) -> PyResult<PyPoseGraph> {
        let graph = self.tracked.graph().map_err(|problem| error(Kind::Survey, problem))?;
        Ok(PyPoseGraph::of(GraphFile::from(graph), format!("the track of {}", self.name)))
    }

    /// Everything as JSON, as the program's ``hssh track --json`` prints it.
    fn to_json(&self) -> PyResult<String> {
        let account = TrackAccount::new(&self.name, &self.tracked);
        let text =
            serde_json::to_string_pretty(&account).map_err(|problem| error(Kind::Internal, problem))?;
        Ok(text + "\n")
    }

    /// What the robot did, in words.
    fn __str__(&self) -> String {
        TrackAccount::new(&self.name, &self.tracked).to_string()
    }

    fn __len__(&self) -> usize {
        self.tracked.track.scans.len()
    }

    fn __repr__(&self) -> String {
        format!("<Track: {} scans>", self.__len__())
    }
}
