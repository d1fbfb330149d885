//! Bags that were compressed as whole files: unpacked beside, into the system's folder for temporary files.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use tempfile::NamedTempFile;

use super::BagError;

/// The content of a file that zstd compressed, in a file that goes when it is no longer used.
pub(super) fn unpacked(file: &Path) -> Result<NamedTempFile, BagError> {
    let mut unpacked = NamedTempFile::new().map_err(BagError::read(&std::env::temp_dir()))?;
    let source = BufReader::new(File::open(file).map_err(BagError::read(file))?);
    let mut source: Box<dyn Read> =
        Box::new(zstd::stream::read::Decoder::with_buffer(source).map_err(BagError::read(file))?);
    let mut begun = 0;
    let mut buffer = vec![0; 1 << 18];
    loop {
        match source.read(&mut buffer) {
            Ok(0) => return Ok(unpacked),
            Ok(read) => {
                begun += read;
                io::Write::write_all(&mut unpacked, &buffer[..read])
                    .map_err(BagError::read(&std::env::temp_dir()))?;
            }
            // What comes behind the break is missing; what is before it may be of use.
            Err(_) if begun > 0 => return Ok(unpacked),
            Err(error) => return Err(BagError::damaged(file, format!("zstd: {error}"))),
        }
    }
}

/// Whether a file holds a bag that zstd compressed as a whole.
#[must_use]
pub fn is_packed_bag(file: &Path) -> bool {
    let Ok(source) = File::open(file) else { return false };
    let Ok(decoder) = zstd::stream::read::Decoder::new(source) else { return false };
    let mut beginning = Vec::new();
    let read = decoder.take(8).read_to_end(&mut beginning);
    read.is_ok() && [&b"\x89MCAP"[..], b"SQLite", b"#ROSBAG"].iter().any(|magic| beginning.starts_with(magic))
}

/// Does something with a file that has what a source has, and goes then.
///
/// # Errors
/// If the source cannot be read or there is no space for it.
pub fn with_file<T>(mut source: impl Read, work: impl FnOnce(&Path) -> T) -> io::Result<T> {
    let mut file = NamedTempFile::new()?;
    io::copy(&mut source, &mut file)?;
    Ok(work(file.path()))
}
