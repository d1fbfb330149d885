//! Mapping while the robot goes on.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

use hssh::online::OnlineMapping;
use hssh::pipeline::Monitor;
use hssh_causal::{Exploration, NamedStar};
use hssh_search::StopReason;
use pyo3::prelude::*;

use crate::errors::{Kind, error, interrupted, of_online};
use crate::exploration::{PyExploration, measurement};
use crate::mapped::{PyMapped, options};
use crate::star::PyStar;
use crate::watch::{Stop, calmly, finished, watched};

/// The mapper behind `hssh.Mapper`.
#[pyclass(name = "Online", module = "hssh._hssh", frozen)]
pub(crate) struct PyOnline {
    mapping: Mutex<OnlineMapping>,
    monitor: Arc<Monitor>,
}

/// A star under a name of its own: the one it has already, the one given, or the star itself.
fn named(known: Option<&Exploration>, star: PyStar, name: Option<String>) -> NamedStar {
    let types = known.map_or(&[][..], Exploration::star_types);
    let same = types.iter().find(|named| named.star == star.star && named.bearings == star.bearings);
    let free = |name: &String| types.iter().all(|named| named.name != *name);
    let wanted = name.unwrap_or_else(|| star.star.to_string());
    let numbered = (2..).map(|number: u32| format!("{wanted} ({number})"));
    let name = match same {
        Some(same) => same.name.clone(),
        None => std::iter::once(wanted.clone()).chain(numbered).find(free).unwrap_or_default(),
    };
    NamedStar { name, star: star.star, bearings: star.bearings }
}

impl PyOnline {
    /// The mapping, for whoever holds the interpreter, which must not wait for a search of another thread.
    fn mapping(&self) -> PyResult<MutexGuard<'_, OnlineMapping>> {
        match self.mapping.try_lock() {
            Ok(mapping) => Ok(mapping),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                Err(error(Kind::Search, "the mapper is at work in another thread"))
            }
        }
    }

    /// The mapping, for a thread that may wait.
    fn waited(&self) -> MutexGuard<'_, OnlineMapping> {
        self.mapping.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl PyOnline {
    #[new]
    #[pyo3(signature = (star, name, options_json))]
    fn new(star: &Bound<'_, PyAny>, name: Option<String>, options_json: &str) -> PyResult<Self> {
        let star = named(None, PyStar::of(star)?, name);
        let options = options(options_json)?;
        let monitor = Arc::new(Monitor::default());
        calmly(|| {
            let mapping = OnlineMapping::start("exploration", star, options, Arc::clone(&monitor));
            Ok(PyOnline { mapping: Mutex::new(mapping.map_err(of_online)?), monitor: Arc::clone(&monitor) })
        })
    }

    #[pyo3(signature = (exit, entry, star, name, odometry, covariance))]
    fn observe(
        &self,
        exit: &Bound<'_, PyAny>,
        entry: &Bound<'_, PyAny>,
        star: &Bound<'_, PyAny>,
        name: Option<String>,
        odometry: &Bound<'_, PyAny>,
        covariance: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let star = PyStar::of(star)?;
        let odometry = measurement("the travel", odometry, covariance)?;
        let entry = star.end(entry, &format!("the star {} of the arrival", star.star))?;
        let mut mapping = self.mapping()?;
        let exploration = mapping.exploration();
        let last = exploration.visits().last().unwrap_or(exploration.start());
        let before = PyStar::bare(exploration.star(last).clone());
        let exit = before.end(exit, &format!("the star {} of the departure", before.star))?;
        let star = named(Some(exploration), star, name);
        calmly(|| mapping.observe(exit, entry, star, odometry).map_err(of_online))
    }

    /// Why it stopped.
    fn advance(&self, py: Python<'_>) -> PyResult<String> {
        self.monitor.reset();
        let stop = Arc::new(Stop::of(Arc::clone(&self.monitor)));
        let done = watched(py, &stop, |_| self.waited().advance())?;
        match done.stopped {
            Some(_) => Err(interrupted(py, None)),
            None => Ok(word(done.value)),
        }
    }

    /// Sets limits: those of options.
    fn set_limits(&self, options_json: &str) -> PyResult<()> {
        let limits = options(options_json)?.limits;
        calmly(|| {
            self.mapping()?.set_limits(limits);
            Ok(())
        })
    }

    fn answer(&self, py: Python<'_>) -> PyResult<PyMapped> {
        Ok(PyMapped::of_answer(finished(py, |_| self.waited().answer())?))
    }

    fn exploration(&self) -> PyResult<PyExploration> {
        let mapping = self.mapping()?;
        Ok(PyExploration::of(mapping.exploration().clone(), "exploration".to_owned()))
    }
}

/// As answers spell it.
fn word(stop: StopReason) -> String {
    let spelled = serde_json::to_value(stop).ok();
    spelled.and_then(|word| word.as_str().map(str::to_owned)).unwrap_or_default()
}
