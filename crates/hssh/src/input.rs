//! Reading what maps are to explain: explorations and laser logs.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;
use std::time::Duration;

use hssh::answer::AnswerWarning;
use hssh::pipeline::{Input, MappingOptions, SurveyedLog, is_log};
use hssh_causal::Exploration;
use hssh_local::{LaserLog, LogError, SurveyError, SurveyStage};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::Failure;

/// An exploration, or a laser log with what is found in it.
pub(crate) fn read_input(file: &Path, options: &MappingOptions) -> Result<Input, Failure> {
    let name = file.display().to_string();
    if holds_log(file)? {
        let surveyed = surveyed(file, options)?;
        return Input::surveyed(name, surveyed).map_err(|error| failed(file, error));
    }
    Ok(Input::exploration(name, read_exploration(file)?))
}

/// The exploration in a file, or on standard input if the path is `-`.
pub(crate) fn read_exploration(file: &Path) -> Result<Exploration, Failure> {
    let bytes = if file.as_os_str() == "-" {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(file)
    };
    let bytes = bytes.map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    Exploration::from_ron_bytes(&bytes).map_err(|error| Failure::parse(file, &bytes, &error))
}

/// Whether a file holds a laser log. Standard input is taken for an exploration.
pub(crate) fn holds_log(file: &Path) -> Result<bool, Failure> {
    if file.as_os_str() == "-" {
        return Ok(false);
    }
    let mut beginning = vec![0; 4096];
    let read = File::open(file).and_then(|mut source| source.read(&mut beginning));
    beginning.truncate(read.map_err(|error| Failure::Read { file: file.to_owned(), error })?);
    Ok(is_log(&beginning))
}

/// A CARMEN log, plain or gzip, and the places along it, with a progress bar on standard error; warnings go there, too.
pub(crate) fn surveyed(file: &Path, options: &MappingOptions) -> Result<SurveyedLog, Failure> {
    let log = read_log(file)?;
    let scans = log.scans.len() as u64;
    let bar = ProgressBar::with_draw_target(Some(2 * scans), ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {bar:30} {percent}%  {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    let surveyed = SurveyedLog::new(log, options, |stage, done| {
        let (message, before) = match stage {
            SurveyStage::Tracking => ("matching scans", 0),
            SurveyStage::Looking => ("looking for places", scans),
        };
        bar.set_message(message);
        bar.set_position(before + done as u64);
    });
    bar.finish_and_clear();
    let surveyed = surveyed.map_err(|error| failed(file, error))?;
    warn(file, &surveyed.warnings());
    Ok(surveyed)
}

fn read_log(file: &Path) -> Result<LaserLog, Failure> {
    let unreadable = |error| Failure::ReadLog { file: file.to_owned(), error: Box::new(error) };
    let source: Box<dyn Read> = if file.as_os_str() == "-" {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(File::open(file).map_err(|error| unreadable(LogError::Read { line: 0, error }))?)
    };
    LaserLog::read(source).map_err(unreadable)
}

pub(crate) fn failed(file: &Path, error: SurveyError) -> Failure {
    Failure::Survey { file: file.to_owned(), error: Box::new(error) }
}

/// Says warnings on standard error.
pub(crate) fn warn(file: &Path, warnings: &[AnswerWarning]) {
    let mut out = std::io::stderr().lock();
    for warning in warnings {
        let _ = writeln!(out, "warning: {}: {warning}", file.display());
    }
}
