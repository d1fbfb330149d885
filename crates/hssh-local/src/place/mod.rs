//! Places, their gateways and their stars in occupancy grids (section 2.2).
//!
//! Two questions are asked of a grid: where all its places are, and how the axis connects them ([`PlaceGraph`],
//! and [`neighborhood`] for the one around a robot); and whether the robot is at a place now, given a local map
//! that is full of clutter and ends somewhere ([`sight`]). Both go by one [`PlaceOptions`], and share all that
//! follows once a way out is known: the gateway across it (`gateway`), the local paths that gateways make
//! (`local_path`), the star (`star`) and what kind of place it is ([`PlaceKind`]).
//!
//! What differs is how a *way out* is found. In `graph` it is a branch of the medial axis, for only an axis tells
//! which gateways lead to one another. In `sighting` it is free space that leads on far enough for a robot that
//! travels, whatever the axis does there: in local maps, which are made of few scans, clutter divides the axis of
//! one corridor into many, and its branches come and go from one look to the next.

mod constriction;
mod door;
mod gateway;
mod graph;
mod local_path;
mod options;
mod sighting;
mod star;

pub use door::{doors, hidden_area};
pub use gateway::Gateway;
pub(crate) use gateway::gateway_at;
pub use graph::{
    GridPlace, Neighborhood, NeighborhoodError, OpenEnd, PlaceConnection, PlaceGraph, PlaceGraphError,
    PlaceNumber, neighborhood,
};
pub(crate) use local_path::{continuations, crookedness};
pub use options::{DoorOptions, GatewayOptions, PlaceOptions};
pub use sighting::{Sighting, sight};
pub use star::{LocalStar, PlaceKind};
