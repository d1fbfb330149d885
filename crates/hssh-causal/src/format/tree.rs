//! A RON text as a tree of values, each with its place, before anybody asks what they mean.

use super::error::Span;

/// A value and where it stands.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Value<'a> {
    pub(super) span: Span,
    pub(super) shape: Shape<'a>,
}

/// What a value looks like.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Shape<'a> {
    /// `"text"`
    Text(String),
    /// Whatever begins like a number.
    Number(&'a str),
    /// A bare word.
    Word(&'a str),
    /// `[value, ..]`
    List(Vec<Value<'a>>),
    /// `{key: value, ..}`
    Map(Vec<(Value<'a>, Value<'a>)>),
    /// `Name(field: value, ..)`, where the name may be missing; `()` is one without fields.
    Record { name: Option<&'a str>, fields: Vec<(Span, &'a str, Value<'a>)> },
    /// `Name(value, ..)`, where the name may be missing.
    Tuple { name: Option<&'a str> },
}

impl Value<'_> {
    /// What was found instead, for error messages.
    pub(super) fn describe(&self) -> String {
        match &self.shape {
            Shape::Text(text) => format!("the text {text:?}"),
            Shape::Number(number) => format!("the number `{number}`"),
            Shape::Word(word) => format!("the word `{word}`"),
            Shape::List(_) => "a list `[..]`".to_owned(),
            Shape::Map(_) => "a map `{..}`".to_owned(),
            Shape::Record { name, .. } => format!("a record `{}(..)`", name.unwrap_or_default()),
            Shape::Tuple { name } => format!("a tuple `{}(..)`", name.unwrap_or_default()),
        }
    }

    /// Where to point when the value as a whole is at fault: all of a text, number or word, the
    /// beginning of a structure.
    pub(super) fn head(&self) -> Span {
        match self.shape {
            Shape::Text(_) | Shape::Number(_) | Shape::Word(_) => self.span,
            Shape::Record { name, .. } | Shape::Tuple { name } => {
                Span { end: self.span.start + name.map_or(1, str::len), ..self.span }
            }
            Shape::List(_) | Shape::Map(_) => self.span.head(),
        }
    }
}
