//! `hssh export`: a map of an answer, or the ways of a grid map, as other programs read them; and the same beside an answer.

use std::path::Path;

use hssh::account::PlacesAccount;
use hssh::answer::Answer;
use hssh::export::{ExportError, ExportKind, Exported, export_map, export_places};
use hssh::kind::FileKind;
use hssh::pipeline::{Input, Mapped, PipelineError};
use hssh_local::RegionMap;
use hssh_metrics::GraphFile;

use crate::arguments::{ExportArguments, FilesArguments};
use crate::failure::{Failure, Status};
use crate::input::Source;
use crate::output::{Written, check_outputs, print, to_tum, write_bytes, write_file};
use crate::terminal::say;

pub(crate) fn run(arguments: &ExportArguments) -> Result<Status, Failure> {
    let ExportArguments { answer: file, to: kind, output, rank, spacing } = arguments;
    check_outputs(&[file], [output.as_ref()])?;
    let source = Source::open(file)?;
    let spacing = spacing.choice();
    let refused = |error| Failure::Export { file: file.clone(), error };
    let unread = |error: &dyn std::fmt::Display| Failure::Usage(format!("{}: {error}", file.display()));
    let exported = match source.kind() {
        FileKind::Written(format) if format == Answer::FORMAT => {
            let answer = Answer::from_json(&text(file, source)?).map_err(|error| unread(&error))?;
            export_map(&answer, rank.map(|rank| rank as usize), *kind, spacing)
        }
        FileKind::Written(format) if format == PlacesAccount::FORMAT && rank.is_some() => {
            return Err(unread(
                &"--rank is of the maps of an answer: the places of a grid map have no ranking",
            ));
        }
        FileKind::Written(format) if format == PlacesAccount::FORMAT => {
            let account = PlacesAccount::from_json(&text(file, source)?).map_err(|error| unread(&error))?;
            export_places(&account, *kind, spacing)
        }
        _ => {
            return Err(source
                .unfit("an answer, which `hssh map --json` or `hssh stars --json` prints")
                .into());
        }
    };
    let exported = exported.map_err(refused)?;
    warn(file, *kind, &exported);
    match output {
        Some(output) => write_file(output, &exported.text)?,
        None => print(&exported.text)?,
    }
    Ok(Status::Found)
}

/// A whole file as text.
fn text(file: &Path, source: Source) -> Result<String, Failure> {
    let unreadable = |_| Failure::Usage(format!("{}: the text is not UTF-8", file.display()));
    String::from_utf8(source.into_bytes()?).map_err(unreadable)
}

/// Says what whoever uses the file should know.
fn warn(input: &Path, kind: ExportKind, exported: &Exported) {
    for warning in &exported.warnings {
        say(&format!("warning: {}: {kind} of a map that may be wrong: {warning}", input.display()));
    }
}

/// Refuses kinds that cannot be had, before the work begins: those that are not of `maps`, or else not of grid maps.
pub(crate) fn refuse_unfit(files: &FilesArguments, maps: bool) -> Result<(), Failure> {
    let unfit = files.export.iter().find_map(|(kind, file)| {
        let kind = *kind;
        let error = match maps {
            true if !kind.is_of_maps() => ExportError::OfGridMaps { kind },
            false if !kind.is_of_grids() => ExportError::OfLogs { kind },
            _ => return None,
        };
        Some(Failure::Export { file: file.clone(), error })
    });
    unfit.map_or(Ok(()), Err)
}

/// Writes the files for other programs that were asked for beside an answer.
pub(crate) fn write_maps(
    file: &Path,
    files: &FilesArguments,
    rank: Option<u32>,
    (input, mapped): (&Input, &Mapped),
    written: &mut Written,
) {
    let rank = rank.map(|rank| rank as usize);
    for (kind, output) in &files.export {
        let text = match kind {
            ExportKind::Tum => trajectory(input, mapped, rank.unwrap_or(1)),
            ExportKind::G2o => pose_graph(input, mapped, rank.unwrap_or(1)),
            _ => export_map(&mapped.answer, rank, *kind, files.spacing.choice())
                .inspect(|exported| warn(file, *kind, exported))
                .map(|exported| exported.text)
                .map_err(|error| Failure::Export { file: output.clone(), error }),
        };
        written.note(text.and_then(|text| write_file(output, &text)));
    }
}

/// When every scan was taken and where.
fn trajectory(input: &Input, mapped: &Mapped, rank: usize) -> Result<String, Failure> {
    Ok(to_tum(&mapped.trajectory(input, rank).ok_or(PipelineError::NoScans)?))
}

/// The pose graph of a map: of a log all scans.
fn pose_graph(input: &Input, mapped: &Mapped, rank: usize) -> Result<String, Failure> {
    let graph = mapped.scan_graph(input, rank).or_else(|| mapped.pose_graph(rank).cloned());
    Ok(GraphFile::from(graph.ok_or(Failure::NoOdometry)?).to_g2o())
}

/// Writes the files for other programs that were asked for of a grid map.
pub(crate) fn write_places(
    files: &FilesArguments,
    map: &RegionMap,
    account: &PlacesAccount,
) -> Result<(), Failure> {
    let mut written = Written::default();
    for (kind, output) in &files.export {
        let refused = |error: ExportError| Failure::Export { file: output.clone(), error };
        written.note(match kind {
            ExportKind::Labels => write_bytes(output, &map.encode_png()),
            _ => export_places(account, *kind, files.spacing.choice())
                .map_err(refused)
                .and_then(|exported| write_file(output, &exported.text)),
        });
    }
    written.done()
}
