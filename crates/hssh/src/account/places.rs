//! What a grid map or a log has: regions and the passages between them, places with their gateways and stars, and what
//! connects these.

use std::fmt;

use hssh_local::{
    DoorOptions, Gateway, Lattice, LocalStar, OccupancyGrid, PlaceConnection, PlaceGraph, PlaceKind,
    PlaceNumber, RegionMap, Roadmap, hidden_area,
};
use hssh_topology::Olp;
use serde::{Deserialize, Serialize};

use super::regions::{PassageAccount, RegionAccount};
use super::roadmap::RoadmapAccount;
use super::scale::doubted_scale;
use crate::answer::{EndReference, counted};

/// The places of a map or along a log; metres and radians in the frame of the map, or of the log's first scan.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlacesAccount {
    /// `hssh-places`.
    pub format: String,
    /// 2.
    pub version: u32,
    /// The map or the log, as it was given.
    pub name: String,
    /// What speaks against all the rest, if anything does: a map that is hardly drawn to the scale that it says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// The map; absent with logs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridSize>,
    /// The regions; of maps only.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionAccount>,
    /// Where regions lead to one another; of maps only.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passages: Vec<PassageAccount>,
    /// The places; with logs, visit by visit.
    pub places: Vec<PlaceAccount>,
    /// Which of their ends lead to one another; of maps only.
    pub connections: Vec<ConnectionAccount>,
    /// What can be driven; of the places of regions only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roadmap: Option<RoadmapAccount>,
    /// Narrow points of the medial axis; of all places of the axis only.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constrictions: Vec<ConstrictionAccount>,
}

/// What leads from one place to another.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ConnectionAccount {
    /// The places with the ends of their stars.
    pub ends: [EndReference; 2],
    /// The passages on the way; none within a corridor.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passages: Vec<u32>,
    /// The ways of the roadmap in the order in which they are driven.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ways: Vec<u32>,
    /// Metres from place to place along the line.
    pub length: f64,
    /// Metres between the obstacles where it is narrowest.
    pub width: f64,
    /// The corners of the line from place to place.
    pub line: Vec<[f64; 2]>,
}

/// How large a grid map is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct GridSize {
    /// Cells from left to right.
    pub width: u64,
    /// Cells from bottom to top.
    pub height: u64,
    /// Metres from one cell to the next.
    pub resolution: f64,
}

/// A narrow point.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ConstrictionAccount {
    /// Where it is.
    #[serde(flatten)]
    pub gateway: GatewayAccount,
    /// Square metres that are in sight from one side of it only.
    pub hidden_area: f64,
    /// Whether it is a door.
    pub is_door: bool,
}

/// A place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlaceAccount {
    /// `passage`, `dead end`, `corner` or `junction`, or `closed` if nothing leads out.
    pub kind: String,
    /// Its center.
    pub center: [f64; 2],
    /// How far the center is from the nearest obstacle; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance: Option<f64>,
    /// The region it is in; of maps only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<u32>,
    /// Its star, as the thesis writes it; empty if nothing leads out.
    pub star: String,
    /// The ends of the star, clockwise.
    pub ends: Vec<StarEndAccount>,
}

/// An end of a star.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct StarEndAccount {
    /// Its name.
    pub name: String,
    /// Where it points.
    pub bearing: f64,
    /// Where it leads through; absent if it is closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gateway: Option<GatewayAccount>,
}

/// A gateway.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct GatewayAccount {
    /// Its middle.
    pub position: [f64; 2],
    /// Where it points, away from the place.
    pub bearing: f64,
    /// How wide it is.
    pub width: f64,
    /// Its two ends.
    pub line: [[f64; 2]; 2],
}

/// Why a text is no account of places.
#[derive(Debug, thiserror::Error)]
pub enum PlacesError {
    /// It is not the JSON of one.
    #[error("this is no account of places: {0}")]
    Json(#[from] serde_json::Error),
    /// Another format.
    #[error("the format is `{0}`, not `{format}`", format = PlacesAccount::FORMAT)]
    OtherFormat(String),
    /// Another version.
    #[error("the account has version {0}, this library reads version {version}", version = PlacesAccount::VERSION)]
    OtherVersion(u32),
}

impl PlacesAccount {
    /// What accounts of places call their format.
    pub const FORMAT: &str = "hssh-places";
    /// The version of the format that this library writes.
    pub const VERSION: u32 = 2;

    /// Reads what `hssh stars --json` prints.
    ///
    /// # Errors
    /// If the text is no JSON, no account of places, or one of another version.
    pub fn from_json(text: &str) -> Result<Self, PlacesError> {
        /// What every version of the format has.
        #[derive(Deserialize)]
        struct Head {
            format: String,
            version: u32,
        }
        let Head { format, version } = serde_json::from_str(text)?;
        if format != Self::FORMAT {
            return Err(PlacesError::OtherFormat(format));
        }
        if version != Self::VERSION {
            return Err(PlacesError::OtherVersion(version));
        }
        Ok(serde_json::from_str(text)?)
    }

    /// The regions of a grid map, with a place for each and for each junction of a corridor.
    #[must_use]
    pub fn of_regions(name: &str, map: &RegionMap, roadmap: &Roadmap, radius: f64) -> Self {
        let place = |place: &hssh_local::RegionPlace| {
            let mut account = match &place.star {
                Some(star) => PlaceAccount::new(star.kind(), place.center, place.clearance, star),
                None => PlaceAccount::closed(place.center, place.clearance),
            };
            account.region = Some(place.region.0);
            account
        };
        let end = |&(place, olp): &(PlaceNumber, Olp)| EndReference {
            place: place.0,
            end: roadmap
                .place(place)
                .star
                .as_ref()
                .map_or_else(String::new, |star| star.star.name(olp).to_string()),
        };
        let connection = |found: &hssh_local::Connection| ConnectionAccount {
            ends: found.ends.each_ref().map(end),
            passages: found.passages.clone(),
            ways: found.ways.clone(),
            length: found.length,
            width: found.width,
            line: found.line.clone(),
        };
        let (regions, passages) = (RegionAccount::all(map, roadmap), PassageAccount::all(map, roadmap));
        PlacesAccount {
            doubt: doubted_scale(&regions, &passages),
            grid: Some(GridSize::of(map.lattice())),
            regions,
            passages,
            places: roadmap.places.iter().map(place).collect(),
            connections: roadmap.connections.iter().map(connection).collect(),
            roadmap: Some(RoadmapAccount::new(roadmap, radius)),
            ..Self::along_log(name, Vec::new())
        }
    }

    /// All places of the medial axis of a grid map, in its regions.
    #[must_use]
    pub fn of_axis(
        name: &str,
        map: &RegionMap,
        roadmap: &Roadmap,
        graph: &PlaceGraph,
        grid: &OccupancyGrid,
    ) -> Self {
        let place = |place: &hssh_local::GridPlace| {
            let mut account = PlaceAccount::new(place.kind, place.center, place.clearance, &place.star);
            account.region = map.region_at(place.center).map(|region| region.0);
            account
        };
        let end = |&(place, olp): &(PlaceNumber, Olp)| EndReference {
            place: place.0,
            end: graph.place(place).star.star.name(olp).to_string(),
        };
        let connection = |found: &PlaceConnection| {
            let line: Vec<[f64; 2]> = found.line.iter().map(|point| point.point).collect();
            let length =
                line.windows(2).map(|pair| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1])).sum();
            let narrowest = found.line.iter().map(|point| point.clearance).fold(f64::INFINITY, f64::min);
            let ends = found.ends.each_ref().map(end);
            ConnectionAccount {
                ends,
                passages: Vec::new(),
                ways: Vec::new(),
                length,
                width: 2.0 * narrowest,
                line,
            }
        };
        let criterion = DoorOptions::default();
        let constriction = |gateway: &Gateway| {
            let hidden_area = hidden_area(grid, gateway, &criterion);
            let is_door = criterion.accept(gateway, hidden_area);
            ConstrictionAccount { gateway: GatewayAccount::new(gateway), hidden_area, is_door }
        };
        let mut regions = RegionAccount::all(map, roadmap);
        let places: Vec<PlaceAccount> = graph.places.iter().map(place).collect();
        for (number, region) in (0..).zip(&mut regions) {
            let inside = (0..).zip(&places).filter(|(_, place)| place.region == Some(number));
            region.places = inside.map(|(place, _)| place).collect();
        }
        let passages = PassageAccount::all(map, roadmap);
        PlacesAccount {
            doubt: doubted_scale(&regions, &passages),
            grid: Some(GridSize::of(grid.lattice())),
            regions,
            passages,
            places,
            connections: graph.connections.iter().map(connection).collect(),
            constrictions: graph.constrictions.iter().map(constriction).collect(),
            ..Self::along_log(name, Vec::new())
        }
    }

    /// The places along a log, visit by visit.
    #[must_use]
    pub fn along_log(name: &str, places: Vec<PlaceAccount>) -> Self {
        PlacesAccount {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            name: name.to_owned(),
            doubt: None,
            grid: None,
            regions: Vec::new(),
            passages: Vec::new(),
            places,
            connections: Vec::new(),
            roadmap: None,
            constrictions: Vec::new(),
        }
    }
}

impl fmt::Display for PlacesAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(doubt) = &self.doubt {
            writeln!(f, "DOUBTFUL: {doubt}")?;
        }
        match &self.grid {
            Some(GridSize { width, height, resolution }) => writeln!(
                f,
                "{}: {width} × {height} cells of {resolution} m; {}, {}, {}",
                self.name,
                counted(self.regions.len(), "region"),
                counted(self.places.len(), "place"),
                counted(self.connections.len(), "connection"),
            )?,
            None => {
                let visits = counted(self.places.len(), "visit");
                writeln!(f, "{}: {visits}, in the frame of the robot's track", self.name)?;
            }
        }
        if self.places.is_empty() {
            writeln!(
                f,
                "no place was found: nowhere are there other ways out than on and back; --shallowest makes shorter ways count"
            )?;
        }
        for (number, region) in self.regions.iter().enumerate() {
            f.write_str(&region.to_text(number))?;
        }
        for passage in &self.passages {
            f.write_str(&passage.to_text())?;
        }
        for (number, place) in self.places.iter().enumerate() {
            f.write_str(&place.to_text(number))?;
        }
        for ConnectionAccount { ends: [from, to], length, width, .. } in &self.connections {
            writeln!(
                f,
                "{} {} leads to {} {}: {length:.1} m, {width:.1} m wide",
                from.place, from.end, to.place, to.end
            )?;
        }
        for door in self.constrictions.iter().filter(|found| found.is_door) {
            let ([x, y], width) = (door.gateway.position, door.gateway.width);
            writeln!(f, "a door at ({x:.1}, {y:.1}), {width:.1} m wide")?;
        }
        Ok(())
    }
}

impl GridSize {
    fn of(lattice: &Lattice) -> Self {
        GridSize {
            width: u64::from(lattice.width()),
            height: u64::from(lattice.height()),
            resolution: lattice.resolution(),
        }
    }
}

impl GatewayAccount {
    /// The account of a gateway.
    #[must_use]
    pub fn new(gateway: &Gateway) -> Self {
        let Gateway { position, bearing, width, line } = *gateway;
        GatewayAccount { position, bearing, width, line }
    }
}

impl PlaceAccount {
    /// The account of a place.
    #[must_use]
    pub fn new(kind: PlaceKind, center: [f64; 2], clearance: f64, star: &LocalStar) -> Self {
        let ends = star.star.olps().map(|olp| StarEndAccount {
            name: star.star.name(olp).to_string(),
            bearing: star.bearings[olp.index()],
            gateway: star.gateways[olp.index()].as_ref().map(GatewayAccount::new),
        });
        let kind = match kind {
            PlaceKind::Passage => "passage",
            PlaceKind::DeadEnd => "dead end",
            PlaceKind::Corner => "corner",
            PlaceKind::Junction => "junction",
        };
        PlaceAccount {
            kind: kind.to_owned(),
            center,
            clearance: Some(clearance).filter(|metres| metres.is_finite()),
            region: None,
            star: star.star.to_string(),
            ends: ends.collect(),
        }
    }

    /// The account of a place that nothing leads out of.
    fn closed(center: [f64; 2], clearance: f64) -> Self {
        let clearance = Some(clearance).filter(|metres| metres.is_finite());
        PlaceAccount {
            kind: "closed".to_owned(),
            center,
            clearance,
            region: None,
            star: String::new(),
            ends: Vec::new(),
        }
    }

    /// The place under a number, for people to read.
    #[must_use]
    pub fn to_text(&self, number: usize) -> String {
        let [x, y] = self.center;
        let region = self.region.map(|region| format!(" in region {region}")).unwrap_or_default();
        let star = if self.star.is_empty() { "no way out" } else { &self.star };
        let mut text = format!("{number}: {} at ({x:.1}, {y:.1}){region}, {star}\n", self.kind);
        for end in &self.ends {
            let Some(gateway) = &end.gateway else { continue };
            let [x, y] = gateway.position;
            text += &format!(
                "    {} at {:.0}° through ({x:.1}, {y:.1}), {:.1} m wide\n",
                end.name,
                end.bearing.to_degrees(),
                gateway.width
            );
        }
        text
    }
}
