//! Printing, and writing files.

mod checkpoint;
mod place;
mod replace;
mod robot;
mod spill;

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use crate::failure::Failure;
use crate::terminal::{harmless, say};

pub(crate) use checkpoint::CheckpointFile;
pub(crate) use place::{check_folder, check_outputs, refuse_input};
pub(crate) use robot::{grid_image, to_tum, write_grid, write_tum};
pub(crate) use spill::SpillFile;

/// Prints text to standard output; nothing in it commands the terminal.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    out.write_all(harmless(text).as_bytes())?;
    Ok(out.flush()?)
}

/// One JSON object.
pub(crate) fn to_json(value: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(std::io::Error::from)?;
    Ok(text + "\n")
}

/// Prints one JSON object.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(&to_json(value)?)
}

/// Writes a file and says so on standard error.
pub(crate) fn write_file(file: &Path, text: &str) -> Result<(), Failure> {
    write_bytes(file, text.as_bytes())
}

/// Writes a file as a whole, or not at all: what was there stays until what comes is complete.
pub(crate) fn write_bytes(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    replace::replace(file, |out| out.write_all(bytes))
        .map_err(|error| Failure::Write { file: file.to_owned(), error })?;
    say_written(file);
    Ok(())
}

/// Says on standard error that a file was written.
pub(crate) fn say_written(file: &Path) {
    say(&format!("wrote {}", file.display()));
}

/// Several files of one result: what fails keeps none of the others from being written.
#[derive(Default)]
pub(crate) struct Written {
    failed: Option<Failure>,
}

impl Written {
    /// Takes note of how writing went; the first failure is reported in the end, further ones at once.
    pub(crate) fn note(&mut self, written: Result<(), Failure>) {
        if let Err(failure) = written {
            match self.failed {
                None => self.failed = Some(failure),
                Some(_) => failure.print(),
            }
        }
    }

    /// Whether all went well.
    pub(crate) fn done(self) -> Result<(), Failure> {
        self.failed.map_or(Ok(()), Err)
    }
}
