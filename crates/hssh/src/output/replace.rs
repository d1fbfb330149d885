//! Replaces a file by another content in one step, so that a full disk or the end of the program leaves no half a file.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes all of a file beside it and renames it. What is no file (a terminal, a pipe) is written to directly, and so is
/// a file in a folder where nothing new may be made.
pub(super) fn replace(
    file: &Path,
    mut write: impl FnMut(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // Behind a link, the file that it leads to is replaced, and not the link.
    let file = fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
    let known = fs::metadata(&file).ok();
    if known.as_ref().is_some_and(|known| !known.is_file()) {
        return write(&mut File::create(&file)?);
    }
    let beside = beside(&file);
    let Ok(mut new) = File::create_new(&beside) else { return write(&mut File::create(&file)?) };
    let written = write(&mut new).and_then(|()| new.sync_all()).and_then(|()| {
        if let Some(known) = known {
            fs::set_permissions(&beside, known.permissions())?;
        }
        fs::rename(&beside, &file)
    });
    if written.is_err() {
        let _ = fs::remove_file(&beside);
    }
    written
}

/// A name in the same folder that nothing else has.
fn beside(file: &Path) -> PathBuf {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!(".{name}.{}.part", std::process::id()))
}
