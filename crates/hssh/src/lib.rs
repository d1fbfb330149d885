//! The hybrid Spatial Semantic Hierarchy: topological maps of places that look alike.
//!
//! This crate gathers the library crates under one name, for those who want all of them.

pub mod account;
pub mod answer;
pub mod pipeline;

#[doc(inline)]
pub use hssh_causal as causal;
#[doc(inline)]
pub use hssh_draw as draw;
#[doc(inline)]
pub use hssh_local as local;
#[doc(inline)]
pub use hssh_metrics as metrics;
#[doc(inline)]
pub use hssh_search as search;
#[doc(inline)]
pub use hssh_topology as topology;
#[doc(inline)]
pub use hssh_world as world;

/// The front page of the repository, so that its examples are tested.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
