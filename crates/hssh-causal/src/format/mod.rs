//! Explorations as RON text: read with errors that say where and what to do, written as by hand.

mod end;
mod error;
mod lexer;
mod odometry;
mod parser;
mod read;
mod record;
mod render;
mod star;
mod suggest;
mod tree;
mod write;

use std::str::FromStr;

use crate::Exploration;

pub use error::{ParseError, Problem};

impl Exploration {
    /// Reads an exploration from its RON text.
    ///
    /// # Errors
    /// If the text is no RON or what it says is no exploration: with line, column and what would
    /// be right, for as many problems as can be told apart.
    pub fn from_ron(text: &str) -> Result<Self, ParseError> {
        read::read_exploration(text)
    }

    /// Reads an exploration from the bytes of a file.
    ///
    /// # Errors
    /// As [`Exploration::from_ron`], and if the bytes are no UTF-8 text.
    pub fn from_ron_bytes(bytes: &[u8]) -> Result<Self, ParseError> {
        read::read_bytes(bytes)
    }

    /// The exploration as RON text, one star type and one travel per line;
    /// [`Exploration::from_ron`] returns the same exploration, every number bit for bit.
    #[must_use]
    pub fn to_ron(&self) -> String {
        write::write_exploration(self)
    }
}

impl FromStr for Exploration {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        Exploration::from_ron(text)
    }
}
