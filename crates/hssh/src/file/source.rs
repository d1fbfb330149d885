//! Opens a file or standard input: takes off compression and byte order marks, and says what it holds.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use flate2::bufread::MultiGzDecoder;

use super::error::FileError;
use crate::kind::FileKind;

/// So much of a file is looked at to say what it is.
const LOOKED_AT: u64 = 1 << 16;
/// What is read as a whole may be so large: a hundred thousand travels take a sixth of it.
const LARGEST_TEXT: u64 = 1 << 26;

/// How a file begins that gzip compressed.
const GZIP: &[u8] = &[0x1F, 0x8B];
const UTF8_MARK: &[u8] = b"\xEF\xBB\xBF";
const UTF16_MARKS: [&[u8]; 2] = [b"\xFF\xFE", b"\xFE\xFF"];

/// What is in a file, to be read from its beginning.
pub struct Source {
    file: PathBuf,
    kind: FileKind,
    /// Whether the content is that of the file as it is.
    #[cfg_attr(not(feature = "bags"), expect(dead_code, reason = "only bags are opened once more"))]
    is_plain: bool,
    content: Box<dyn BufRead>,
}

impl Source {
    /// Opens a file; `-` is standard input.
    ///
    /// # Errors
    /// If it cannot be read, or is compressed by something else than gzip.
    pub fn open(file: &Path) -> Result<Self, FileError> {
        let unreadable = |error| FileError::Read { file: file.to_owned(), error };
        if file.is_dir() {
            let kind = FileKind::Recording("a folder, perhaps a ROS 2 bag");
            return Ok(Source {
                file: file.to_owned(),
                kind,
                is_plain: true,
                content: Box::new(io::empty()),
            });
        }
        let mut is_plain = file.as_os_str() != "-";
        let mut bytes: Box<dyn BufRead> = if file.as_os_str() == "-" {
            Box::new(BufReader::new(io::stdin()))
        } else {
            Box::new(BufReader::with_capacity(LOOKED_AT as usize, File::open(file).map_err(unreadable)?))
        };
        if bytes.fill_buf().map_err(unreadable)?.starts_with(GZIP) {
            bytes = Box::new(BufReader::with_capacity(LOOKED_AT as usize, MultiGzDecoder::new(bytes)));
            is_plain = false;
        }
        let mut beginning = Vec::new();
        let read = bytes.by_ref().take(LOOKED_AT).read_to_end(&mut beginning);
        // What is wrong behind the beginning is for those who read on.
        let rest: Box<dyn BufRead> = match read {
            Ok(_) => bytes,
            Err(error) if beginning.is_empty() => {
                return Err(FileError::Damaged { file: file.to_owned(), error });
            }
            Err(error) => Box::new(BufReader::new(Broken(Some(error)))),
        };
        if let Some(mark) = UTF16_MARKS.iter().position(|mark| beginning.starts_with(mark)) {
            let mut whole = beginning;
            rest.take(LARGEST_TEXT).read_to_end(&mut whole).map_err(unreadable)?;
            let text = from_utf16(&whole[2..], mark == 1);
            let kind = FileKind::of(text.as_bytes());
            return Ok(Source {
                file: file.to_owned(),
                kind,
                is_plain: false,
                content: Box::new(Cursor::new(text.into_bytes())),
            });
        }
        if beginning.starts_with(UTF8_MARK) {
            beginning.drain(..UTF8_MARK.len());
        }
        let mut kind = FileKind::of(&beginning);
        if matches!(kind, FileKind::Compressed("zstd", _)) && is_plain && is_packed_bag(file) {
            kind = FileKind::Recording("a bag packed by zstd");
        }
        if let FileKind::Compressed(..) = kind {
            return Err(FileError::Compressed { file: file.to_owned(), kind });
        }
        Ok(Source {
            file: file.to_owned(),
            kind,
            is_plain,
            content: Box::new(Cursor::new(beginning).chain(rest)),
        })
    }

    /// What it holds.
    #[must_use]
    pub fn kind(&self) -> &FileKind {
        &self.kind
    }

    /// Whether the content is that of the file as it is: neither unpacked nor from standard input.
    #[cfg(feature = "bags")]
    pub(super) fn is_plain(&self) -> bool {
        self.is_plain
    }

    /// The error for whoever wanted something else.
    #[must_use]
    pub fn unfit(&self, wanted: &'static str) -> FileError {
        FileError::Kind { file: self.file.clone(), kind: self.kind.clone(), wanted }
    }

    /// The content, to be read once.
    #[must_use]
    pub fn into_content(self) -> Box<dyn BufRead> {
        self.content
    }

    /// The whole content.
    ///
    /// # Errors
    /// If it cannot be read to its end, or is longer than any text that is read as a whole.
    pub fn into_bytes(self) -> Result<Vec<u8>, FileError> {
        let mut bytes = Vec::new();
        let read = self.content.take(LARGEST_TEXT + 1).read_to_end(&mut bytes);
        read.map_err(|error| FileError::Read { file: self.file.clone(), error })?;
        if bytes.len() as u64 > LARGEST_TEXT {
            return Err(FileError::TooLong { file: self.file, most: LARGEST_TEXT >> 20 });
        }
        Ok(bytes)
    }
}

#[cfg(feature = "bags")]
use hssh_io::is_packed_bag;

#[cfg(not(feature = "bags"))]
fn is_packed_bag(_: &Path) -> bool {
    false
}

/// What editors of one system save as "Unicode"; a half character at the end is replaced.
fn from_utf16(bytes: &[u8], is_big_endian: bool) -> String {
    let unit =
        |pair: &[u8; 2]| if is_big_endian { u16::from_be_bytes(*pair) } else { u16::from_le_bytes(*pair) };
    let units = bytes.as_chunks().0.iter().map(unit);
    char::decode_utf16(units).map(|decoded| decoded.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// Gives the error that reading met, and then nothing.
struct Broken(Option<io::Error>);

impl Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf16_of_both_orders_is_text() {
        let little: Vec<u8> = "aé𝄞".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = "aé𝄞".encode_utf16().flat_map(u16::to_be_bytes).collect();
        assert_eq!((from_utf16(&little, false), from_utf16(&big, true)), ("aé𝄞".into(), "aé𝄞".into()));
        assert_eq!(from_utf16(&[0x61, 0, 0x62], false), "a");
    }
}
