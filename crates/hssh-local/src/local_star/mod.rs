//! Places and their stars in a grid: from gateways to local paths (section 2.2.2).

mod bend;
mod candidate;
mod connection;
mod local_path;
mod neighborhood;
mod parameters;
mod place_graph;
mod section;
mod star;
#[cfg(test)]
mod tests;

pub use connection::{Connection, OpenEnd};
pub use neighborhood::{Neighborhood, NeighborhoodError, neighborhood};
pub use parameters::PlaceParameters;
pub use place_graph::{Place, PlaceGraph, PlaceGraphError, PlaceKind, PlaceNumber};
pub use star::LocalStar;
