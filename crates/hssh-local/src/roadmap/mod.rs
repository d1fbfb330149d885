//! Roadmaps: what a robot may drive by through the regions of a map, and the places and stars that it makes
//! (sections 2.1.3 and 2.2.2).
//!
//! In each region, all passages and the middle are [reached](reach) from one another on ways that keep away from
//! obstacles; what is needed of these [links] is the [network] of the region. A region is one place, in its middle; a
//! corridor is one for each junction. Where networks meet in a passage, places are connected, and the passage is the
//! gateway of both their stars: there is one set of connections, and every other answer is read off it.

mod connection;
mod line;
mod links;
mod network;
mod options;
mod place;
mod reach;
mod region;
#[cfg(test)]
mod tests;
mod window;

use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::place::PlaceNumber;
use crate::region::{RegionMap, RegionNumber};
use crate::skeleton::UnknownSpace;

pub use connection::Connection;
pub use options::RoadmapOptions;
pub use place::RegionPlace;

/// A node of a roadmap: an index into [`Roadmap::nodes`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct RoadNodeNumber(pub u32);

impl RoadNodeNumber {
    /// The node as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What is at a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RoadNodeKind {
    /// A place.
    Place(PlaceNumber),
    /// A passage, by its index in [`RegionMap::passages`].
    Passage(u32),
    /// Nothing but ways that part.
    Branch,
}

/// Where ways begin and end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RoadNode {
    /// What is there.
    pub kind: RoadNodeKind,
    /// The region it is in; of a passage, the first of the two.
    pub region: RegionNumber,
    /// Metres in the frame of the grid.
    pub position: [f64; 2],
}

/// A way that a robot can drive, in both directions.
#[derive(Clone, PartialEq, Debug)]
pub struct Way {
    /// Where it begins and ends.
    pub ends: [RoadNodeNumber; 2],
    /// The region it lies in.
    pub region: RegionNumber,
    /// The corners of its line, those at its ends included, in metres.
    pub line: Vec<[f64; 2]>,
    /// How long the line is, in metres.
    pub length: f64,
    /// How wide the way is at its narrowest, in metres: twice the least distance from the line to an obstacle.
    pub width: f64,
}

/// The ways through a map for a robot of one size.
#[derive(Clone, Debug)]
pub struct Roadmap {
    /// Where ways begin and end: passages and places, then branches, region by region.
    pub nodes: Vec<RoadNode>,
    /// The ways, region by region.
    pub ways: Vec<Way>,
    /// The places.
    pub places: Vec<RegionPlace>,
    /// What leads from place to place.
    pub connections: Vec<Connection>,
}

impl Roadmap {
    /// The roadmap of a grid with its regions.
    #[must_use]
    pub fn new(grid: &OccupancyGrid, map: &RegionMap, options: &RoadmapOptions) -> Self {
        let is_obstacle = |index: usize| match grid.cells()[index] {
            Occupancy::Free => false,
            Occupancy::Occupied => true,
            Occupancy::Unknown => options.unknown == UnknownSpace::Wall,
        };
        let field = DistanceField::new(*grid.lattice(), is_obstacle);
        let exits = region::exits(map, &field, options);
        let bounds = window::bounds(map);
        let mut roadmap =
            Roadmap { nodes: Vec::new(), ways: Vec::new(), places: Vec::new(), connections: Vec::new() };
        let passages: Vec<Option<RoadNodeNumber>> = (0..map.passages.len())
            .map(|passage| {
                let position = grid.lattice().center(exits[passage]?);
                let region = map.passages[passage].regions[0];
                Some(roadmap.add(RoadNode { kind: RoadNodeKind::Passage(passage as u32), region, position }))
            })
            .collect();
        let parts: Vec<region::RegionPart> = (0..map.regions.len() as u32)
            .map(|number| {
                let region = RegionNumber(number);
                let ground = region::Ground { map, field: &field, exits: &exits, passages: &passages };
                region::add_region(&mut roadmap, &ground, region, bounds[region.index()], options)
            })
            .collect();
        connection::connect(&mut roadmap, map, &parts, options);
        roadmap
    }

    /// A place.
    #[must_use]
    pub fn place(&self, place: PlaceNumber) -> &RegionPlace {
        &self.places[place.index()]
    }

    /// A node.
    #[must_use]
    pub fn node(&self, node: RoadNodeNumber) -> &RoadNode {
        &self.nodes[node.index()]
    }

    fn add(&mut self, node: RoadNode) -> RoadNodeNumber {
        self.nodes.push(node);
        RoadNodeNumber(self.nodes.len() as u32 - 1)
    }
}
