//! From tokens to values.
//!
//! The `ron` crate reads texts into types, but it cannot say where a value stood once it is read,
//! and most errors of an exploration are about values that contradict each other. So this reads
//! the part of RON that explorations need, and tests hold it against `ron` itself.

use super::error::{Fault, Span};
use super::lexer::{Lexeme, Token, tokens};
use super::tree::{Shape, Value};

/// Far deeper than any exploration, far shallower than the stack.
const DEPTH_LIMIT: usize = 32;

/// The one value that the source consists of.
pub(super) fn parse(source: &str) -> Result<Value<'_>, Fault> {
    let mut parser = Parser { source, tokens: tokens(source)?, next: 0 };
    if parser.peek().lexeme == Lexeme::End {
        return Err(Fault::new(
            Span { start: 0, end: 0 },
            "there is no exploration in this text: it is empty",
            "the smallest one is `Exploration(stars: {\"L\": [\"0+\", \"1+ closed\", \"0- closed\", \"1-\"]}, start: \"L\", travels: [])`",
        ));
    }
    let value = parser.value("an exploration", 0)?;
    let rest = parser.peek();
    match rest.lexeme {
        Lexeme::End => Ok(value),
        _ => Err(Fault::new(
            rest.span,
            format!("{} follows after the exploration has ended", parser.describe(rest)),
            "remove what follows the bracket that closes the exploration, or look for a bracket closed too early",
        )),
    }
}

struct Parser<'a> {
    source: &'a str,
    tokens: Vec<Token<'a>>,
    next: usize,
}

impl<'a> Parser<'a> {
    /// The next token; at the end, [`Lexeme::End`] again and again.
    fn peek(&self) -> &Token<'a> {
        &self.tokens[self.next]
    }

    fn advance(&mut self) -> Token<'a> {
        let token = self.tokens[self.next].clone();
        self.next = (self.next + 1).min(self.tokens.len() - 1);
        token
    }

    fn take(&mut self, lexeme: &Lexeme<'_>) -> bool {
        let found = self.peek().lexeme == *lexeme;
        if found {
            self.advance();
        }
        found
    }

    fn describe(&self, token: &Token<'_>) -> String {
        let Span { start, end } = token.span;
        match token.lexeme {
            Lexeme::End => "the end of the text".to_owned(),
            _ => format!("`{}`", &self.source[start..end]),
        }
    }

    fn line(&self, span: Span) -> usize {
        1 + self.source[..span.start].matches('\n').count()
    }

    /// A value; `wanted` says what for, in case there is none.
    fn value(&mut self, wanted: &str, depth: usize) -> Result<Value<'a>, Fault> {
        let token = self.advance();
        if depth > DEPTH_LIMIT {
            return Err(Fault::new(
                token.span,
                format!("brackets are nested more than {DEPTH_LIMIT} deep"),
                "an exploration needs six levels: look for brackets that are not closed",
            ));
        }
        let shape = match token.lexeme {
            Lexeme::Text(text) => Shape::Text(text),
            Lexeme::Number(number) => Shape::Number(number),
            Lexeme::Word(word) if self.peek().lexeme == Lexeme::Open('(') => {
                let open = self.advance().span;
                self.round(Some(word), open, depth)?
            }
            Lexeme::Word(word) => Shape::Word(word),
            Lexeme::Open('(') => self.round(None, token.span, depth)?,
            Lexeme::Open('[') => {
                let item = |parser: &mut Self| parser.value("a value", depth + 1);
                Shape::List(self.items(token.span, '[', item)?)
            }
            Lexeme::Open(_) => {
                let item = |parser: &mut Self| parser.entry(depth + 1);
                Shape::Map(self.items(token.span, '{', item)?)
            }
            Lexeme::Close(_) | Lexeme::Colon | Lexeme::Comma | Lexeme::End => {
                let found = self.describe(&token);
                return Err(Fault::new(
                    token.span,
                    format!("expected {wanted}, found {found}"),
                    "a value is text in quotes, a number, a list `[..]`, a map `{..}` or a record `(..)`",
                ));
            }
        };
        let end = self.tokens[..self.next].last().map_or(token.span.end, |last| last.span.end);
        Ok(Value { span: Span { start: token.span.start, end }, shape })
    }

    /// What `(` opened: a record if its first word is followed by a colon, otherwise a tuple.
    fn round(&mut self, name: Option<&'a str>, open: Span, depth: usize) -> Result<Shape<'a>, Fault> {
        let following = |offset: usize| self.tokens.get(self.next + offset).map(|token| &token.lexeme);
        let is_tuple = match (following(0), following(1)) {
            (Some(Lexeme::Close(_)), _) | (_, Some(Lexeme::Colon)) => false,
            (Some(Lexeme::Word(_)), next) => matches!(next, Some(Lexeme::Comma | Lexeme::Close(_))),
            _ => true,
        };
        if is_tuple {
            self.items(open, '(', |parser| parser.value("a value", depth + 1))?;
            return Ok(Shape::Tuple { name });
        }
        let fields = self.items(open, '(', |parser| parser.field(open, depth + 1))?;
        Ok(Shape::Record { name, fields })
    }

    /// `name: value` of the record opened at `open`.
    fn field(&mut self, open: Span, depth: usize) -> Result<(Span, &'a str, Value<'a>), Fault> {
        let token = self.advance();
        let name = match token.lexeme {
            Lexeme::Word(name) => name,
            Lexeme::Text(text) => {
                return Err(Fault::new(
                    token.span,
                    format!("expected the name of a field, found the text {text:?}"),
                    format!("names of fields stand without quotes: `{text}: ..`"),
                ));
            }
            Lexeme::Number(number) => {
                return Err(Fault::new(
                    token.span,
                    format!("expected the name of a field, found the number `{number}`"),
                    "a record is written `(name: value, name: value)`, and decimals with a point: `7.9`",
                ));
            }
            _ => {
                return Err(Fault::new(
                    token.span,
                    format!("expected the name of a field, found {}", self.describe(&token)),
                    format!(
                        "fields are written `name: value`; is the `(` of line {} meant to be closed before?",
                        self.line(open)
                    ),
                ));
            }
        };
        self.colon(&format!("the field `{name}`"))?;
        Ok((token.span, name, self.value(&format!("the value of `{name}`"), depth)?))
    }

    /// `key: value` of a map.
    fn entry(&mut self, depth: usize) -> Result<(Value<'a>, Value<'a>), Fault> {
        let key = self.value("a name", depth)?;
        self.colon(&key.describe())?;
        let value = self.value("a value", depth)?;
        Ok((key, value))
    }

    fn colon(&mut self, after: &str) -> Result<(), Fault> {
        if self.take(&Lexeme::Colon) {
            return Ok(());
        }
        let token = self.peek();
        let found = self.describe(token);
        Err(Fault::new(
            token.span,
            format!("expected `:` after {after}, found {found}"),
            "a name and its value are separated by a colon",
        ))
    }

    /// Items up to the bracket that closes the one at `open`, with commas between them and, if one
    /// likes, after the last.
    fn items<T>(
        &mut self,
        open: Span,
        bracket: char,
        mut item: impl FnMut(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let closing = closing(bracket);
        let mut items = Vec::new();
        loop {
            if self.take(&Lexeme::Close(closing)) {
                return Ok(items);
            }
            self.refuse_wrong_end(open, bracket)?;
            items.push(item(self)?);
            if !self.take(&Lexeme::Comma) && self.peek().lexeme != Lexeme::Close(closing) {
                self.refuse_wrong_end(open, bracket)?;
                let token = self.peek();
                let line = self.line(open);
                let help = match token.lexeme {
                    Lexeme::Colon => {
                        format!("close the `{bracket}` of line {line} first: there are no names in it")
                    }
                    _ => format!("put a comma before it, or close the `{bracket}` of line {line} first"),
                };
                let found = self.describe(token);
                return Err(Fault::new(
                    token.span,
                    format!("expected `,` or `{closing}`, found {found}"),
                    help,
                ));
            }
        }
    }

    /// An error if the next token is the end of the text or closes another bracket.
    fn refuse_wrong_end(&self, open: Span, bracket: char) -> Result<(), Fault> {
        let closing = closing(bracket);
        let token = self.peek();
        match token.lexeme {
            Lexeme::End => Err(Fault::new(
                open,
                format!("this `{bracket}` is never closed"),
                format!("close it with `{closing}`"),
            )),
            Lexeme::Close(other) => Err(Fault::new(
                token.span,
                format!("`{other}` cannot close the `{bracket}` of line {}", self.line(open)),
                format!("write `{closing}` here, or before it if a bracket is missing"),
            )),
            _ => Ok(()),
        }
    }
}

fn closing(bracket: char) -> char {
    match bracket {
        '(' => ')',
        '[' => ']',
        _ => '}',
    }
}
