//! Reads a log message by message, from any source of bytes, compressed or not.

use std::io::{BufRead, BufReader, Read};

use flate2::bufread::MultiGzDecoder;

use super::error::{LogError, LogWarning};
use super::message::Message;
use super::position::LogPosition;
use crate::lines::{LineEnds, is_line_end};

/// How every gzip file begins.
const GZIP_MAGIC: [u8; 2] = [0x1f, 0x8b];
/// No message is longer, in bytes.
const LONGEST_LINE: usize = 1 << 22;

/// The messages of a log in order; a message that cannot be read is a warning, and reading goes on.
pub struct LogReader<'a> {
    source: Box<dyn BufRead + 'a>,
    line: u64,
    warnings: Vec<LogWarning>,
    broken: bool,
    ends: LineEnds,
}

impl<'a> LogReader<'a> {
    /// A reader of plain or gzip text, whichever the first two bytes say.
    ///
    /// # Errors
    /// If the source cannot be read.
    pub fn new(source: impl Read + 'a) -> Result<Self, LogError> {
        let mut source = BufReader::with_capacity(1 << 16, source);
        let failed = |error| LogError::Read { line: 0, error };
        let is_gzip = source.fill_buf().map_err(failed)?.starts_with(&GZIP_MAGIC);
        let source: Box<dyn BufRead + 'a> =
            if is_gzip { Box::new(BufReader::new(MultiGzDecoder::new(source))) } else { Box::new(source) };
        Ok(LogReader { source, line: 0, warnings: Vec::new(), broken: false, ends: LineEnds::default() })
    }

    /// The line of the message read last, counted from 1.
    #[must_use]
    pub fn line(&self) -> u64 {
        self.line
    }

    /// What was passed over so far.
    #[must_use]
    pub fn warnings(&self) -> &[LogWarning] {
        &self.warnings
    }

    pub(super) fn take_warnings(&mut self) -> Vec<LogWarning> {
        std::mem::take(&mut self.warnings)
    }

    fn warn(&mut self, kind: &str, problem: super::MessageProblem) {
        let kind = kind.to_owned();
        self.warnings.push(LogWarning::Message { at: LogPosition::Line(self.line), kind, problem });
    }

    /// The next message, or `None` at the end of the log.
    ///
    /// # Errors
    /// If the source cannot be read, or is no text.
    pub fn next_message(&mut self) -> Result<Option<Message>, LogError> {
        while let Some((text, is_whole)) = self.next_line()? {
            match Message::parse(&text) {
                Ok(message) => return Ok(Some(message)),
                Err(problem) if is_whole => {
                    self.warn(
                        &text.split_whitespace().next().unwrap_or_default().to_ascii_uppercase(),
                        problem,
                    );
                }
                Err(problem) => self.break_off(&problem.to_string()),
            }
        }
        Ok(None)
    }

    /// The next line, and whether a line feed ended it.
    fn next_line(&mut self) -> Result<Option<(String, bool)>, LogError> {
        if self.broken {
            return Ok(None);
        }
        self.line += 1;
        let mut bytes = Vec::new();
        let read = self.ends.read_line(&mut self.source, LONGEST_LINE, &mut bytes);
        if bytes.len() >= LONGEST_LINE {
            return Err(LogError::EndlessLine { line: self.line, most: LONGEST_LINE });
        }
        if let Err(error) = read {
            // What flate2 reports when compressed data ends early or does not add up.
            use std::io::ErrorKind::{InvalidData, InvalidInput, UnexpectedEof};
            if !matches!(error.kind(), UnexpectedEof | InvalidData | InvalidInput) {
                return Err(LogError::Read { line: self.line, error });
            }
            self.break_off(&error.to_string());
            return Ok(None);
        }
        let is_whole = bytes.last().is_some_and(|last| is_line_end(*last));
        if bytes.is_empty() {
            self.line -= 1;
            return Ok(None);
        }
        Ok(Some((String::from_utf8_lossy(&bytes).into_owned(), is_whole)))
    }

    fn break_off(&mut self, reason: &str) {
        self.broken = true;
        let at = LogPosition::Line(self.line);
        self.warnings.push(LogWarning::BreaksOff { at, reason: reason.to_owned() });
    }
}
