//! What a robot can drive by through a grid map.

use hssh_local::{RoadNode, RoadNodeKind, Roadmap, Way};
use serde::{Deserialize, Serialize};

/// The ways through a map; metres in its frame.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RoadmapAccount {
    /// The radius of the robot that it is for.
    pub radius: f64,
    /// Where ways begin and end.
    pub nodes: Vec<RoadNodeAccount>,
    /// The ways; each can be driven in both directions.
    pub ways: Vec<WayAccount>,
}

/// A node of a roadmap.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RoadNodeAccount {
    /// `place`, `passage`, or `branch` where ways only part.
    pub kind: String,
    /// The number of the place or the passage.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<u32>,
    /// The region it is in; of a passage the first of the two.
    pub region: u32,
    /// Where it is.
    pub position: [f64; 2],
}

/// A way from one node to another.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct WayAccount {
    /// The nodes.
    pub ends: [u32; 2],
    /// The region it lies in.
    pub region: u32,
    /// How long it is.
    pub length: f64,
    /// Twice the least distance from its line to an obstacle.
    pub width: f64,
    /// The corners of its line, the nodes included.
    pub line: Vec<[f64; 2]>,
}

impl RoadmapAccount {
    /// The account of a roadmap for a robot of a radius.
    #[must_use]
    pub fn new(roadmap: &Roadmap, radius: f64) -> Self {
        let node = |node: &RoadNode| {
            let (kind, number) = match node.kind {
                RoadNodeKind::Place(place) => ("place", Some(place.0)),
                RoadNodeKind::Passage(passage) => ("passage", Some(passage)),
                RoadNodeKind::Branch => ("branch", None),
            };
            RoadNodeAccount { kind: kind.to_owned(), number, region: node.region.0, position: node.position }
        };
        let way = |way: &Way| WayAccount {
            ends: way.ends.map(|end| end.0),
            region: way.region.0,
            length: way.length,
            width: way.width,
            line: way.line.clone(),
        };
        RoadmapAccount {
            radius,
            nodes: roadmap.nodes.iter().map(node).collect(),
            ways: roadmap.ways.iter().map(way).collect(),
        }
    }
}
