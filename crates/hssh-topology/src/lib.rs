//! The topological level of the hybrid Spatial Semantic Hierarchy.
//!
//! Stars and their isomorphisms, embedded graphs with their faces and genus, topological maps,
//! and the recursive step that turns one hypothesis about an exploration into its successors.
//! No coordinates, no input or output.

mod isomorphism;
mod star;

pub use isomorphism::Isomorphism;
pub use star::{Olp, OlpName, Sign, Star, StarEnd, StarError, Travel};
