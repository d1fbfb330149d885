//! The file in which a long search is kept.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use hssh::pipeline::{Keeper, Source};
use indicatif::HumanCount;

use super::replace::replace;
use crate::failure::Failure;
use crate::terminal::say;

/// The file of a checkpoint. It is replaced as a whole, so that there is always a whole one.
#[derive(Debug)]
pub(crate) struct CheckpointFile {
    file: PathBuf,
    /// Why the last checkpoint could not be written, if it could not.
    failed: Mutex<Option<io::Error>>,
}

impl CheckpointFile {
    pub(crate) fn new(file: &Path) -> Self {
        CheckpointFile { file: file.to_owned(), failed: Mutex::default() }
    }

    /// The search came to its end: nothing is left to go on with.
    pub(crate) fn remove(&self) -> Result<(), Failure> {
        match fs::remove_file(&self.file) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => self.failed(error),
            _ => Ok(()),
        }
    }

    /// The search was stopped, and is to go on from here.
    pub(crate) fn leave(&self) -> Result<(), Failure> {
        if let Some(error) = self.failed.lock().unwrap_or_else(PoisonError::into_inner).take() {
            return self.failed(error);
        }
        if self.file.exists() {
            say(&format!("the same command goes on from {}", self.file.display()));
        }
        Ok(())
    }

    fn failed(&self, error: io::Error) -> Result<(), Failure> {
        Err(Failure::Write { file: self.file.clone(), error })
    }
}

impl Keeper for CheckpointFile {
    fn keep(&self, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) {
        let written = replace(&self.file, write);
        let mut failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner);
        if let (None, Err(error)) = (failed.as_ref(), &written) {
            say(&format!(
                "warning: cannot write the checkpoint {}: {error}; the search goes on",
                self.file.display()
            ));
        }
        *failed = written.err();
    }

    fn kept(&self) -> io::Result<Option<Box<dyn Source>>> {
        match File::open(&self.file) {
            Ok(file) => Ok(Some(Box::new(file))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn goes_on(&self, hypotheses: u64) {
        say(&format!("goes on from {}: {} hypotheses so far", self.file.display(), HumanCount(hypotheses)));
    }
}
