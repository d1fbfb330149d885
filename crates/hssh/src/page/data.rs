//! What a page shows, as plain data: the page's script draws it and nothing else. Metres and radians in the frame of the first place;
//! places, visits, travels and ends are counted from 0, ranks from 1; an exploration of n travels has n + 1 visits.

use serde::{Deserialize, Serialize};

use crate::answer::{
    AnswerWarning, AnsweredInput, CertificateSummary, CostSheet, MapDifference, MapMeasure, ReadingAccount,
    SearchSummary, Verdict,
};

/// All that a page shows.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageData {
    /// [`PageData::FORMAT`].
    pub format: String,
    /// [`PageData::VERSION`].
    pub version: u32,
    /// Where news come from, as Server-Sent Events: a message is other data for the whole page, or, if it has no `format`, an object with some of
    /// these fields, which replace those that the page has. Events named `robot` say where the robot is: its `pose`, x, y and θ, and what the
    /// laser `hits`; an event `end`, that no more will come. Absent in a page that stays as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub live: Option<String>,
    /// Why there is no map yet, of a page that waits for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waiting: Option<String>,
    /// What was to be explained.
    pub input: AnsweredInput,
    /// What is missing from the input, if that matters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<String>,
    /// Why the best map may well be wrong, if it may.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// What came of it.
    pub verdict: Verdict,
    /// What is proved, and on what trust.
    pub certificate: CertificateSummary,
    /// How it was searched.
    pub search: SearchSummary,
    /// What was taken for misread; maps and visits are those of the exploration as it must have been.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub readings: Option<ReadingAccount>,
    /// What was decided with little reason, or left out.
    pub warnings: Vec<AnswerWarning>,
    /// The stars that were seen.
    pub stars: Vec<PageStar>,
    /// The visits of all travels considered.
    pub visits: Vec<PageVisit>,
    /// The ranking, the best map first.
    pub maps: Vec<PageMap>,
    /// The rank of the map that the page opens with.
    pub shown: u64,
    /// Where there is no ranking: the best map of the first travels, as many as any map explains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<PageMap>,
    /// Grids of the building, each in the frame of the maps that name it.
    pub grids: Vec<PageImage>,
    /// What was believed on the way.
    pub history: PageHistory,
    /// The hypotheses that were made, or the more interesting ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tree: Option<PageTree>,
}

impl PageData {
    /// What the data of pages call their format.
    pub const FORMAT: &str = "hssh-page";
    /// The version of the data that this library writes.
    pub const VERSION: u32 = 1;
}

/// A star as it was seen.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageStar {
    /// Its name.
    pub name: String,
    /// Its ends, clockwise.
    pub ends: Vec<PageEnd>,
}

/// An end of a star.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageEnd {
    /// The local path's number and its direction, as in `1+`; `1-` is the other end of the same local path.
    pub name: String,
    /// Whether it cannot be travelled.
    pub closed: bool,
    /// What else is known of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Where it points in the frame of the visit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bearing: Option<f64>,
}

/// A visit, the same in all maps.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageVisit {
    /// The star seen, by its number among [`PageData::stars`].
    pub star: u32,
    /// The end that the robot came in by, as a number of that star; absent at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entry: Option<u32>,
    /// The end that it left by; absent at the last visit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exit: Option<u32>,
    /// With readings: the visit of the exploration as told; absent if it was passed without a report.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub told: Option<u64>,
    /// Of logs: the scan taken nearest to the place's center.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scan: Option<u64>,
    /// Of logs: the first and the last scan from which the place was sighted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans: Option<[u64; 2]>,
    /// When these were taken, in seconds of the log's clock.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<[f64; 2]>,
    /// Of logs: the local map, in the frame of the visit, in which bearings are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<PageImage>,
    /// Of logs: where on [`PageMap::way`] the robot was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u32>,
}

/// A gray image and where it lies.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageImage {
    /// A PNG in base64: obstacles are black, free space is white, the unknown is gray.
    pub png: String,
    /// The left side: m.
    pub x: f64,
    /// The lower side: m.
    pub y: f64,
    /// m.
    pub width: f64,
    /// m.
    pub height: f64,
    /// By how much it is turned around the origin, after it was put there: rad, counterclockwise.
    pub turn: f64,
}

/// A map. What joins its places and how it explains the visits follows from its branch.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageMap {
    /// Its place in the ranking.
    pub rank: u64,
    /// The choices that lead to it, one word for each travel: `p`, as predicted; `n`, to a new place; `c` and a number, back to a known
    /// place by the gateway with that number. Ends are numbered place by place, clockwise, closed ones as well.
    pub branch: String,
    /// Whether it is proved that none is better.
    pub optimal: bool,
    /// Whether it is as good as the first.
    pub tied: bool,
    /// By posterior: its probability, at least and at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability: Option<[f64; 2]>,
    /// By posterior: what it costs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub costs: Option<CostSheet>,
    /// What preference looks at.
    pub measure: MapMeasure,
    /// No gateway is pending.
    pub closed: bool,
    /// What tells it from the first map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<MapDifference>,
    /// Whether its places lie where measured travels put them; otherwise the drawing is a scheme, in units of a link.
    pub measured: bool,
    /// Its places.
    pub places: Vec<PagePlace>,
    /// Of logs: its grid, by its number among [`PageData::grids`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<u32>,
    /// Of logs: the way of the robot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 2]>,
}

/// Where a place of a map is drawn.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PagePlace {
    /// m, or links.
    pub x: f64,
    /// m, or links.
    pub y: f64,
    /// Where its ends point, clockwise as the star of its first visit has them.
    pub directions: Vec<f64>,
    /// Half the axes of the ellipse that holds it with a probability of 95 %, the greater one first, and the direction of that one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ellipse: Option<[f64; 3]>,
}

/// What was believed on the way.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct PageHistory {
    /// After each travel, the start first, as far as it was searched.
    pub beliefs: Vec<PageBelief>,
    /// Why it ends before the last travel, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<String>,
}

/// The best map of the travels so far, by what is new in it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageBelief {
    /// How many words of the branch are those of the belief before.
    pub kept: u32,
    /// The words that follow.
    pub then: String,
    /// How many maps were as good, this one among them.
    pub tied: u64,
    /// Whether it was proved that none was better.
    pub proved: bool,
    /// Its probability, at least and at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability: Option<[f64; 2]>,
    /// Places with their poses (number, x, y, θ) that are new or lie elsewhere than was told before, by more than 0.02 m or 0.01 rad. Empty where
    /// nothing is laid out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub moved: Vec<[f64; 4]>,
}

/// A tree of hypotheses: parents come before their children.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageTree {
    /// The hypotheses shown, the root first.
    pub nodes: Vec<PageNode>,
    /// How many there are.
    pub made: u64,
}

/// A hypothesis.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PageNode {
    /// The number of its parent among those shown; absent for the root.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parent: Option<u32>,
    /// How it follows: a word as in [`PageMap::branch`]; empty for the root.
    pub follows: String,
    /// What became of it.
    pub fate: PageFate,
    /// How many hypotheses below it are not shown.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub hidden: u64,
    /// Its rank, if it is a map of the ranking.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rank: Option<u64>,
}

/// What became of a hypothesis.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PageFate {
    /// It was not looked at any further.
    Open,
    /// Others follow from it.
    Grown,
    /// The next travel refuted it.
    Refuted,
    /// The axioms removed all that would follow.
    Removed,
    /// It explains every travel that there is to explain.
    Final,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}
