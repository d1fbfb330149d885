//! Rust's errors as the exceptions of Python, with the same words.

use std::fmt::Display;

use hssh::file::FileError;
use hssh::graph::GraphFailure;
use hssh::online::OnlineError;
use hssh::pipeline::PipelineError;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// Which exception of `hssh.errors` it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    /// An argument that makes no sense.
    Argument,
    /// A file that cannot be opened or read.
    File,
    /// A text or a file that is not what it should be.
    Format,
    /// A pose graph without a solution.
    Solve,
    /// No search, or no answer of it.
    Search,
    /// A log without places, or a grid map without regions.
    Survey,
    /// What must not happen.
    Internal,
}

impl Kind {
    fn class(self) -> &'static str {
        match self {
            Kind::Argument => "ArgumentError",
            Kind::File => "FileError",
            Kind::Format => "FormatError",
            Kind::Solve => "SolveError",
            Kind::Search => "SearchError",
            Kind::Survey => "SurveyError",
            Kind::Internal => "InternalError",
        }
    }
}

/// The exception of a kind.
pub(crate) fn error(kind: Kind, message: impl Display) -> PyErr {
    Python::attach(|py| {
        let raised = class(py, kind.class()).and_then(|class| class.call1((message.to_string(),)));
        raised.map_or_else(|problem| problem, PyErr::from_value)
    })
}

/// An argument that makes no sense.
pub(crate) fn argument(message: impl Display) -> PyErr {
    error(Kind::Argument, message)
}

/// An argument of the wrong type.
pub(crate) fn wrong_type(message: impl Display) -> PyErr {
    PyTypeError::new_err(message.to_string())
}

/// A text that is not what it should be, and where.
pub(crate) fn format_error(message: impl Display, line: Option<usize>, column: Option<usize>) -> PyErr {
    let error = error(Kind::Format, message);
    Python::attach(|py| {
        let value = error.value(py);
        let placed = value.setattr("line", line).and_then(|()| value.setattr("column", column));
        placed.map_or_else(|problem| problem, |()| error.clone_ref(py))
    })
}

/// `KeyboardInterrupt` with what is known so far.
pub(crate) fn interrupted(py: Python<'_>, partial: Option<Py<PyAny>>) -> PyErr {
    let raised = class(py, "Interrupted").and_then(|class| class.call1((partial,)));
    raised.map_or_else(|problem| problem, PyErr::from_value)
}

fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("hssh.errors")?.getattr(name)
}

/// Of a file.
pub(crate) fn of_file(problem: FileError) -> PyErr {
    let message = problem.to_string();
    match &problem {
        FileError::Read { error, .. } | FileError::Damaged { error, .. } => {
            let code = error.raw_os_error();
            let raised = self::error(Kind::File, message);
            Python::attach(|py| match raised.value(py).setattr("errno", code) {
                Ok(()) => raised.clone_ref(py),
                Err(problem) => problem,
            })
        }
        FileError::Exploration { error, .. } => {
            format_error(message, Some(error.line()), Some(error.column()))
        }
        FileError::PoseGraph { error, .. } => format_error(message, Some(error.line), None),
        _ => format_error(message, None, None),
    }
}

/// Of a pose graph.
pub(crate) fn of_graph(problem: GraphFailure) -> PyErr {
    match problem {
        GraphFailure::WeighedRelaxation | GraphFailure::Unplaced { .. } => argument(problem),
        GraphFailure::Solve(_) | GraphFailure::Floating { .. } => error(Kind::Solve, problem),
    }
}

/// Of a search.
pub(crate) fn of_pipeline(problem: PipelineError) -> PyErr {
    let kind = match &problem {
        PipelineError::Log(_) => Kind::Format,
        PipelineError::Survey(_) => Kind::Survey,
        PipelineError::Search(_) | PipelineError::NoAccount { .. } => Kind::Search,
        PipelineError::Corrected(_) | PipelineError::Disagreement(_) => Kind::Internal,
        _ => Kind::Argument,
    };
    error(kind, problem)
}

/// Of a search that goes on.
pub(crate) fn of_online(problem: OnlineError) -> PyErr {
    match problem {
        OnlineError::Options(problem) => of_pipeline(problem),
        _ => argument(problem),
    }
}
