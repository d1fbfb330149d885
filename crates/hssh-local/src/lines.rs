//! Lines of a text of bytes, wherever they end: by a line feed, by a carriage return, or by both.

use std::io::{BufRead, ErrorKind, Result};

/// Reads line by line from a source that may still be written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct LineEnds {
    /// Whether the last line ended in a carriage return: a line feed behind it ends no other one.
    is_returned: bool,
}

impl LineEnds {
    /// Appends what follows up to and with the end of a line, and no more than so many bytes. Nothing is appended at the end of the source.
    ///
    /// # Errors
    /// If the source cannot be read; what came before is appended.
    pub fn read_line(&mut self, source: &mut impl BufRead, most: usize, bytes: &mut Vec<u8>) -> Result<()> {
        let most = bytes.len() + most;
        while bytes.len() < most {
            let there = match source.fill_buf() {
                Ok(there) => there,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            if there.is_empty() {
                return Ok(());
            }
            if std::mem::take(&mut self.is_returned) && there[0] == b'\n' {
                source.consume(1);
                continue;
            }
            let there = &there[..there.len().min(most - bytes.len())];
            let end = there.iter().position(|&byte| is_line_end(byte));
            let taken = end.map_or(there.len(), |end| end + 1);
            bytes.extend_from_slice(&there[..taken]);
            self.is_returned = end.is_some_and(|end| there[end] == b'\r');
            source.consume(taken);
            if end.is_some() {
                return Ok(());
            }
        }
        Ok(())
    }
}

/// Whether a byte ends a line.
pub(crate) fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_where_any_system_ends_it() {
        for (text, expected) in [
            ("a\nb\r\nc\rd", &["a\n", "b\r", "c\r", "d"][..]),
            ("\r\n\n\r", &["\r", "\n", "\r"]),
            ("", &[]),
            ("abcdefgh\ni", &["abcdef", "gh\n", "i"]),
        ] {
            let mut source = std::io::BufReader::with_capacity(2, text.as_bytes());
            let (mut ends, mut found) = (LineEnds::default(), Vec::new());
            loop {
                let mut bytes = Vec::new();
                ends.read_line(&mut source, 6, &mut bytes).unwrap();
                if bytes.is_empty() {
                    break;
                }
                found.push(String::from_utf8(bytes).unwrap());
            }
            assert_eq!(found, expected, "{text:?}");
        }
    }
}
