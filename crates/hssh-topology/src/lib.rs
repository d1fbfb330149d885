//! The topological level of the hybrid Spatial Semantic Hierarchy.
//!
//! Stars and their isomorphisms, embedded graphs with their faces and genus, topological maps,
//! and the recursive step that turns one hypothesis about an exploration into its successors.
//! No coordinates, no input or output.
//!
//! ```
//! use hssh_topology::{Isomorphism, Star};
//!
//! // A T as it looks from below, and as it looks from the right: one star, turned by a quarter.
//! let below: Star = "0+ (1+) 0- 1-".parse()?;
//! let right: Star = "(1+) 0- 1- 0+".parse()?;
//! let turns: Vec<u32> = Isomorphism::all(&below, &right).map(|phi| phi.rotation()).collect();
//! assert_eq!(turns.len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axioms;
mod catalog;
mod embedding;
mod hypothesis;
mod ids;
mod isomorphism;
mod live;
mod map;
mod preference;
mod reading;
mod replay;
mod sanity;
mod simplicity;
mod star;

pub use axioms::{Axiom, Axioms, AxiomsError, Removals};
pub use catalog::{Look, StarCatalog};
pub use embedding::{EmbeddedGraph, EmbeddingError, Faces, Link, PendingEdge};
pub use hypothesis::{
    Derivation, DerivationError, Footprint, Hypothesis, Observation, Outcome, Position, Rules, Step,
};
pub use ids::{Dart, FaceLabel, MapOlp, Olp, PathId, PlaceId, StarId, Vertex};
pub use isomorphism::Isomorphism;
pub use map::{BoundaryRelation, Course, Direction, PathSides, PendingGateway, Region, TopologicalMap};
pub use preference::{GenusRank, Measure, Preference, Rank};
pub use reading::{
    Account, Anywhere, Arrival, Chart, ChartEnd, Element, EndRecord, Hop, Reading, ReadingModel,
    ReadingModelError, Side, Sight, Sightings, Underway, Way, Whereabouts,
};
pub use replay::{
    Contradiction, Discovery, End, Malformed, MapSketch, Replay, ReplayedTravel, TracedPath, Violation,
    replay, violations,
};
pub use sanity::Unsound;
pub use simplicity::{Simplicity, SimplicityError, SimplicityFloor};
pub use star::{OlpName, Passability, Sign, Star, StarEnd, StarError};
