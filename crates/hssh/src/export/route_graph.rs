//! Places and the ways between them, whatever they come from: what all formats are written of.

use super::error::ExportError;
use super::names::{node_names, unique};
use super::provenance::Provenance;
use crate::account::PlacesAccount;
use crate::answer::{AnsweredBuilding, AnsweredMap, AnsweredPlace, EndReference, EndState};

/// Places, or whatever else ways meet at, and ways; metres and radians in one frame.
#[derive(Clone, PartialEq, Debug)]
pub struct RouteGraph {
    /// Where it comes from.
    pub provenance: Provenance,
    /// What ways join.
    pub nodes: Vec<RouteNode>,
    /// The ways; each can be driven in both directions.
    pub ways: Vec<RouteWay>,
    /// The doors, as far as they are known.
    pub doors: Vec<Door>,
    /// The radius of the robot that the ways are for, if they are for one.
    pub radius: Option<f64>,
}

/// Where ways meet.
#[derive(Clone, PartialEq, Debug)]
pub struct RouteNode {
    /// Its name; no other node has it.
    pub name: String,
    /// `place`; of roadmaps also `passage`, or `branch` where ways only part.
    pub kind: String,
    /// Where it is; `None` in a map without measured travels.
    pub position: Option<[f64; 2]>,
    /// Of a topological map: where the x axis of the place's frame points.
    pub heading: Option<f64>,
    /// Of a place: its star, or what that is called.
    pub star: Option<String>,
    /// Of a place: how many of its gateways were never travelled.
    pub pending: Option<u32>,
}

/// A door.
#[derive(Clone, PartialEq, Debug)]
pub struct Door {
    /// Its name; no other door has it.
    pub name: String,
    /// Its two posts.
    pub posts: [[f64; 2]; 2],
}

/// A way between two nodes, which may be the same.
#[derive(Clone, PartialEq, Debug)]
pub struct RouteWay {
    /// The nodes, by number.
    pub ends: [usize; 2],
    /// Of ways between places: the names of the ends of their stars.
    pub gateways: Option<[String; 2]>,
    /// The corners from node to node, both included; empty if nothing is known.
    pub line: Vec<[f64; 2]>,
    /// Where the line comes from.
    pub origin: WayOrigin,
    /// Metres between the obstacles where it is narrowest, if that is known.
    pub width: Option<f64>,
}

/// Where the line of a way comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum WayOrigin {
    /// A robot drove along it.
    Driven,
    /// It was planned in a grid map, clear of obstacles.
    Planned,
    /// It is straight, and nobody says that it is clear.
    Straight,
    /// There is no line.
    Unknown,
}

impl WayOrigin {
    /// In a word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            WayOrigin::Driven => "driven",
            WayOrigin::Planned => "planned",
            WayOrigin::Straight => "straight",
            WayOrigin::Unknown => "unknown",
        }
    }
}

impl RouteWay {
    /// How long its line is, in metres; `None` without one.
    #[must_use]
    pub fn length(&self) -> Option<f64> {
        let parts = self.line.windows(2).map(|pair| distance(pair[0], pair[1]));
        (self.line.len() > 1).then(|| parts.sum())
    }
}

impl RouteGraph {
    /// The places and links of a topological map, and the doors of the building where the map shows it.
    ///
    /// # Errors
    /// If a link leads to a place that is not there.
    pub fn of_map(
        provenance: Provenance,
        map: &AnsweredMap,
        building: Option<&AnsweredBuilding>,
    ) -> Result<Self, ExportError> {
        let nodes: Vec<RouteNode> = map.places.iter().enumerate().map(place).collect();
        let way = |(number, link): (usize, &crate::answer::AnsweredLink)| {
            let ends = [index(number, &link.from, &nodes)?, index(number, &link.to, &nodes)?];
            let (line, origin) = line(&link.way, ends.map(|end| nodes[end].position), ends);
            let gateways = Some([link.from.end.clone(), link.to.end.clone()]);
            Ok(RouteWay { ends, gateways, line, origin, width: None })
        };
        let ways = map.links.iter().enumerate().map(way).collect::<Result<_, _>>()?;
        let doors = building.map_or_else(Vec::new, doors);
        Ok(RouteGraph { provenance, nodes, ways, doors, radius: None })
    }

    /// The roadmap of a grid map.
    ///
    /// # Errors
    /// If there is no way on it, or none was made.
    pub fn of_roadmap(account: &PlacesAccount) -> Result<Self, ExportError> {
        let roadmap = account.roadmap.as_ref().ok_or(ExportError::NoRoadmap)?;
        if roadmap.ways.is_empty() {
            return Err(ExportError::NoWay);
        }
        let names = node_names(account, roadmap);
        let node = |(node, name): (&crate::account::RoadNodeAccount, String)| {
            let number = node.number.map(|number| number as usize);
            let place = number.filter(|_| node.kind == "place").and_then(|number| account.places.get(number));
            RouteNode {
                name,
                kind: node.kind.clone(),
                position: Some(node.position),
                heading: None,
                star: place.map(|place| place.star.clone()),
                pending: None,
            }
        };
        let nodes: Vec<RouteNode> = roadmap.nodes.iter().zip(names).map(node).collect();
        let door = |(node, about): (&crate::account::RoadNodeAccount, &RouteNode)| {
            let number = node.number.filter(|_| node.kind == "passage")?;
            let passage = account.passages.get(number as usize).filter(|passage| passage.kind == "door")?;
            Some(Door { name: about.name.clone(), posts: passage.gateway.line })
        };
        let doors = roadmap.nodes.iter().zip(&nodes).filter_map(door).collect();
        let way = |(number, way): (usize, &crate::account::WayAccount)| {
            Ok(RouteWay {
                ends: ends(&format!("way {number}"), way.ends, nodes.len())?,
                gateways: None,
                line: way.line.clone(),
                origin: WayOrigin::Planned,
                width: Some(way.width),
            })
        };
        let ways = roadmap.ways.iter().enumerate().map(way).collect::<Result<_, _>>()?;
        let provenance = Provenance::of_places(account);
        Ok(RouteGraph { provenance, nodes, ways, doors, radius: Some(roadmap.radius) })
    }

    /// The places of a grid map, and which of their ends lead to one another.
    ///
    /// # Errors
    /// If a connection leads to a place that is not there.
    pub fn of_connections(account: &PlacesAccount) -> Result<Self, ExportError> {
        let name = |(number, place): (usize, &crate::account::PlaceAccount)| {
            let region = place.region.and_then(|region| account.regions.get(region as usize));
            region.and_then(|region| region.name.clone()).unwrap_or_else(|| format!("place {number}"))
        };
        let names = unique(account.places.iter().enumerate().map(name));
        let node = |(place, name): (&crate::account::PlaceAccount, String)| RouteNode {
            name,
            kind: "place".to_owned(),
            position: Some(place.center),
            heading: None,
            star: Some(place.star.clone()),
            pending: None,
        };
        let nodes: Vec<RouteNode> = account.places.iter().zip(names).map(node).collect();
        let way = |(number, connection): (usize, &crate::account::ConnectionAccount)| {
            let places = connection.ends.each_ref().map(|end| end.place);
            Ok(RouteWay {
                ends: ends(&format!("connection {number}"), places, nodes.len())?,
                gateways: Some(connection.ends.each_ref().map(|end| end.end.clone())),
                line: connection.line.clone(),
                origin: WayOrigin::Planned,
                width: Some(connection.width),
            })
        };
        let ways = account.connections.iter().enumerate().map(way).collect::<Result<_, _>>()?;
        let provenance = Provenance::of_places(account);
        Ok(RouteGraph { provenance, nodes, ways, doors: Vec::new(), radius: None })
    }

    /// Where a node is.
    ///
    /// # Errors
    /// If that is not known.
    pub fn position(&self, node: usize) -> Result<[f64; 2], ExportError> {
        self.nodes[node].position.ok_or(ExportError::NotPlaced { place: node })
    }
}

/// A place of a topological map.
fn place((number, place): (usize, &AnsweredPlace)) -> RouteNode {
    let pending = place.ends.iter().filter(|end| end.state == EndState::Pending).count();
    RouteNode {
        name: format!("place {number}"),
        kind: "place".to_owned(),
        position: place.pose.map(|pose| [pose.x, pose.y]),
        heading: place.pose.map(|pose| pose.theta),
        star: Some(place.star.clone()),
        pending: Some(pending as u32),
    }
}

/// The passages of a building that probably have a door.
fn doors(building: &AnsweredBuilding) -> Vec<Door> {
    let passages = building.passages.iter().enumerate().filter(|(_, passage)| passage.kind == "door");
    passages.map(|(number, passage)| Door { name: format!("door {number}"), posts: passage.line }).collect()
}

/// The line of a link: as driven, or straight between two places.
fn line(
    driven: &[[f64; 2]],
    positions: [Option<[f64; 2]>; 2],
    ends: [usize; 2],
) -> (Vec<[f64; 2]>, WayOrigin) {
    match positions {
        [Some(_), Some(_)] if driven.len() > 1 => (driven.to_vec(), WayOrigin::Driven),
        [Some(from), Some(to)] if ends[0] != ends[1] => (vec![from, to], WayOrigin::Straight),
        _ => (Vec::new(), WayOrigin::Unknown),
    }
}

fn index(link: usize, end: &EndReference, nodes: &[RouteNode]) -> Result<usize, ExportError> {
    Ok(ends(&format!("link {link}"), [end.place, end.place], nodes.len())?[0])
}

/// The numbers of two nodes that are there.
fn ends(what: &str, ends: [u32; 2], places: usize) -> Result<[usize; 2], ExportError> {
    match ends.iter().find(|&&end| end as usize >= places) {
        Some(&place) => Err(ExportError::NoSuchPlace { what: what.to_owned(), place, places }),
        None => Ok(ends.map(|end| end as usize)),
    }
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
