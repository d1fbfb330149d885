//! Who checks the checker: the oracle against published counts, laws and maps small enough to draw.

#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod grid;
mod laws;
mod published_counts;
mod reading_laws;
mod readings;
mod small_maps;
