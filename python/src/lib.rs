//! The native part of the Python package hssh: numbers come in as numpy arrays, and what the crates find goes out as such.
//!
//! `package/hssh` is what people import: it shows answers as objects, and puts options together. Nothing here decides anything that
//! the crates decide.

mod arrays;
mod embedding;
mod errors;
mod exploration;
mod files;
mod grid;
mod log;
mod mapped;
mod marginals;
mod online;
mod optimized;
mod places;
mod pose_graph;
mod star;
mod survey;
mod watch;

use pyo3::prelude::*;

#[pymodule(gil_used = true)]
fn _hssh(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<star::PyStar>()?;
    module.add_class::<embedding::PyEmbeddedGraph>()?;
    module.add_class::<pose_graph::PyPoseGraph>()?;
    module.add_class::<optimized::PySolution>()?;
    module.add_class::<marginals::PyMarginals>()?;
    module.add_class::<exploration::PyExploration>()?;
    module.add_class::<mapped::PyMapped>()?;
    module.add_class::<online::PyOnline>()?;
    module.add_class::<log::PyLog>()?;
    module.add_class::<log::PyScan>()?;
    module.add_class::<log::PyTrack>()?;
    module.add_class::<survey::PySurvey>()?;
    module.add_class::<grid::PyGrid>()?;
    module.add_class::<places::PyPlaces>()?;
    module.add_function(wrap_pyfunction!(files::read, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_exploration, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_grid, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_log, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_pose_graph, module)?)?;
    module.add_function(wrap_pyfunction!(mapped::map_source, module)?)?;
    module.add_function(wrap_pyfunction!(places::find_places, module)?)?;
    module.add_function(wrap_pyfunction!(places::place_around, module)?)?;
    Ok(())
}
