//! Replaces a file by another content in one step, so that a full disk or the end of the program leaves no half a file.

use std::fs::{self, DirEntry, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Who writes a file writes to it more often than that.
const ABANDONED: Duration = Duration::from_secs(600);

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
    match written {
        Ok(()) => remove_abandoned(&file),
        Err(_) => drop(fs::remove_file(&beside)),
    }
    written
}

/// Removes what programs that were killed while they wrote the same file have left beside it.
fn remove_abandoned(file: &Path) {
    let Some(folder) = file.parent() else { return };
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let is_part = |entry: &DirEntry| {
        let entry = entry.file_name();
        let entry = entry.to_string_lossy();
        let number = entry.strip_prefix(&format!(".{name}.")).and_then(|rest| rest.strip_suffix(".part"));
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    let is_abandoned = |entry: &DirEntry| {
        let idle = entry.metadata().and_then(|known| known.modified()).map(|at| at.elapsed());
        matches!(idle, Ok(Ok(idle)) if idle > ABANDONED)
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for part in entries.filter(is_part).filter(is_abandoned) {
        let _ = fs::remove_file(part.path());
    }
}

/// A name in the same folder that nothing else has.
fn beside(file: &Path) -> PathBuf {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

    use super::*;

    #[test]
    fn what_a_killed_program_left_beside_a_file_goes_with_the_next_writing() {
        let folder = std::env::temp_dir().join(format!("hssh-parts-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let at = |name: &str| folder.join(name);
        let [old, recent, other] =
            [".run.ckpt.4000000000.part", ".run.ckpt.4000000001.part", ".run.ckpt.notes.part"].map(at);
        for part in [&old, &recent, &other] {
            let file = File::create(part).expect("a file");
            let is_recent = part == &recent;
            let age = if is_recent { Duration::ZERO } else { 2 * ABANDONED };
            file.set_modified(SystemTime::now() - age).expect("its time");
        }
        replace(&at("run.ckpt"), |file| file.write_all(b"all")).expect("written");
        assert_eq!(fs::read(at("run.ckpt")).expect("read"), b"all");
        assert_eq!([&old, &recent, &other].map(|part| part.exists()), [false, true, true]);
        fs::remove_dir_all(folder).expect("removed");
    }
}
