//! What places a grid map or a log has: their gateways, their stars, and what connects them.

use std::fmt;

use hssh_local::{
    DoorOptions, Gateway, LocalStar, OccupancyGrid, PlaceGraph, PlaceKind, PlaceNumber, hidden_area,
};
use hssh_topology::Olp;
use serde::{Deserialize, Serialize};

use crate::answer::{EndReference, counted};

/// The places of a map or along a log; metres and radians in the frame of the map, or of the log's first scan.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlacesAccount {
    /// `hssh-places`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The map or the log, as it was given.
    pub name: String,
    /// The map; absent with logs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridSize>,
    /// The places; with logs, visit by visit.
    pub places: Vec<PlaceAccount>,
    /// Which of their ends lead to one another; of maps only.
    pub connections: Vec<[EndReference; 2]>,
    /// Narrow points of the medial axis; of maps only.
    pub constrictions: Vec<ConstrictionAccount>,
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
    /// `passage`, `dead end`, `corner` or `junction`.
    pub kind: String,
    /// Its center.
    pub center: [f64; 2],
    /// How far the center is from the nearest obstacle; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance: Option<f64>,
    /// Its star, as the thesis writes it.
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

impl PlacesAccount {
    /// The places of a grid map.
    #[must_use]
    pub fn of_map(name: &str, graph: &PlaceGraph, grid: &OccupancyGrid) -> Self {
        let places = graph.places.iter();
        let end = |&(place, olp): &(PlaceNumber, Olp)| EndReference {
            place: place.0,
            end: graph.place(place).star.star.name(olp).to_string(),
        };
        let criterion = DoorOptions::default();
        let constriction = |gateway: &Gateway| {
            let hidden_area = hidden_area(grid, gateway, &criterion);
            let is_door = criterion.accept(gateway, hidden_area);
            ConstrictionAccount { gateway: GatewayAccount::new(gateway), hidden_area, is_door }
        };
        PlacesAccount {
            format: "hssh-places".to_owned(),
            version: 1,
            name: name.to_owned(),
            grid: Some(GridSize {
                width: grid.lattice().width() as u64,
                height: grid.lattice().height() as u64,
                resolution: grid.lattice().resolution(),
            }),
            places: places
                .map(|place| PlaceAccount::new(place.kind, place.center, place.clearance, &place.star))
                .collect(),
            connections: graph.connections.iter().map(|found| found.ends.each_ref().map(end)).collect(),
            constrictions: graph.constrictions.iter().map(constriction).collect(),
        }
    }

    /// The places along a log, visit by visit.
    #[must_use]
    pub fn along_log(name: &str, places: Vec<PlaceAccount>) -> Self {
        PlacesAccount {
            format: "hssh-places".to_owned(),
            version: 1,
            name: name.to_owned(),
            grid: None,
            places,
            connections: Vec::new(),
            constrictions: Vec::new(),
        }
    }
}

impl fmt::Display for PlacesAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.grid {
            Some(GridSize { width, height, resolution }) => writeln!(
                f,
                "{}: {width} × {height} cells of {resolution} m; {}, {}",
                self.name,
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
        for (number, place) in self.places.iter().enumerate() {
            f.write_str(&place.to_text(number))?;
        }
        for [from, to] in &self.connections {
            writeln!(f, "{} {} leads to {} {}", from.place, from.end, to.place, to.end)?;
        }
        for door in self.constrictions.iter().filter(|found| found.is_door) {
            let ([x, y], width) = (door.gateway.position, door.gateway.width);
            writeln!(f, "a door at ({x:.1}, {y:.1}), {width:.1} m wide")?;
        }
        Ok(())
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
            star: star.star.to_string(),
            ends: ends.collect(),
        }
    }

    /// The place under a number, for people to read.
    #[must_use]
    pub fn to_text(&self, number: usize) -> String {
        let [x, y] = self.center;
        let mut text = format!("{number}: {} at ({x:.1}, {y:.1}), {}\n", self.kind, self.star);
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
