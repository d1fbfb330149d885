//! The building that a log shows: its regions, where they lead to one another, and in which of them the robot was.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use super::visit::VisitRecord;
use super::words::counted;

/// A region of the building; metres in the frame of the first place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredRegion {
    /// `room`, `corridor`, `hall` or `doorway`; `unexplored` if too little of its rim was seen to tell.
    pub kind: String,
    /// Square metres, as far as it was seen.
    pub area: f64,
    /// Metres: four times the mean clearance, which of a long corridor is its width.
    pub width: f64,
    /// The part of its rim that is wall, from 0 to 1; the rest was never looked at.
    pub explored: f64,
    /// How many times the robot was in it.
    pub stays: u64,
    /// The places of the first map in it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<u32>,
    /// The passages that it leads through.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passages: Vec<u32>,
    /// The rings around it, counterclockwise, the largest first; the first corner is not repeated.
    pub outline: Vec<Vec<[f64; 2]>>,
    /// The rings around what is cut out of it, clockwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// Where two regions of the building lead to one another; metres in the frame of the first place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnsweredPassage {
    /// `door`, if one is more probable than none, or `opening`.
    pub kind: String,
    /// How probably it has a door.
    pub door_probability: f64,
    /// The regions.
    pub regions: [u32; 2],
    /// How wide it is.
    pub width: f64,
    /// The two ends of the line across.
    pub line: [[f64; 2]; 2],
}

/// A stretch of the robot's way in one region.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct AnsweredStay {
    /// The region.
    pub region: u32,
    /// The first and the last scan taken in it.
    pub scans: [u64; 2],
}

/// The building as all scans draw it where the first map has them.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct AnsweredBuilding {
    /// Its regions.
    pub regions: Vec<AnsweredRegion>,
    /// Where they lead to one another.
    pub passages: Vec<AnsweredPassage>,
    /// Where the robot was, region by region, in the order of the scans.
    pub stays: Vec<AnsweredStay>,
}

impl AnsweredRegion {
    /// What to call the region with a number.
    #[must_use]
    pub fn title(&self, number: usize) -> String {
        format!("{} {number}", self.kind)
    }
}

impl AnsweredBuilding {
    /// The building for people to read: what there is of each kind, and the regions that the robot was in, with the visits
    /// there, counted from 0, the start.
    pub(super) fn to_text(&self, visits: &[VisitRecord]) -> String {
        let entered: Vec<usize> =
            (0..self.regions.len()).filter(|&region| self.regions[region].stays > 0).collect();
        let mut text = format!("\nThe building: {}; the robot was in {}\n", self.contents(), entered.len());
        for number in entered {
            let region = &self.regions[number];
            let own = |(_, visit): &(usize, &VisitRecord)| visit.region == Some(number as u32);
            let own: Vec<String> =
                (0..).zip(visits).filter(own).map(|(visit, _)| visit.to_string()).collect();
            let visited = match &own[..] {
                [] => "no visit to a place in it".to_owned(),
                [one] => format!("visit {one}"),
                several => format!("visits {}", several.join(", ")),
            };
            let _ = writeln!(
                text,
                "  {}, {:.1} m², about {:.1} m wide: {visited}",
                region.title(number),
                region.area,
                region.width
            );
        }
        text
    }

    /// How much there is of each kind.
    fn contents(&self) -> String {
        let count = |kind: &str| self.regions.iter().filter(|region| region.kind == kind).count();
        let doors = self.passages.iter().filter(|passage| passage.kind == "door").count();
        let mut parts: Vec<String> = ["room", "corridor", "hall", "doorway"]
            .into_iter()
            .filter(|kind| count(kind) > 0)
            .map(|kind| counted(count(kind), kind))
            .collect();
        if count("unexplored") > 0 {
            parts.push(format!("{} hardly looked into", count("unexplored")));
        }
        parts.push(counted(doors, "door"));
        parts.join(", ")
    }
}
