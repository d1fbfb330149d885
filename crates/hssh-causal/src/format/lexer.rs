//! The tokens of a RON text, each with its place.

use super::error::{Fault, Span};

/// A token and where it stands.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Token<'a> {
    pub(super) span: Span,
    pub(super) lexeme: Lexeme<'a>,
}

/// What a token is.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Lexeme<'a> {
    /// `(`, `[` or `{`
    Open(char),
    /// `)`, `]` or `}`
    Close(char),
    Colon,
    Comma,
    /// Text in quotes, without them and with its escapes resolved.
    Text(String),
    /// Whatever begins like a number, not parsed yet.
    Number(&'a str),
    /// An identifier.
    Word(&'a str),
    /// The end of the source.
    End,
}

/// The tokens of the source; the last one is [`Lexeme::End`].
pub(super) fn tokens(source: &str) -> Result<Vec<Token<'_>>, Fault> {
    let mut lexer = Lexer { source, position: 0 };
    let mut tokens = Vec::new();
    loop {
        lexer.skip_blank()?;
        let start = lexer.position;
        let lexeme = lexer.lexeme()?;
        let done = lexeme == Lexeme::End;
        tokens.push(Token { span: Span { start, end: lexer.position }, lexeme });
        if done {
            return Ok(tokens);
        }
    }
}

struct Lexer<'a> {
    source: &'a str,
    position: usize,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        &self.source[self.position..]
    }

    fn next(&mut self) -> Option<char> {
        let c = self.rest().chars().next()?;
        self.position += c.len_utf8();
        Some(c)
    }

    fn take_while(&mut self, belongs: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        self.position += length;
        &rest[..length]
    }

    /// From `start` up to here.
    fn since(&self, start: usize) -> Span {
        Span { start, end: self.position }
    }

    /// White space, `// comments` and `/* nested /* comments */ */`.
    fn skip_blank(&mut self) -> Result<(), Fault> {
        loop {
            self.take_while(is_blank);
            if self.rest().starts_with("//") {
                self.take_while(|c| c != '\n');
            } else if self.rest().starts_with("/*") {
                self.skip_block_comment()?;
            } else {
                return Ok(());
            }
        }
    }

    fn skip_block_comment(&mut self) -> Result<(), Fault> {
        let start = self.position;
        let mut depth = 0_usize;
        loop {
            let rest = self.rest();
            if rest.starts_with("/*") {
                depth += 1;
                self.position += 2;
            } else if rest.starts_with("*/") {
                depth -= 1;
                self.position += 2;
                if depth == 0 {
                    return Ok(());
                }
            } else if self.next().is_none() {
                let span = Span { start, end: start + 2 };
                return Err(Fault::new(
                    span,
                    "this comment is never closed",
                    "close it with `*/`, once for every `/*` inside it",
                ));
            }
        }
    }

    fn lexeme(&mut self) -> Result<Lexeme<'a>, Fault> {
        let start = self.position;
        let Some(c) = self.next() else { return Ok(Lexeme::End) };
        match c {
            '(' | '[' | '{' => Ok(Lexeme::Open(c)),
            ')' | ']' | '}' => Ok(Lexeme::Close(c)),
            ':' => Ok(Lexeme::Colon),
            ',' => Ok(Lexeme::Comma),
            '"' => self.text(start),
            'r' if self.raw_text_follows() => self.raw_text(start),
            '0'..='9' | '+' | '-' | '.' => {
                self.take_while(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-'));
                Ok(Lexeme::Number(&self.source[start..self.position]))
            }
            c if c.is_alphabetic() || c == '_' => {
                self.take_while(|c| c.is_alphanumeric() || c == '_');
                Ok(Lexeme::Word(&self.source[start..self.position]))
            }
            c => Err(unexpected_character(c, self.since(start))),
        }
    }

    /// The rest of `"text"`; it ends in the line that it begins in, so that a forgotten quote is
    /// found where it is missing.
    fn text(&mut self, start: usize) -> Result<Lexeme<'a>, Fault> {
        let mut text = String::new();
        loop {
            let before = self.position;
            match self.next() {
                Some('"') => return Ok(Lexeme::Text(text)),
                Some('\\') => text.push(self.escaped(before)?),
                Some(c) if c != '\n' => text.push(c),
                _ => {
                    let span = Span { start, end: start + 1 };
                    return Err(Fault::new(
                        span,
                        "text begins here, but no quote ends it in this line",
                        "end it with `\"`, or look for a quote missing further left; a line break inside a text is written `\\n`",
                    ));
                }
            }
        }
    }

    /// The character that an escape stands for; its backslash, at `start`, has been read.
    fn escaped(&mut self, start: usize) -> Result<char, Fault> {
        let resolved = match self.next() {
            Some(c @ ('"' | '\\' | '\'')) => Some(c),
            Some('n') => Some('\n'),
            Some('r') => Some('\r'),
            Some('t') => Some('\t'),
            Some('0') => Some('\0'),
            Some('u') if self.rest().starts_with('{') => {
                self.next();
                let digits = self.take_while(|c| c.is_ascii_hexdigit());
                let closed = self.rest().starts_with('}') && self.next().is_some();
                u32::from_str_radix(digits, 16).ok().filter(|_| closed).and_then(char::from_u32)
            }
            Some('\n') | None => {
                self.position = start + 1;
                None
            }
            Some(_) => None,
        };
        resolved.ok_or_else(|| {
            Fault::new(
                self.since(start),
                format!("`{}` is no escape that RON knows", &self.source[start..self.position]),
                "escapes are `\\\"`, `\\\\`, `\\n`, `\\t` and `\\u{e9}`; a backslash itself is written `\\\\`",
            )
        })
    }

    fn raw_text_follows(&self) -> bool {
        self.rest().trim_start_matches('#').starts_with('"')
    }

    /// The rest of `r"text"` or `r#"text"#`.
    fn raw_text(&mut self, start: usize) -> Result<Lexeme<'a>, Fault> {
        let hashes = self.take_while(|c| c == '#').to_owned();
        self.next();
        let text = self.rest();
        let ending = format!("\"{hashes}");
        let Some(length) = text.find(&ending) else {
            return Err(Fault::new(
                self.since(start),
                "this raw text is never closed",
                format!("end it with `{ending}`"),
            ));
        };
        self.position += length + ending.len();
        Ok(Lexeme::Text(text[..length].to_owned()))
    }
}

/// The white space of RON.
fn is_blank(c: char) -> bool {
    matches!(c, '\t'..='\r' | ' ' | '\u{85}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}')
}

fn unexpected_character(c: char, span: Span) -> Fault {
    let (name, help) = match c {
        '\'' | '`' => (format!("`{c}`"), "text stands in double quotes, like \"1+\""),
        '“' | '”' | '„' | '«' | '»' | '‘' | '’' => (
            format!("`{c}`"),
            "this is a typographic quote: text stands in straight double quotes, like \"1+\"",
        ),
        '=' => ("`=`".to_owned(), "a field and its value are separated by a colon: `exit: \"1+\"`"),
        ';' => ("`;`".to_owned(), "values are separated by commas"),
        '#' => (
            "`#`".to_owned(),
            "comments begin with `//`; attributes like `#![enable(..)]` are not needed here",
        ),
        '/' => ("`/`".to_owned(), "comments begin with `//` or stand between `/*` and `*/`"),
        '<' | '>' | '⟨' | '⟩' => {
            (format!("`{c}`"), "a travel is written `(exit: \"1+\", entry: \"0-\", star: \"T\")`")
        }
        '−' | '–' | '—' => {
            (format!("`{c}`"), "this is a typographic dash: a minus sign is written `-`")
        }
        c if c.is_whitespace() || c == '\u{feff}' => (
            format!("the invisible character U+{:04X}", u32::from(c)),
            "replace it by a plain space: it looks like one, but RON does not take it for one",
        ),
        c if c.is_control() || c == '\u{fffd}' => (
            format!("the character U+{:04X}", u32::from(c)),
            "this does not look like an exploration: it is a text file that begins with `Exploration(`",
        ),
        c => (format!("`{c}`"), "outside quotes there are only brackets, `:`, `,`, field names and numbers"),
    };
    Fault::new(span, format!("{name} does not belong here"), help)
}
