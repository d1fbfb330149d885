//! Regions of a grid map and the passages between them.

use hssh_local::{Passage, RegionMap, RegionNumber, RoadNodeKind, Roadmap};
use serde::{Deserialize, Serialize};

use super::GatewayAccount;

/// A region; metres in the frame of the map.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RegionAccount {
    /// `room`, `corridor`, `hall` or `doorway`; `outside` if the end of the map bounds it more than walls.
    pub kind: String,
    /// What people call it, if that was said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Square metres.
    pub area: f64,
    /// Metres: four times the mean clearance, which of a long corridor is its width.
    pub width: f64,
    /// The places in it.
    pub places: Vec<u32>,
    /// The passages that it leads through.
    pub passages: Vec<u32>,
    /// Its color in pictures, as `#rrggbb`.
    pub color: String,
    /// The rings around it, counterclockwise, the largest first; the first corner is not repeated.
    pub outline: Vec<Vec<[f64; 2]>>,
    /// The rings around what is cut out of it, clockwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// Where two regions lead to one another.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PassageAccount {
    /// `door`, if one is more probable than none, or `opening`.
    pub kind: String,
    /// How probably it has a door.
    pub door_probability: f64,
    /// The regions; the bearing points from the first to the second.
    pub regions: [u32; 2],
    /// Whether a robot fits through.
    pub is_passable: bool,
    /// Where it is.
    #[serde(flatten)]
    pub gateway: GatewayAccount,
}

impl RegionAccount {
    /// All regions of a map.
    #[must_use]
    pub fn all(map: &RegionMap, roadmap: &Roadmap) -> Vec<Self> {
        let account = |(number, outline): (u32, hssh_local::Outline)| {
            let number = RegionNumber(number);
            let region = map.region(number);
            let places = (0..).zip(&roadmap.places).filter(|(_, place)| place.region == number);
            let [red, green, blue] = number.color();
            RegionAccount {
                kind: region.kind.name().to_owned(),
                name: None,
                area: region.area,
                width: region.width,
                places: places.map(|(place, _)| place).collect(),
                passages: map.passages_of(number).collect(),
                color: format!("#{red:02x}{green:02x}{blue:02x}"),
                outline: outline.around,
                holes: outline.holes,
            }
        };
        (0..).zip(map.outlines()).map(account).collect()
    }

    /// What to call the region with a number.
    #[must_use]
    pub fn title(&self, number: usize) -> String {
        self.name.clone().unwrap_or_else(|| format!("{} {number}", self.kind))
    }

    /// The region under a number, for people to read.
    #[must_use]
    pub fn to_text(&self, number: usize) -> String {
        let name = self.name.as_ref().map(|name| format!(" \u{201c}{name}\u{201d}")).unwrap_or_default();
        format!("region {number}: {}{name}, {:.1} m², about {:.1} m wide\n", self.kind, self.area, self.width)
    }
}

impl PassageAccount {
    /// All passages of a map.
    #[must_use]
    pub fn all(map: &RegionMap, roadmap: &Roadmap) -> Vec<Self> {
        let mut is_passable = vec![false; map.passages.len()];
        for node in &roadmap.nodes {
            if let RoadNodeKind::Passage(passage) = node.kind {
                is_passable[passage as usize] = true;
            }
        }
        let account = |(passage, is_passable): (&Passage, bool)| PassageAccount {
            kind: passage.kind().to_owned(),
            door_probability: passage.door_probability,
            regions: passage.regions.map(|region| region.0),
            is_passable,
            gateway: GatewayAccount::new(&passage.gateway),
        };
        map.passages.iter().zip(is_passable).map(account).collect()
    }

    /// The passage, for people to read.
    #[must_use]
    pub fn to_text(&self) -> String {
        let PassageAccount { kind, door_probability, regions: [from, to], is_passable, gateway } = self;
        let article = if kind == "door" { "a" } else { "an" };
        let tight = if *is_passable { "" } else { ", too tight for the robot" };
        format!(
            "{article} {kind} at ({:.1}, {:.1}) between regions {from} and {to}, {:.2} m wide, a door with {:.0}%{tight}\n",
            gateway.position[0],
            gateway.position[1],
            gateway.width,
            100.0 * door_probability
        )
    }
}
