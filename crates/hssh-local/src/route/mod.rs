//! Routes: the network of the ways that a robot went, in the frame of a track whose loops are closed. What was
//! travelled is certain: where its own ways part, or it turned back, a place is, whether it looked like one or not.

#[cfg(test)]
mod drawn;
mod driven;
mod network;
mod options;
mod paths;
mod places;
mod travelled;
mod visits;
mod walk;

pub use driven::driven_line;
pub use options::RouteOptions;
pub(crate) use visits::route;
