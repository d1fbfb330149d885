//! The file in which hypotheses wait for which memory has no room.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use hssh::pipeline::Store;

use crate::failure::Failure;
use crate::terminal::say;

/// Pages begin at multiples of so many bytes, and take as many times as much as a power of two.
const SLOT: u64 = 4096;

/// A file without a name: it is gone when the program is, however that ends.
#[derive(Debug)]
pub(crate) struct SpillFile {
    path: PathBuf,
    pages: Mutex<Pages>,
}

#[derive(Debug)]
struct Pages {
    file: File,
    /// Where the file ends.
    end: u64,
    /// By offset: how many bytes the page there has.
    lengths: BTreeMap<u64, u64>,
    /// By the bytes of a slot: where one is free.
    free: BTreeMap<u64, Vec<u64>>,
    /// Whether it was said that no more can be written.
    is_full: bool,
}

impl SpillFile {
    /// In that folder.
    ///
    /// # Errors
    /// If no file can be made there.
    pub(crate) fn in_folder(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join(format!(".hssh-spill.{}", std::process::id()));
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(&path);
        let file = file.map_err(|error| Failure::Write { file: path.clone(), error })?;
        // Where an open file keeps its name, the end of the program removes it.
        let _ = fs::remove_file(&path);
        let pages = Pages { file, end: 0, lengths: BTreeMap::new(), free: BTreeMap::new(), is_full: false };
        Ok(SpillFile { path, pages: Mutex::new(pages) })
    }

    fn pages(&self) -> MutexGuard<'_, Pages> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for SpillFile {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

fn slot(length: u64) -> u64 {
    length.div_ceil(SLOT).next_power_of_two() * SLOT
}

impl Pages {
    fn keep(&mut self, page: &[u8]) -> io::Result<u64> {
        let length = page.len() as u64;
        let slot = slot(length);
        let free = self.free.get_mut(&slot).and_then(Vec::pop);
        let number = free.unwrap_or(self.end);
        self.file.seek(SeekFrom::Start(number))?;
        if let Err(error) = self.file.write_all(page) {
            if free.is_some() {
                self.free.entry(slot).or_default().push(number);
            }
            return Err(error);
        }
        self.end = self.end.max(number + slot);
        self.lengths.insert(number, length);
        Ok(number)
    }
}

impl Store for SpillFile {
    fn keep(&self, page: &[u8]) -> io::Result<u64> {
        let mut pages = self.pages();
        let kept = pages.keep(page);
        if let Err(error) = &kept
            && !std::mem::replace(&mut pages.is_full, true)
        {
            say(&format!(
                "warning: cannot write to {}: {error}; the search goes on in memory, until that is used up",
                self.path.display()
            ));
        }
        kept
    }

    fn page(&self, number: u64) -> io::Result<Vec<u8>> {
        let mut pages = self.pages();
        let length = pages.lengths.get(&number).copied().ok_or(io::ErrorKind::NotFound)?;
        let mut page = vec![0; usize::try_from(length).map_err(io::Error::other)?];
        pages.file.seek(SeekFrom::Start(number))?;
        pages.file.read_exact(&mut page)?;
        Ok(page)
    }

    fn drop_page(&self, number: u64) {
        let mut pages = self.pages();
        if let Some(length) = pages.lengths.remove(&number) {
            pages.free.entry(slot(length)).or_default().push(number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_come_back_as_they_were_and_their_room_is_used_again() {
        let folder = std::env::temp_dir();
        let file = SpillFile::in_folder(&folder).unwrap();
        let page = |number: u8| vec![number; 3000 + 2000 * usize::from(number % 4)];
        let kept: Vec<u64> = (0..40).map(|number| file.keep(&page(number)).unwrap()).collect();
        let end = file.pages().end;
        for round in 0..3 {
            for (number, &at) in (0..).zip(&kept).filter(|(number, _)| number % 3 == round) {
                assert_eq!(file.page(at).unwrap(), page(number));
                file.drop_page(at);
                assert!(file.page(at).is_err());
                assert_eq!(file.page(file.keep(&page(number)).unwrap()).unwrap(), page(number));
            }
        }
        assert_eq!(file.pages().end, end);
        let left = std::fs::read_dir(&folder).unwrap().filter_map(Result::ok);
        let own = format!(".hssh-spill.{}", std::process::id());
        assert!(left.into_iter().all(|entry| entry.file_name().to_string_lossy() != own));
    }
}
