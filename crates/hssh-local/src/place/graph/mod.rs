//! All places of a grid: ways out are branches of its medial axis, which also says where they lead.

mod bend;
mod candidate;
mod connection;
mod neighborhood;
mod parts;
mod place_graph;
mod section;
#[cfg(test)]
mod tests;

pub use connection::{OpenEnd, PlaceConnection};
pub use neighborhood::{Neighborhood, NeighborhoodError, neighborhood};
pub use parts::PlaceNumber;
pub use place_graph::{GridPlace, PlaceGraph, PlaceGraphError};
