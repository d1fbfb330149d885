//! What is wrong in an exploration's text, where it stands, and what would be right.

use std::fmt;

/// A part of the source, in bytes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Span {
    /// The first character of a structure: its opening bracket.
    pub(super) fn head(self) -> Self {
        Span { end: self.start + 1, ..self }
    }
}

/// A problem while the source is at hand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Fault {
    span: Span,
    message: String,
    help: String,
}

impl Fault {
    pub(super) fn new(span: Span, message: impl Into<String>, help: impl Into<String>) -> Self {
        Fault { span, message: message.into(), help: help.into() }
    }
}

/// The faults found so far: reading goes on after a fault that spoils only its own value.
#[derive(Default)]
pub(super) struct Faults(Vec<Fault>);

impl Faults {
    pub(super) fn add(&mut self, fault: Fault) {
        self.0.push(fault);
    }

    /// The value, or nothing after noting why there is none.
    pub(super) fn keep<T>(&mut self, result: Result<T, Fault>) -> Option<T> {
        result.map_err(|fault| self.add(fault)).ok()
    }

    /// The error that reports all faults, if there are any.
    pub(super) fn into_error(self, source: &str) -> Option<ParseError> {
        (!self.0.is_empty()).then(|| ParseError::new(self.0, source))
    }
}

/// One thing that is wrong in the text of an exploration.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Problem {
    line: usize,
    column: usize,
    length: usize,
    message: String,
    help: String,
}

impl Problem {
    fn new(fault: Fault, source: &str) -> Self {
        let Span { start, end } = fault.span;
        let line_start = source[..start].rfind('\n').map_or(0, |newline| newline + 1);
        Problem {
            line: 1 + source[..start].matches('\n').count(),
            column: 1 + source[line_start..start].chars().count(),
            length: source[start..end].chars().take_while(|&c| c != '\n').count(),
            message: presentable(&fault.message),
            help: presentable(&fault.help),
        }
    }

    /// The line, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// The column in characters, counted from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.column
    }

    /// How many characters of the line are at fault; 0 at the end of the text.
    #[must_use]
    pub fn length(&self) -> usize {
        self.length
    }

    /// What is wrong.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What would be right.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.help
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}\nhelp: {}", self.line, self.column, self.message, self.help)
    }
}

/// A message that quotes the source, without control characters and of a readable length.
fn presentable(message: &str) -> String {
    const READABLE: usize = 400;
    let mut presentable: String = message.chars().take(READABLE).collect();
    if presentable.len() < message.len() {
        presentable.push('…');
    }
    presentable.replace(char::is_control, "\u{fffd}")
}

/// Why a text is no exploration: one problem or, where reading could go on, several.
///
/// [`Display`](fmt::Display) says line and column; [`ParseError::render`] also shows the source.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParseError {
    problems: Vec<Problem>,
    unlisted: usize,
}

impl ParseError {
    /// A text with more problems than this has one cause that the first ones show.
    const LISTED: usize = 20;

    fn new(mut faults: Vec<Fault>, source: &str) -> Self {
        faults.sort_by_key(|fault| fault.span.start);
        let unlisted = faults.len().saturating_sub(Self::LISTED);
        let listed = faults.into_iter().take(Self::LISTED);
        ParseError { problems: listed.map(|fault| Problem::new(fault, source)).collect(), unlisted }
    }

    /// The error of a single fault.
    pub(super) fn single(fault: Fault, source: &str) -> Self {
        ParseError::new(vec![fault], source)
    }

    /// The problems in the order of the text: at least one, at most twenty.
    #[must_use]
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// How many more problems there are than [`ParseError::problems`] lists.
    #[must_use]
    pub fn unlisted(&self) -> usize {
        self.unlisted
    }

    /// The line of the first problem, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.problems[0].line
    }

    /// The column of the first problem in characters, counted from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.problems[0].column
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.problems.iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{problem}")?;
        }
        if self.unlisted > 0 {
            write!(f, "\nand {} more problems", self.unlisted)?;
        }
        Ok(())
    }
}

impl std::error::Error for ParseError {}
