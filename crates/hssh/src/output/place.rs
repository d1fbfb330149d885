//! Whether results can be written where they are to go, before the work for them is done.

use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Refuses outputs that would overwrite an input or each other, or that cannot be written.
pub(crate) fn check_outputs<'a>(
    inputs: &[&Path],
    outputs: impl IntoIterator<Item = Option<&'a PathBuf>>,
) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.into_iter().flatten().map(PathBuf::as_path).collect();
    for (index, output) in outputs.iter().enumerate() {
        inputs.iter().try_for_each(|input| refuse_input(input, output))?;
        if let Some(other) = outputs[..index].iter().find(|other| is_same(output, other)) {
            return Err(Failure::SameOutput { file: output.to_path_buf(), other: other.to_path_buf() });
        }
        writable(output).map_err(|error| Failure::Write { file: output.to_path_buf(), error })?;
    }
    Ok(())
}

/// Refuses to write where the input is.
pub(crate) fn refuse_input(input: &Path, output: &Path) -> Result<(), Failure> {
    match is_same(input, output) {
        true => Err(Failure::OverInput { file: output.to_owned(), input: input.to_owned() }),
        false => Ok(()),
    }
}

/// Refuses a folder for outputs that cannot be made.
pub(crate) fn check_folder(folder: Option<&PathBuf>) -> Result<(), Failure> {
    let Some(folder) = folder else { return Ok(()) };
    fs::create_dir_all(folder).map_err(|error| Failure::Write { file: folder.clone(), error })
}

/// Whether two paths lead to one file, through links or not. Devices take what several write.
fn is_same(one: &Path, other: &Path) -> bool {
    let is_device = fs::metadata(one).is_ok_and(|known| !known.is_file());
    let known = [one, other].map(identity);
    !is_device && ((known[0].is_some() && known[0] == known[1]) || place(one) == place(other))
}

/// Device and number of a file that is there.
#[cfg(unix)]
fn identity(file: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(file).ok().map(|known| (known.dev(), known.ino()))
}

#[cfg(not(unix))]
fn identity(_: &Path) -> Option<(u64, u64)> {
    None
}

/// The folder as it is really called, and the name in it, of a file that may not be there yet.
fn place(file: &Path) -> (PathBuf, OsString) {
    if let Ok(file) = fs::canonicalize(file) {
        let name = file.file_name().unwrap_or_default().to_owned();
        return (folder(&file), name);
    }
    let folder = folder(file);
    (fs::canonicalize(&folder).unwrap_or(folder), file.file_name().unwrap_or_default().to_owned())
}

fn folder(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Tries whether a file can be written, and leaves everything as it was.
fn writable(file: &Path) -> io::Result<()> {
    if let Ok(known) = fs::metadata(file) {
        if known.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if !known.is_file() {
            return Ok(()); // to open a pipe may wait for its reader
        }
        return OpenOptions::new().append(true).open(file).map(drop);
    }
    let folder = folder(file);
    if !folder.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::NotFound,
            format!("there is no folder {}", folder.display()),
        ));
    }
    OpenOptions::new().write(true).create_new(true).open(file)?;
    fs::remove_file(file)
}
