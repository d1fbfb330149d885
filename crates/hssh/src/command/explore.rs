//! `hssh explore`: from a laser log to an exploration.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::time::Duration;

use hssh_local::{LaserLog, LogError, Survey, SurveyError, SurveyOptions, SurveyStage, Visit, survey};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::stages::draw_survey;
use crate::arguments::ExploreOptions;
use crate::failure::{Failure, Status};
use crate::output::{counted, print, write_file};

/// More warnings than this of one kind are only counted.
const MOST_WARNINGS: usize = 10;

pub(crate) fn run(options: &ExploreOptions) -> Result<Status, Failure> {
    let log = read_log(&options.log)?;
    let survey = surveyed(&options.log, &log, &options.places.along_logs())?;
    let exploration = survey.exploration().map_err(|error| failed(&options.log, error))?;
    if let Some(folder) = &options.debug_dir {
        draw_survey(&log, &survey, folder)?;
    }
    match &options.output {
        Some(file) => {
            write_file(file, &exploration.to_ron())?;
            print(&account(&options.log, &log, &survey))?;
        }
        None => print(&exploration.to_ron())?,
    }
    Ok(Status::Found)
}

/// A CARMEN log, plain or gzip; warnings go to standard error.
pub(crate) fn read_log(file: &Path) -> Result<LaserLog, Failure> {
    let unreadable = |error| Failure::ReadLog { file: file.to_owned(), error: Box::new(error) };
    let source: Box<dyn std::io::Read> = if file.as_os_str() == "-" {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(File::open(file).map_err(|error| unreadable(LogError::Read { line: 0, error }))?)
    };
    let log = LaserLog::read(source).map_err(unreadable)?;
    warn(file, &log.warnings);
    Ok(log)
}

/// The survey of a log, with a progress bar on standard error; warnings go there, too.
pub(crate) fn surveyed(file: &Path, log: &LaserLog, options: &SurveyOptions) -> Result<Survey, Failure> {
    let scans = log.scans.len() as u64;
    let bar = ProgressBar::with_draw_target(Some(2 * scans), ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {bar:30} {percent}%  {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    let found = survey(log, options, |stage, done| {
        let (message, before) = match stage {
            SurveyStage::Tracking => ("matching scans", 0),
            SurveyStage::Looking => ("looking for places", scans),
        };
        bar.set_message(message);
        bar.set_position(before + done as u64);
    });
    bar.finish_and_clear();
    let found = found.map_err(|error| failed(file, error))?;
    warn(file, &found.warnings);
    Ok(found)
}

pub(crate) fn failed(file: &Path, error: SurveyError) -> Failure {
    Failure::Survey { file: file.to_owned(), error: Box::new(error) }
}

fn warn(file: &Path, warnings: &[impl std::fmt::Display]) {
    let mut out = std::io::stderr().lock();
    for warning in warnings.iter().take(MOST_WARNINGS) {
        let _ = writeln!(out, "warning: {}: {warning}", file.display());
    }
    if warnings.len() > MOST_WARNINGS {
        let more = counted(warnings.len() - MOST_WARNINGS, "more warning");
        let _ = writeln!(out, "warning: {}: {more}", file.display());
    }
}

/// What was found, in words.
fn account(file: &Path, log: &LaserLog, survey: &Survey) -> String {
    let way = survey.track.scans.last().map_or(0.0, |scan| scan.travelled);
    let mut text = format!(
        "{}: {} of {} beams, {way:.0} m; {}\n",
        file.display(),
        counted(log.scans.len(), "scan"),
        log.beams(),
        counted(survey.visits.len(), "visit")
    );
    for (number, visit) in survey.visits.iter().enumerate() {
        text += &sentence(number, visit);
        if let Some(travel) = survey.travels.get(number) {
            text += &format!(", {:.1} m to the next\n", travel.mean.translation().norm());
        } else {
            text += "\n";
        }
    }
    text
}

fn sentence(number: usize, visit: &Visit) -> String {
    let name = |end: Option<hssh_topology::Olp>, verb: &str| {
        end.map_or_else(String::new, |end| format!(", {verb} by {}", visit.star.star.name(end)))
    };
    let (first, last) = visit.scans;
    format!(
        "{:>4}. scans {} to {}: {}{}{}",
        number + 1,
        first + 1,
        last + 1,
        visit.star.star,
        name(visit.entry, "in"),
        name(visit.exit, "out")
    )
}
