//! The commands of the program, one per module.

pub(crate) mod check;
pub(crate) mod explain;
pub(crate) mod explore;
pub(crate) mod export;
mod floor;
pub(crate) mod graph;
pub(crate) mod live;
pub(crate) mod map;
mod page;
pub(crate) mod shell;
pub(crate) mod simulate;
mod stages;
pub(crate) mod stars;
pub(crate) mod track;
pub(crate) mod verify;

use hssh::pipeline::MappingOptions;

use crate::arguments::OptionsArguments;
use crate::failure::{Failure, Status};
use crate::output::{print, print_json};

/// `hssh options`: the file of options with its defaults.
pub(crate) fn print_options(arguments: &OptionsArguments) -> Result<Status, Failure> {
    if arguments.json {
        print_json(&MappingOptions::default())?;
    } else {
        print(MappingOptions::DEFAULTS)?;
    }
    Ok(Status::Found)
}
