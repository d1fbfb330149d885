//! The lines of a text, wherever they end: by a line feed, by a carriage return, or by both.

use std::io::BufRead;

use super::error::{LONGEST_LINE, ReadProblem};

/// What some editors write before the first character of a text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Reads line by line; a byte order mark is no part of the first.
pub(super) struct Lines<R> {
    source: R,
    number: usize,
    /// Whether the last line ended by a carriage return, so that a line feed may still belong to it.
    after_return: bool,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(source: R) -> Self {
        Lines { source, number: 0, after_return: false }
    }

    /// The number of the line read last, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// The next line without its end; `None` at the end of the text.
    pub(super) fn next_line(&mut self) -> Result<Option<String>, ReadProblem> {
        let mut bytes = Vec::new();
        let is_over = self.collect(&mut bytes)?;
        if is_over && bytes.is_empty() {
            return Ok(None);
        }
        let text = match self.number {
            1 => bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&bytes),
            _ => &bytes,
        };
        match std::str::from_utf8(text) {
            Ok(text) => Ok(Some(text.to_owned())),
            Err(_) => Err(ReadProblem::NoText),
        }
    }

    /// Collects bytes up to the end of a line; true if the text is over.
    fn collect(&mut self, bytes: &mut Vec<u8>) -> Result<bool, ReadProblem> {
        self.number += 1;
        loop {
            let mut buffer = self.source.fill_buf()?;
            if std::mem::take(&mut self.after_return) && buffer.first() == Some(&b'\n') {
                self.source.consume(1);
                buffer = self.source.fill_buf()?;
            }
            if buffer.is_empty() {
                return Ok(true);
            }
            let end = buffer.iter().position(|&byte| byte == b'\n' || byte == b'\r');
            let length = end.unwrap_or(buffer.len());
            if bytes.len() + length > LONGEST_LINE {
                return Err(ReadProblem::EndlessLine);
            }
            bytes.extend_from_slice(&buffer[..length]);
            self.after_return = end.is_some_and(|end| buffer[end] == b'\r');
            self.source.consume(length + usize::from(end.is_some()));
            if end.is_some() {
                return Ok(false);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Vec<String> {
        let mut lines = Lines::new(std::io::BufReader::with_capacity(3, text));
        std::iter::from_fn(|| lines.next_line().unwrap()).collect()
    }

    #[test]
    fn a_line_ends_where_any_system_ends_it() {
        for text in [
            &b"ab\ncd\n\nef"[..],
            b"ab\r\ncd\r\n\r\nef\r\n",
            b"ab\rcd\r\ref\r",
            b"\xEF\xBB\xBFab\ncd\n\nef\n",
        ] {
            assert_eq!(lines(text), ["ab", "cd", "", "ef"], "{text:?}");
        }
        assert!(lines(b"").is_empty());
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let mut lines = Lines::new(std::io::BufReader::new(std::io::repeat(0)));
        assert!(matches!(lines.next_line(), Err(ReadProblem::EndlessLine)));
    }
}
