//! The commands of the program, one per module.

pub(crate) mod check;
pub(crate) mod explain;
pub(crate) mod explore;
mod floor;
pub(crate) mod graph;
pub(crate) mod map;
pub(crate) mod simulate;
mod stages;
pub(crate) mod stars;
pub(crate) mod verify;

use hssh::pipeline::MappingOptions;

use crate::failure::{Failure, Status};

/// `hssh options`: the file of options with its defaults.
pub(crate) fn print_options() -> Result<Status, Failure> {
    crate::output::print(MappingOptions::DEFAULTS)?;
    Ok(Status::Found)
}
