//! Explorations: what the robot saw and did.

use std::path::PathBuf;
use std::sync::Arc;

use hssh::file::{Source, read_exploration};
use hssh_causal::{Exploration, NamedStar, Odometry, StarType, Travel};
use hssh_topology::Olp;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{covariance, shaped, triple};
use crate::errors::{argument, format_error, of_file, wrong_type};
use crate::star::PyStar;
use crate::watch::calmly;

/// What a robot saw and did: the stars of the places, and its travels from one to the next.
///
/// Parameters
/// ----------
/// stars : dict of str to Star
///     What places look like, by name. A star may be spelled as its constructor reads it.
/// start : str
///     The star that was seen first.
/// travels : iterable of Travel or of tuples
///     The travels in order: ``(exit, entry, star)``, or with what was measured on the way ``(exit, entry, star, odometry, covariance)``.
///     ``exit`` is the end of the star before that the robot left by, ``entry`` the end of the star after that it came in by, each
///     by its name or its number. ``odometry`` is the frame of the arrival in that of the departure, x, y, θ, in metres and radians;
///     ``covariance`` is that of these three numbers, shape (3, 3), or (3,) for a diagonal.
///
/// Raises
/// ------
/// ArgumentError
///     If an end does not exist or is closed, or a measurement is none.
///
/// Examples
/// --------
/// >>> import hssh
/// >>> corridor = hssh.Exploration(
/// ...     {"west": "0+ (0-)", "east": "(0+) 0-"}, "west", [("0+", "0-", "east"), ("0-", "0+", "west")]
/// ... )
/// >>> len(corridor)
/// 2
/// >>> hssh.map(corridor).verdict.sentence
/// 'One map explains the exploration; that no other does is proved.'
#[pyclass(name = "Exploration", module = "hssh", frozen, eq)]
#[derive(PartialEq)]
pub(crate) struct PyExploration {
    pub(crate) exploration: Arc<Exploration>,
    pub(crate) name: String,
}

impl PyExploration {
    pub(crate) fn of(exploration: Exploration, name: String) -> Self {
        PyExploration { exploration: Arc::new(exploration), name }
    }

    /// Opens a file that holds one.
    pub(crate) fn open(path: PathBuf, source: Source) -> PyResult<Self> {
        let exploration = read_exploration(&path, source).map_err(of_file)?;
        Ok(PyExploration::of(exploration, path.display().to_string()))
    }

    fn star_of(&self, star_type: StarType) -> &NamedStar {
        &self.exploration.star_types()[star_type.index()]
    }
}

/// The parts of a travel: exit, entry, star, odometry and its covariance.
struct Parts<'py> {
    exit: Bound<'py, PyAny>,
    entry: Bound<'py, PyAny>,
    star: String,
    odometry: Option<Odometry>,
}

impl<'py> Parts<'py> {
    fn of(index: usize, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let wrong = || {
            wrong_type(format!(
                "travels[{index}] is {value}: a travel is (exit, entry, star), or (exit, entry, star, odometry, covariance)"
            ))
        };
        let fields: Vec<Bound<'py, PyAny>> = if value.hasattr("exit")? {
            let names = ["exit", "entry", "star", "odometry", "covariance"];
            names.iter().map(|name| value.getattr(*name)).collect::<PyResult<_>>()?
        } else {
            value.try_iter().map_err(|_| wrong())?.collect::<PyResult<_>>()?
        };
        let (exit, entry, star, measured) = match &fields[..] {
            [exit, entry, star] => (exit, entry, star, None),
            [exit, entry, star, odometry, covariance] => (exit, entry, star, Some((odometry, covariance))),
            _ => return Err(wrong()),
        };
        let odometry = match measured {
            Some((odometry, covariance)) => measurement(&format!("travels[{index}]"), odometry, covariance)?,
            None => None,
        };
        Ok(Parts {
            exit: exit.clone(),
            entry: entry.clone(),
            star: star.extract().map_err(|_| wrong())?,
            odometry,
        })
    }
}

/// A measured travel; nothing of it, or all.
pub(crate) fn measurement(
    whose: &str,
    odometry: &Bound<'_, PyAny>,
    covariance_given: &Bound<'_, PyAny>,
) -> PyResult<Option<Odometry>> {
    match (odometry.is_none(), covariance_given.is_none()) {
        (true, true) => Ok(None),
        (false, false) => {
            let [x, y, theta] = triple(&format!("the odometry of {whose}"), odometry)?;
            let covariance = covariance(&format!("the covariance of {whose}"), covariance_given)?;
            Ok(Some(Odometry { x, y, theta, covariance }))
        }
        _ => Err(argument(format!(
            "{whose} has odometry or a covariance, but not both: neither is of use alone"
        ))),
    }
}

#[pymethods]
impl PyExploration {
    #[new]
    #[pyo3(signature = (stars, start, travels = None))]
    fn new(stars: &Bound<'_, PyDict>, start: &str, travels: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let mut star_types = Vec::new();
        let mut spelled: Vec<PyStar> = Vec::new();
        for (name, star) in stars.iter() {
            let name: String =
                name.extract().map_err(|_| wrong_type(format!("a star's name is a text, not {name}")))?;
            let star = PyStar::of(&star)?;
            spelled.push(star.clone());
            star_types.push(NamedStar { name, star: star.star, bearings: star.bearings });
        }
        let find = |name: &str, whose: &str| {
            star_types.iter().position(|named| named.name == name).ok_or_else(|| {
                let known: Vec<&str> = star_types.iter().map(|named| named.name.as_str()).collect();
                argument(format!("{whose} star `{name}` is not among the stars: {}", known.join(", ")))
            })
        };
        let begin = find(start, "the start's")?;
        let mut here = begin;
        let mut told = Vec::new();
        if let Some(travels) = travels {
            for (index, value) in travels.try_iter()?.enumerate() {
                let parts = Parts::of(index, &value?)?;
                let there = find(&parts.star, &format!("travels[{index}]'s"))?;
                let end = |end: &Bound<'_, PyAny>, star: usize| {
                    spelled[star].end(end, &format!("travels[{index}]: star `{}`", star_types[star].name))
                };
                let (exit, entry): (Olp, Olp) = (end(&parts.exit, here)?, end(&parts.entry, there)?);
                told.push(Travel { exit, entry, star: StarType(there as u32), odometry: parts.odometry });
                here = there;
            }
        }
        calmly(|| {
            let exploration = Exploration::new(star_types, StarType(begin as u32), told).map_err(argument)?;
            Ok(PyExploration::of(exploration, "exploration".to_owned()))
        })
    }

    /// The exploration that a text holds (docs/exploration-format.md).
    ///
    /// Raises
    /// ------
    /// FormatError
    ///     If it is none; ``line`` and ``column`` say where.
    #[staticmethod]
    #[pyo3(signature = (text, name = "exploration"))]
    fn from_ron(text: &str, name: &str) -> PyResult<Self> {
        let read = calmly(|| Ok(Exploration::from_ron(text)))?;
        let exploration = read.map_err(|error| {
            format_error(error.render(name, text), Some(error.line()), Some(error.column()))
        })?;
        Ok(PyExploration::of(exploration, name.to_owned()))
    }

    /// The exploration as text.
    fn to_ron(&self) -> String {
        self.exploration.to_ron()
    }

    /// str: What it is called: its file, if it has one.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// dict of str to Star: What places look like.
    #[getter]
    fn stars<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let stars = PyDict::new(py);
        for NamedStar { name, star, bearings } in self.exploration.star_types() {
            stars.set_item(name, PyStar { star: star.clone(), bearings: bearings.clone() })?;
        }
        Ok(stars)
    }

    /// str: The star seen first.
    #[getter]
    fn start(&self) -> &str {
        &self.star_of(self.exploration.start()).name
    }

    /// list of str: The star seen on each visit, the start first: one more than there are travels.
    #[getter]
    fn visits(&self) -> Vec<&str> {
        self.exploration.visits().map(|star_type| self.star_of(star_type).name.as_str()).collect()
    }

    /// list of Travel: The travels in order.
    #[getter]
    fn travels<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let class = py.import("hssh.travel")?.getattr("Travel")?;
        let mut here = self.exploration.start();
        let mut travels = Vec::new();
        for Travel { exit, entry, star, odometry } in self.exploration.travels() {
            let name = |star_type, olp| self.star_of(star_type).star.name(olp).to_string();
            let measured = odometry.map(|measured| {
                let flat = measured.covariance.concat();
                (shaped(py, vec![measured.x, measured.y, measured.theta], [3]), shaped(py, flat, [3, 3]))
            });
            let (odometry, covariance) = match measured {
                Some((odometry, covariance)) => (Some(odometry?), Some(covariance?)),
                None => (None, None),
            };
            let ends = (name(here, *exit), name(*star, *entry));
            travels.push(class.call1((ends.0, ends.1, &self.star_of(*star).name, odometry, covariance))?);
            here = *star;
        }
        Ok(travels)
    }

    /// list of str: What is possible and hardly meant, such as degrees for radians.
    #[getter]
    fn doubts(&self) -> Vec<String> {
        self.exploration.doubts().iter().map(ToString::to_string).collect()
    }

    /// The beginning: the first so many travels.
    fn prefix(&self, travels: usize) -> Self {
        PyExploration::of(self.exploration.prefix(travels), self.name.clone())
    }

    /// How many travels there are.
    fn __len__(&self) -> usize {
        self.exploration.travels().len()
    }

    /// An exploration is there even if it has no travels.
    fn __bool__(&self) -> bool {
        true
    }

    fn __repr__(&self) -> String {
        let stars = self.exploration.star_types().len();
        format!("<Exploration: {} travels, {stars} star types>", self.__len__())
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, (String, String))> {
        let exploration = slf.get();
        let make = slf.get_type().getattr("from_ron")?.unbind();
        Ok((make, (exploration.to_ron(), exploration.name.clone())))
    }
}
