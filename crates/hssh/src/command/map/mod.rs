//! `hssh map`: the maps that explain an exploration or a log, ranked and drawn.

mod draw;
#[cfg(not(feature = "cluster"))]
#[path = "alone.rs"]
mod processes;
#[cfg(feature = "cluster")]
mod processes;
mod search;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use hssh::answer::Listing;
use hssh::pipeline::{
    Checkpoints, Input, Keeper, Mapped, MappingOptions, Means, PipelineError, SearchMethod, Store,
    SurveyedLog,
};

use crate::arguments::MapArguments;
use crate::command::export::write_maps;
use crate::command::page;
use crate::command::stages::draw_survey;
use crate::failure::{Failure, Status};
use crate::input::{read_input, refuse_partial};
use crate::output::{CheckpointFile, SpillFile, Written, print, write_file};

pub(crate) use processes::is_spread;
pub(crate) use search::searched;

pub(crate) fn run(arguments: &MapArguments) -> Result<Status, Failure> {
    if processes::is_helper(arguments) {
        return help(arguments);
    }
    let options = checked_options(arguments)?;
    let input = read_input(&arguments.file, &options, &arguments.laser.topics)?;
    answer(arguments, &input, &options, |_| ())
}

/// The options, if what is asked for can be done with them.
pub(crate) fn checked_options(arguments: &MapArguments) -> Result<MappingOptions, Failure> {
    let options = arguments.options()?;
    if options.search.method == Some(SearchMethod::Count) && draw::is_asked(arguments) {
        let help = "counting keeps no maps to draw: choose another --search for pictures";
        return Err(Failure::Usage(help.to_owned()));
    }
    draw::check(arguments)?;
    if let (Some(rank), Some(listed)) = (arguments.rank, options.listed)
        && rank as usize > listed
    {
        return Err(Failure::Usage(format!(
            "--rank {rank} is not among the {listed} maps that are listed: add --top {rank}, or --all"
        )));
    }
    Ok(options)
}

/// Maps an input, prints the answer and writes what was asked for; `show` is given it before.
pub(crate) fn answer(
    arguments: &MapArguments,
    input: &Input,
    options: &MappingOptions,
    show: impl FnOnce(&Mapped),
) -> Result<Status, Failure> {
    if arguments.strict {
        refuse_partial(&arguments.file, input.as_surveyed())?;
    }
    match (input.as_surveyed(), &arguments.debug_dir) {
        (None, _) => refuse_what_needs_a_log(arguments)?,
        (Some(surveyed), Some(folder)) => draw_survey(&surveyed.log, &surveyed.survey, folder)?,
        (Some(_), None) => {}
    }
    let names = arguments.checkpoint.as_deref().map(checkpoint_files);
    let files = names.as_ref().map(|names| names.each_ref().map(|name| Arc::new(CheckpointFile::new(name))));
    let mapped = processes::spread(arguments, input, options, means(arguments, files.as_ref())?);
    let mut mapped = mapped.map_err(|failure| failure.of_checkpoint(names.as_ref()))?;
    if arguments.with_trajectory {
        mapped.carry_trajectories(input);
    }
    show(&mapped);
    // An answer that took long is printed all the same.
    let no_such_rank = arguments
        .rank
        .filter(|&rank| mapped.answer.map(rank as usize).is_none())
        .map(|asked| Failure::NoSuchRank { asked, found: mapped.answer.maps.len() });
    if let Some(refusal) = &no_such_rank {
        refusal.print();
    }
    print(&match arguments.json {
        true => mapped.answer.to_json(),
        false => {
            let partial = input.as_surveyed().and_then(SurveyedLog::partial);
            let first = partial.map(|partial| format!("PARTIAL: {partial}\n")).unwrap_or_default();
            first + &mapped.answer.to_text(Listing { levels: arguments.levels, flags: true })
        }
    })?;
    let mut written = Written::default();
    if let Some(file) = &arguments.certificate {
        let certificate = mapped.certificate(input).ok_or(Failure::NothingProved);
        written.note(certificate.and_then(|certificate| write_file(file, &certificate)));
    }
    if let (Some(file), Some(exploration)) = (&arguments.corrected, mapped.corrected()) {
        written.note(write_file(file, &exploration.to_ron()));
    }
    if no_such_rank.is_some() {
        return Ok(Status::Refused);
    }
    if let Some(file) = &arguments.page.html {
        written.note(page::write(file, input, &mapped, options, arguments.rank));
    }
    draw::draw(arguments, input, &mapped, &mut written)?;
    write_maps(&arguments.file, &arguments.files, arguments.rank, (input, &mapped), &mut written);
    let is_complete = mapped.answer.search.stop.is_complete();
    for file in files.into_iter().flatten() {
        written.note(if is_complete { file.remove() } else { file.leave() });
    }
    written.done()?;
    Ok(Status::of(&mapped.answer))
}

/// Where the search is kept, and the search for readings that comes before it: in a file beside that.
fn checkpoint_files(file: &Path) -> [PathBuf; 2] {
    let mut readings = file.as_os_str().to_owned();
    readings.push(".readings");
    [file.to_owned(), readings.into()]
}

/// How the search is kept, and what does not fit into memory, as far as that was asked for.
fn means(
    arguments: &MapArguments,
    files: Option<&[Arc<CheckpointFile>; 2]>,
) -> Result<Means<'static>, Failure> {
    let every = Duration::try_from_secs_f64(arguments.checkpoint_every).unwrap_or(Duration::MAX);
    let [checkpoints, reading_checkpoints] = match files {
        Some(files) => files.each_ref().map(|file| {
            let keeper = Arc::clone(file) as Arc<dyn Keeper>;
            Some(Checkpoints { keeper, every })
        }),
        None => [None, None],
    };
    let store = match &arguments.spill {
        Some(folder) => Some(Arc::new(SpillFile::in_folder(folder)?) as Arc<dyn Store>),
        None => None,
    };
    Ok(Means { checkpoints, reading_checkpoints, store, searchers: None })
}

/// Takes part in a search whose answer another process gives.
fn help(arguments: &MapArguments) -> Result<Status, Failure> {
    let options = arguments.options()?;
    let input = read_input(&arguments.file, &options, &arguments.laser.topics)?;
    match processes::spread(arguments, &input, &options, Means::default()) {
        Err(Failure::Pipeline(error)) if matches!(*error, PipelineError::AnsweredElsewhere) => {
            Ok(Status::Found)
        }
        Err(failure) => Err(failure),
        Ok(_) => Ok(Status::Found),
    }
}

fn refuse_what_needs_a_log(arguments: &MapArguments) -> Result<(), Failure> {
    let is_asked = arguments.grid.is_some()
        || arguments.trajectory.is_some()
        || arguments.likeness.is_some()
        || arguments.with_trajectory
        || arguments.debug_dir.is_some();
    let laser = &arguments.laser;
    if is_asked
        || !arguments.places.choice().is_usual()
        || !laser.choice().is_usual()
        || laser.topics.choice().is_given()
    {
        let help = "--grid, --trajectory, --likeness, --debug-dir, --with-trajectory, --fov, --laser-pose, --scan, --odom, --base-frame and what counts as a place need a laser log: an exploration has no scans";
        return Err(Failure::Usage(help.to_owned()));
    }
    Ok(())
}
