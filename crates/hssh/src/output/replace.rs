//! Replaces a file by another content in one step, so that a full disk or the end of the program leaves no half a file.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes all of a file beside it and renames it. What is no file (a terminal, a pipe) is written to directly, and so is
/// a file in a folder where nothing new may be made.
pub(super) fn replace(file: &Path, bytes: &[u8]) -> io::Result<()> {
    // Behind a link, the file that it leads to is replaced, and not the link.
    let file = fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
    let known = fs::metadata(&file).ok();
    if known.as_ref().is_some_and(|known| !known.is_file()) {
        return fs::write(&file, bytes);
    }
    let beside = beside(&file);
    let Ok(new) = File::create_new(&beside) else { return fs::write(&file, bytes) };
    let written = fill(new, bytes).and_then(|()| {
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

fn fill(mut new: File, bytes: &[u8]) -> io::Result<()> {
    new.write_all(bytes)?;
    new.sync_all()
}

/// A name in the same folder that nothing else has.
fn beside(file: &Path) -> PathBuf {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!(".{name}.{}.part", std::process::id()))
}
