//! A roadmap as a graph: nodes and ways, and the places and connections on them.

use hssh_topology::Olp;

use crate::place::{LocalStar, PlaceNumber};
use crate::region::RegionNumber;

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
    /// A passage, by its index in [`RegionMap::passages`](crate::region::RegionMap::passages).
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

    pub(super) fn add(&mut self, node: RoadNode) -> RoadNodeNumber {
        self.nodes.push(node);
        RoadNodeNumber(self.nodes.len() as u32 - 1)
    }
}

/// A place.
#[derive(Clone, PartialEq, Debug)]
pub struct RegionPlace {
    /// The region it is in.
    pub region: RegionNumber,
    /// Its node in the roadmap.
    pub node: RoadNodeNumber,
    /// Where it is, in metres.
    pub center: [f64; 2],
    /// How far obstacles are from it, in metres.
    pub clearance: f64,
    /// Its star; a place without any way out has none.
    pub star: Option<LocalStar>,
}

/// What leads from one place to another without passing a third.
#[derive(Clone, PartialEq, Debug)]
pub struct Connection {
    /// The places with the ends of their stars.
    pub ends: [(PlaceNumber, Olp); 2],
    /// The passages on the way, by their indices in [`RegionMap::passages`](crate::region::RegionMap::passages): none within a corridor.
    pub passages: Vec<u32>,
    /// The ways, by their indices in [`Roadmap::ways`], in the order in which they are driven.
    pub ways: Vec<u32>,
    /// The corners of the line from place to place, in metres.
    pub line: Vec<[f64; 2]>,
    /// How long it is, in metres.
    pub length: f64,
    /// How wide it is at its narrowest, in metres.
    pub width: f64,
}
