//! Embedded graphs: rotation systems over darts, with faces and genus (section 3.2).

mod build;
mod components;
mod faces;
mod graph;
mod link;
mod sanity;
#[cfg(test)]
mod tests;

pub use build::EmbeddingError;
pub use faces::Faces;
pub use graph::{EmbeddedGraph, PendingEdge};
pub use link::Link;
