//! Laws of stars, maps, bounds and sketches, on random ones, against recounts from scratch.

#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod bounds;
mod isomorphisms;
mod maps;
mod random;
mod recount;
mod sketches;
