//! Stars: the local topology of a place.

use hssh_causal::check_bearings;
use hssh_topology::{Isomorphism, Olp, OlpName, Passability, Sign, Star, StarEnd};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::errors::{argument, wrong_type};

/// The local topology of a place: the ends of its local paths in clockwise order.
///
/// Parameters
/// ----------
/// ends : str or sequence of str
///     The ends, clockwise. Each is a local path's number and a sign, as in ``1+``; ``1-`` is the other end of the same
///     path, and both must be there. A closed end stands in parentheses, a label behind a colon: ``"0+ (1+) 0- 1-:door"``.
/// bearings : sequence of float or None, optional
///     Where each end points: radians, counterclockwise from the x axis of the place's frame; None or NaN where it is not known.
///
/// Examples
/// --------
/// >>> import hssh
/// >>> tee = hssh.Star("0+ (1+) 0- 1-")
/// >>> tee.gateways
/// ['0+', '0-', '1-']
/// >>> tee.isomorphisms(hssh.Star("(1+) 0- 1- 0+"))
/// [3]
#[pyclass(name = "Star", module = "hssh", frozen, eq, hash, from_py_object)]
#[derive(Clone, PartialEq)]
pub(crate) struct PyStar {
    pub(crate) star: Star,
    pub(crate) bearings: Vec<Option<f64>>,
}

impl std::hash::Hash for PyStar {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.star.hash(state);
    }
}

impl PyStar {
    /// A star without bearings.
    pub(crate) fn bare(star: Star) -> Self {
        PyStar { bearings: vec![None; star.degree() as usize], star }
    }

    /// A star, or what spells one.
    pub(crate) fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        match value.extract::<PyStar>() {
            Ok(star) => Ok(star),
            Err(_) => PyStar::new(value, None),
        }
    }

    /// The end of a name or a number.
    pub(crate) fn end(&self, value: &Bound<'_, PyAny>, whose: &str) -> PyResult<Olp> {
        let names = || self.star.olps().map(|olp| self.star.name(olp).to_string()).collect::<Vec<_>>();
        if let Ok(name) = value.cast::<PyString>() {
            let name = name.to_string();
            let found = name.parse::<OlpName>().ok().and_then(|name| self.star.find(name));
            return found.ok_or_else(|| {
                argument(format!("{whose} has no end `{name}`: its ends are {}", names().join(", ")))
            });
        }
        let number: u32 = value
            .extract()
            .map_err(|_| wrong_type(format!("an end is a name like \"0+\" or a number, not {value}")))?;
        if number >= self.star.degree() {
            return Err(argument(format!(
                "{whose} has no end number {number}: it has {}, counted from 0",
                self.star.degree()
            )));
        }
        Ok(Olp::new(number))
    }
}

#[pymethods]
impl PyStar {
    #[new]
    #[pyo3(signature = (ends, bearings = None))]
    fn new(ends: &Bound<'_, PyAny>, bearings: Option<Vec<Option<f64>>>) -> PyResult<Self> {
        let spelled = match ends.cast::<PyString>() {
            Ok(text) => text.to_string(),
            Err(_) => ends
                .extract::<Vec<String>>()
                .map_err(|_| {
                    wrong_type("a star is a text like \"0+ (1+) 0- 1-\", or a list of its ends".to_owned())
                })?
                .join(" "),
        };
        let star: Star = spelled.parse().map_err(argument)?;
        let Some(bearings) = bearings else { return Ok(PyStar::bare(star)) };
        let bearings: Vec<Option<f64>> =
            bearings.into_iter().map(|bearing| bearing.filter(|radians| !radians.is_nan())).collect();
        if bearings.len() != star.degree() as usize {
            return Err(argument(format!(
                "the star {star} has {} ends but {} bearings",
                star.degree(),
                bearings.len()
            )));
        }
        check_bearings(&star, &bearings).map_err(argument)?;
        Ok(PyStar { star, bearings })
    }

    /// list of str: The names of the ends, clockwise.
    #[getter]
    fn ends(&self) -> Vec<String> {
        self.star.olps().map(|olp| self.star.name(olp).to_string()).collect()
    }

    /// list of str: The names of the ends that can be travelled, clockwise.
    #[getter]
    fn gateways(&self) -> Vec<String> {
        self.star.gateways().map(|olp| self.star.name(olp).to_string()).collect()
    }

    /// list of (float or None): Where each end points: radians, counterclockwise in the place's frame.
    #[getter]
    fn bearings(&self) -> Vec<Option<f64>> {
        self.bearings.clone()
    }

    /// list of (str or None): What else is known of each end.
    #[getter]
    fn labels(&self) -> Vec<Option<String>> {
        self.star.ends().iter().map(|end| end.label.clone()).collect()
    }

    /// int: How many ends there are: twice the number of local paths.
    #[getter]
    fn degree(&self) -> u32 {
        self.star.degree()
    }

    /// The name of the other end of the same local path.
    fn opposite(&self, end: &Bound<'_, PyAny>) -> PyResult<String> {
        let olp = self.end(end, &format!("the star {}", self.star))?;
        Ok(self.star.name(self.star.opposite(olp)).to_string())
    }

    /// All ways in which this star can be turned to lie on another one.
    ///
    /// Returns
    /// -------
    /// list of int
    ///     By how many ends, clockwise; names and bearings do not count, labels do.
    fn isomorphisms(&self, other: &PyStar) -> Vec<u32> {
        Isomorphism::all(&self.star, &other.star).map(|phi| phi.rotation()).collect()
    }

    fn __len__(&self) -> usize {
        self.star.degree() as usize
    }

    /// The ends as the constructor reads them.
    fn __str__(&self) -> String {
        self.star.ends().iter().map(spelled).collect::<Vec<_>>().join(" ")
    }

    fn __repr__(&self) -> String {
        format!("Star(\"{}\")", self.__str__())
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, Spelled)> {
        let star = slf.get();
        Ok((slf.get_type().into_any().unbind(), (star.__str__(), star.bearings.clone())))
    }
}

/// What the constructor takes: the ends, and where they point.
type Spelled = (String, Vec<Option<f64>>);

/// An end as the constructor reads it.
fn spelled(end: &StarEnd) -> String {
    let sign = if end.name.sign == Sign::Plus { '+' } else { '-' };
    let label = end.label.as_ref().map(|label| format!(":{label}")).unwrap_or_default();
    let whole = format!("{}{sign}{label}", end.name.local_path);
    if end.passability == Passability::Closed { format!("({whole})") } else { whole }
}
