//! Reading what maps are to explain: explorations and laser logs.

use std::path::Path;
use std::time::Duration;

use hssh::answer::AnswerWarning;
use hssh::file::{self, ReadLog};
use hssh::kind::FileKind;
use hssh::pipeline::{Input, LaserChoice, MappingOptions, SurveyedLog, TrackedLog};
use hssh_causal::Exploration;
use hssh_local::{
    LaserLog, MatchOptions, OccupancyGrid, Reply, SurveyError, SurveyStage, read_map_with_remarks,
};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::arguments::TopicArguments;
use crate::failure::Failure;
use crate::progress::{is_interrupted, keep_on_signals};
use crate::terminal::say;

pub(crate) use hssh::file::Source;

/// An exploration, or a laser log with what is found in it; `-` is standard input.
pub(crate) fn read_input(
    file: &Path,
    options: &MappingOptions,
    topics: &TopicArguments,
) -> Result<Input, Failure> {
    let name = file.display().to_string();
    let source = Source::open(file)?;
    match source.kind() {
        FileKind::LaserLog(_) | FileKind::Recording(_) | FileKind::Table | FileKind::JsonLines => {
            let surveyed = surveyed(file, source, options, topics)?;
            Input::surveyed(name, surveyed).map_err(|error| failed(file, error))
        }
        FileKind::Exploration | FileKind::Text | FileKind::Empty => {
            Ok(Input::exploration(name, file::read_exploration(file, source)?))
        }
        _ => Err(source.unfit("an exploration or a laser log").into()),
    }
}

/// The exploration in a file, or on standard input if the path is `-`.
pub(crate) fn read_exploration(file: &Path) -> Result<Exploration, Failure> {
    Ok(file::read_exploration(file, Source::open(file)?)?)
}

/// The laser log in a file, and the places along it.
pub(crate) fn read_surveyed(
    file: &Path,
    options: &MappingOptions,
    topics: &TopicArguments,
) -> Result<SurveyedLog, Failure> {
    surveyed(file, open_log(file)?, options, topics)
}

/// What is in a file, if it may be a laser log.
fn open_log(file: &Path) -> Result<Source, Failure> {
    let source = Source::open(file)?;
    match source.kind() {
        FileKind::LaserLog(_)
        | FileKind::Recording(_)
        | FileKind::Table
        | FileKind::JsonLines
        | FileKind::Text
        | FileKind::Empty => Ok(source),
        _ => Err(source.unfit("a laser log").into()),
    }
}

/// The log in a file that was opened. What is used of a bag goes to standard error.
fn read_log(
    file: &Path,
    source: Source,
    laser: &LaserChoice,
    topics: &TopicArguments,
) -> Result<LaserLog, Failure> {
    let ReadLog { log, used } = file::read_log(file, source, laser, &topics.choice())?;
    for used in used {
        say(&format!("{}: {used}", file.display()));
    }
    Ok(log)
}

/// The laser log in a file, tracked scan by scan; warnings go to standard error.
pub(crate) fn read_tracked(
    file: &Path,
    laser: &LaserChoice,
    topics: &TopicArguments,
    options: &MatchOptions,
) -> Result<TrackedLog, Failure> {
    let source = open_log(file)?;
    keep_on_signals();
    let log = read_log(file, source, laser, topics)?;
    let bar = progress_bar(log.scans.len() as u64);
    bar.set_message("matching scans");
    let tracked = TrackedLog::new(log, options, |done| {
        bar.set_position(done as u64);
        if is_interrupted() { Reply::Stop } else { Reply::GoOn }
    });
    bar.finish_and_clear();
    warn(file, &tracked.warnings());
    Ok(tracked)
}

/// Shows on standard error how much is done.
pub(crate) fn progress_bar(length: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {bar:30} {percent}%  {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// A laser log and the places along it, with a progress bar on standard error; warnings go there, too.
pub(crate) fn surveyed(
    file: &Path,
    source: Source,
    options: &MappingOptions,
    topics: &TopicArguments,
) -> Result<SurveyedLog, Failure> {
    keep_on_signals();
    let log = read_log(file, source, &options.laser, topics)?;
    let scans = log.scans.len() as u64;
    let bar = progress_bar(3 * scans);
    let surveyed = SurveyedLog::new(log, options, |stage, done| {
        let (message, before) = match stage {
            SurveyStage::Tracking => ("matching scans", 0),
            SurveyStage::Closing => ("closing loops", scans),
            SurveyStage::Looking => ("looking for places", 2 * scans),
        };
        bar.set_message(message);
        bar.set_position(before + done as u64);
        if is_interrupted() { Reply::Stop } else { Reply::GoOn }
    });
    bar.finish_and_clear();
    let surveyed = surveyed.map_err(|error| failed(file, error))?;
    warn(file, &surveyed.warnings());
    Ok(surveyed)
}

/// Refuses a log of which a part is missing from what is made of it.
pub(crate) fn refuse_partial(file: &Path, surveyed: Option<&SurveyedLog>) -> Result<(), Failure> {
    let lost = surveyed.and_then(SurveyedLog::first_loss);
    lost.map_or(Ok(()), |lost| Err(Failure::Partial { file: file.to_owned(), lost }))
}

/// A grid map by its YAML file; what is read otherwise than it says goes to standard error.
pub(crate) fn read_grid(yaml: &Path) -> Result<OccupancyGrid, Failure> {
    let (grid, remarks) = read_map_with_remarks(yaml)?;
    for remark in remarks {
        say(&format!("warning: {remark}"));
    }
    Ok(grid)
}

pub(crate) fn failed(file: &Path, error: SurveyError) -> Failure {
    Failure::Survey { file: file.to_owned(), error: Box::new(error) }
}

/// Says warnings on standard error.
pub(crate) fn warn(file: &Path, warnings: &[AnswerWarning]) {
    for warning in warnings {
        say(&format!("warning: {}: {warning}", file.display()));
    }
}
