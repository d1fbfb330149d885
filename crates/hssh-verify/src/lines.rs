//! The lines of a certificate with their numbers, the words of a line, and why a line is refused.

use std::str::{FromStr, SplitAsciiWhitespace};

/// Why a certificate is not accepted: the first line that does not hold, and what does not hold there.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("line {line}: {reason}")]
pub struct Refusal {
    /// The number of the line, counted from 1; one more than there are if something is missing at the end.
    pub line: usize,
    /// What does not hold, in words.
    pub reason: String,
}

impl Refusal {
    pub(crate) fn new(line: usize, reason: impl Into<String>) -> Refusal {
        Refusal { line, reason: reason.into() }
    }
}

/// The statements of a certificate: its lines without comments and empty ones.
pub(crate) struct Lines<'a> {
    lines: std::str::Lines<'a>,
    number: usize,
    held_back: Option<Statement<'a>>,
}

/// A statement: its keyword and what follows.
#[derive(Clone)]
pub(crate) struct Statement<'a> {
    /// The number of its line, counted from 1.
    pub(crate) line: usize,
    /// All of it.
    pub(crate) text: &'a str,
    /// Its first word.
    pub(crate) keyword: &'a str,
    rest: SplitAsciiWhitespace<'a>,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Lines { lines: text.lines(), number: 0, held_back: None }
    }

    /// The next statement, which has to be there.
    pub(crate) fn next(&mut self, expected: &str) -> Result<Statement<'a>, Refusal> {
        self.next_if_any().ok_or_else(|| self.ended(expected))
    }

    /// That there is nothing more.
    pub(crate) fn ended(&self, expected: &str) -> Refusal {
        Refusal::new(self.number + 1, format!("the certificate ends where {expected} was expected"))
    }

    /// The next statement, or none at the end of the text.
    pub(crate) fn next_if_any(&mut self) -> Option<Statement<'a>> {
        if let Some(statement) = self.held_back.take() {
            return Some(statement);
        }
        for text in self.lines.by_ref() {
            self.number += 1;
            if text.starts_with('#') {
                continue;
            }
            let mut rest = text.split_ascii_whitespace();
            if let Some(keyword) = rest.next() {
                return Some(Statement { line: self.number, text, keyword, rest });
            }
        }
        None
    }

    /// The next statement if it has this keyword.
    pub(crate) fn next_if(&mut self, keyword: &str) -> Option<Statement<'a>> {
        let statement = self.next_if_any()?;
        if statement.keyword == keyword {
            return Some(statement);
        }
        self.held_back = Some(statement);
        None
    }

    /// The next statement, which has to have this keyword.
    pub(crate) fn expect(&mut self, keyword: &str) -> Result<Statement<'a>, Refusal> {
        let statement = self.next(&format!("`{keyword}`"))?;
        if statement.keyword == keyword {
            return Ok(statement);
        }
        Err(statement.refuse(format!("expected `{keyword}`, found `{}`", shortened(statement.text))))
    }
}

/// A text short enough for a message.
pub(crate) fn shortened(text: &str) -> String {
    const MOST: usize = 60;
    if text.chars().count() <= MOST {
        return text.to_owned();
    }
    text.chars().take(MOST).chain(['…']).collect()
}

impl<'a> Statement<'a> {
    /// That this line does not hold.
    pub(crate) fn refuse(&self, reason: impl Into<String>) -> Refusal {
        Refusal::new(self.line, reason)
    }

    /// The next word.
    pub(crate) fn word(&mut self, what: &str) -> Result<&'a str, Refusal> {
        self.rest.next().ok_or_else(|| {
            Refusal::new(self.line, format!("expected {what} at the end of `{}`", shortened(self.text)))
        })
    }

    /// The next word if there is one.
    pub(crate) fn word_if_any(&mut self) -> Option<&'a str> {
        self.rest.next()
    }

    /// The next word as a whole number.
    pub(crate) fn count<T: FromStr>(&mut self, what: &str) -> Result<T, Refusal> {
        let word = self.word(what)?;
        let is_plain = word.bytes().all(|byte| byte.is_ascii_digit());
        word.parse().ok().filter(|_| is_plain).ok_or_else(|| {
            self.refuse(format!("expected {what}, a whole number from 0 on, found `{}`", shortened(word)))
        })
    }

    /// The next word as a finite number.
    pub(crate) fn number(&mut self, what: &str) -> Result<f64, Refusal> {
        let word = self.word(what)?;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| {
            self.refuse(format!("expected {what}, a finite number, found `{}`", shortened(word)))
        })
    }

    /// The next word as a finite number that satisfies a condition.
    pub(crate) fn number_that(
        &mut self,
        what: &str,
        is: &str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<f64, Refusal> {
        let number = self.number(what)?;
        if holds(number) {
            return Ok(number);
        }
        Err(self.refuse(format!("{what} is {number}, it has to be {is}")))
    }

    /// That nothing follows.
    pub(crate) fn finish(mut self) -> Result<(), Refusal> {
        match self.rest.next() {
            None => Ok(()),
            Some(word) => Err(self.refuse(format!("`{}` is one word too many", shortened(word)))),
        }
    }

    /// Everything after the keyword.
    pub(crate) fn remainder(&self) -> &'a str {
        self.text.trim_ascii_start()[self.keyword.len()..].trim_ascii()
    }
}
