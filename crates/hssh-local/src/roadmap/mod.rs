//! Roadmaps: what a robot may drive by through the regions of a map, and the places and stars that it makes
//! (sections 2.1.3 and 2.2.2).
//!
//! In each region, all passages and the middle are [reached](reach) from one another on ways that keep away from
//! obstacles; what is needed of these [links] is the [network] of the region. A region is one place, in its middle; a
//! corridor is one for each junction. Where networks meet in a passage, places are connected, and the passage is the
//! gateway of both their stars: there is one set of connections, and every other answer is read off it.

mod build;
mod connection;
mod graph;
mod line;
mod links;
mod network;
mod numbered;
mod options;
mod reach;
mod region;
mod spread;
#[cfg(test)]
mod tests;
mod window;

pub use graph::{Connection, RegionPlace, RoadNode, RoadNodeKind, RoadNodeNumber, Roadmap, Way};
pub use options::RoadmapOptions;
