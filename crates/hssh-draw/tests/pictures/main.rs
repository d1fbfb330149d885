//! Pictures of maps and search trees, checked by laws and by a few short texts.
#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod common;
mod drawings;
mod maps;
mod trees;
