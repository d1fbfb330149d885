//! How a checkpoint is written down: a line that says what it is, values one after the other, and a checksum of everything.
//!
//! Values are in the binary form of the crate postcard. A checkpoint is read twice: nothing of it is believed before its checksum is right.

use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};

use crc32fast::Hasher;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::CheckpointError;

/// What every checkpoint begins with. The number changes with whatever follows.
const MAGIC: &[u8] = b"hssh checkpoint 2\n";

/// The part of it that all numbers share.
const NAME: &[u8] = b"hssh checkpoint ";

/// Room is made for so many values before the first of them is read.
const MOST_ROOM: usize = 1 << 16;

/// No number and no text in a checkpoint takes more bytes.
const LONGEST: usize = 1024;

/// A checkpoint that is being written.
pub(crate) struct Pen<'a>(BufWriter<Summed<'a>>);

/// Adds up what is written.
struct Summed<'a> {
    out: &'a mut dyn Write,
    sum: Hasher,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes on whatever is told to be flushed after each value: the end flushes once.
struct Unflushed<'a, W>(&'a mut W);

impl<W: Write> Write for Unflushed<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl<'a> Pen<'a> {
    /// Begins a checkpoint.
    pub(crate) fn new(out: &'a mut dyn Write) -> io::Result<Self> {
        let mut pen = Pen(BufWriter::new(Summed { out, sum: Hasher::new() }));
        pen.0.write_all(MAGIC)?;
        Ok(pen)
    }

    /// Writes a value.
    pub(crate) fn put(&mut self, value: &impl Serialize) -> io::Result<()> {
        postcard::to_io(value, Unflushed(&mut self.0)).map(drop).map_err(io::Error::other)
    }

    /// Writes how many values there are, and the values.
    pub(crate) fn put_all<T: Serialize>(
        &mut self,
        values: impl ExactSizeIterator<Item = T>,
    ) -> io::Result<()> {
        self.put(&values.len())?;
        for value in values {
            self.put(&value)?;
        }
        Ok(())
    }

    /// Ends the checkpoint.
    pub(crate) fn seal(self) -> io::Result<()> {
        let Summed { out, sum } = self.0.into_inner().map_err(io::IntoInnerError::into_error)?;
        out.write_all(&sum.finalize().to_le_bytes())?;
        out.flush()
    }
}

/// What a checkpoint is read from.
pub trait Source: Read + Seek {}

impl<T: Read + Seek> Source for T {}

/// A checkpoint that is being read; its checksum is right.
pub(crate) struct Unsealed<'a>(BufReader<&'a mut dyn Source>);

impl<'a> Unsealed<'a> {
    /// Opens a checkpoint.
    pub(crate) fn open(source: &'a mut dyn Source) -> Result<Self, CheckpointError> {
        let mut start = Vec::new();
        source.seek(SeekFrom::Start(0))?;
        source.take(MAGIC.len() as u64).read_to_end(&mut start)?;
        let length = source.seek(SeekFrom::End(0))?;
        match (start.strip_prefix(NAME), length.checked_sub(4)) {
            (Some(_), Some(end)) if start == MAGIC && is_whole(source, end)? => {}
            (Some(_), _) if start.len() < MAGIC.len() || start == MAGIC => {
                return Err(CheckpointError::Damaged);
            }
            (Some(format), _) => {
                let format = String::from_utf8_lossy(format);
                let there = format!("with checkpoints of form {}", format.trim_end());
                let here = "with checkpoints of form 2".to_owned();
                return Err(CheckpointError::Version { there, here });
            }
            (None, _) => return Err(CheckpointError::Foreign),
        }
        source.seek(SeekFrom::Start(MAGIC.len() as u64))?;
        Ok(Unsealed(BufReader::new(source)))
    }

    /// Reads a value.
    pub(crate) fn take<T: DeserializeOwned>(&mut self) -> Result<T, CheckpointError> {
        let (value, _) =
            postcard::from_io((&mut self.0, &mut [0; LONGEST])).map_err(|_| CheckpointError::Damaged)?;
        Ok(value)
    }

    /// Reads how many values there are, and the values, each made into something else.
    pub(crate) fn take_all<T: DeserializeOwned, V>(
        &mut self,
        mut make: impl FnMut(T) -> Option<V>,
    ) -> Result<Vec<V>, CheckpointError> {
        let length: usize = self.take()?;
        let mut values = Vec::with_capacity(length.min(MOST_ROOM));
        for _ in 0..length {
            values.push(make(self.take()?).ok_or(CheckpointError::Damaged)?);
        }
        Ok(values)
    }
}

/// Whether the checksum that stands after so many bytes is theirs.
fn is_whole(source: &mut dyn Source, end: u64) -> io::Result<bool> {
    source.seek(SeekFrom::Start(0))?;
    let mut sum = Hasher::new();
    let mut rest = BufReader::with_capacity(1 << 16, source.take(end));
    loop {
        let bytes = io::BufRead::fill_buf(&mut rest)?;
        if bytes.is_empty() {
            break;
        }
        sum.update(bytes);
        let length = bytes.len();
        io::BufRead::consume(&mut rest, length);
    }
    let mut said = Vec::new();
    source.seek(SeekFrom::Start(end))?;
    source.take(4).read_to_end(&mut said)?;
    Ok(said == sum.finalize().to_le_bytes())
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use proptest::prelude::*;

    use super::*;

    fn sealed(values: &[u64]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut pen = Pen::new(&mut bytes).unwrap();
        pen.put_all(values.iter()).unwrap();
        pen.seal().unwrap();
        bytes
    }

    fn read(bytes: Vec<u8>) -> Result<Vec<u64>, CheckpointError> {
        Unsealed::open(&mut Cursor::new(bytes))?.take_all(Some)
    }

    #[test]
    fn what_was_written_is_read() {
        let values = vec![0, 1, u64::MAX];
        assert_eq!(read(sealed(&values)).unwrap(), values);
    }

    #[test]
    fn another_form_and_what_is_no_checkpoint_are_told_from_damage() {
        let sealed = sealed(&[7]);
        let other = String::from_utf8(sealed[..MAGIC.len()].to_vec()).unwrap().replace('2', "1").into_bytes();
        assert!(matches!(read([other, vec![0; 9]].concat()), Err(CheckpointError::Version { .. })));
        assert!(matches!(read(b"(stars: {})".to_vec()), Err(CheckpointError::Foreign)));
        assert!(matches!(read(Vec::new()), Err(CheckpointError::Foreign)));
        assert!(matches!(read(sealed[..sealed.len() - 1].to_vec()), Err(CheckpointError::Damaged)));
        assert!(matches!(read(sealed[..MAGIC.len()].to_vec()), Err(CheckpointError::Damaged)));
    }

    proptest! {
        #[test]
        fn a_byte_that_was_changed_is_noticed(
            values in prop::collection::vec(any::<u64>(), 0..40), at in any::<prop::sample::Index>(), by in 1_u8..,
        ) {
            let mut bytes = sealed(&values);
            let at = at.index(bytes.len());
            bytes[at] ^= by;
            prop_assert!(read(bytes).is_err());
        }

        /// Of whoever writes a wrong checkpoint and its right checksum.
        #[test]
        fn nonsense_under_a_right_checksum_is_refused(nonsense in prop::collection::vec(any::<u8>(), 0..60)) {
            let mut bytes = [MAGIC, &nonsense].concat();
            let mut sum = Hasher::new();
            sum.update(&bytes);
            bytes.extend(sum.finalize().to_le_bytes());
            let mut source = Cursor::new(bytes);
            let mut unsealed = Unsealed::open(&mut source).unwrap();
            let _ = unsealed.take_all::<(u32, String, Vec<f64>), _>(Some);
        }
    }
}
