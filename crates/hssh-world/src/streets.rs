//! Street networks: crossings and polylines, and the world they make.

use crate::crossing::star_of_crossing;
use crate::geometry::Point;
use crate::world::{Link, Place, PlaceId, World, WorldError, WorldOlp};

/// How far a polyline may begin or end from its crossing, in metres: data rounded to centimetres.
const END_TOLERANCE: f64 = 0.05;

/// A node of a street network.
#[derive(Clone, PartialEq, Debug)]
pub struct Crossing {
    /// Its name in the data.
    pub name: String,
    /// Where it is, in metres.
    pub position: Point,
}

/// A street from one crossing to another, or back to the same one.
#[derive(Clone, PartialEq, Debug)]
pub struct Street {
    /// The crossings it joins, as positions in [`StreetNetwork::crossings`].
    pub ends: [usize; 2],
    /// Where it bends, from the first end to the second.
    pub bends: Vec<Point>,
}

/// Crossings and the streets between them, as maps of cities give them.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct StreetNetwork {
    /// The crossings.
    pub crossings: Vec<Crossing>,
    /// The streets; parallel streets and loops are allowed.
    pub streets: Vec<Street>,
}

/// Where a text is no street network.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct StreetError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong there.
    pub problem: StreetProblem,
}

/// Why a text is no street network.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum StreetProblem {
    /// The text is not XML.
    #[error("this is no GraphML: {0}")]
    Xml(String),
    /// A line of another kind.
    #[error("`{0}` begins no record: a line is `NODE id x y`, `EDGE from to count x1 y1 …` or a `#` comment")]
    UnknownRecord(String),
    /// Something required is not there.
    #[error("{record} has no {field}")]
    Missing {
        /// What it is missing from.
        record: &'static str,
        /// What is missing.
        field: &'static str,
    },
    /// Not a finite number.
    #[error("{field} is `{text}`, which is no finite number")]
    NotANumber {
        /// What should be a number.
        field: &'static str,
        /// What stands there.
        text: String,
    },
    /// The polyline has another number of points than announced.
    #[error("the edge announces {announced} points but lists {listed} numbers, not {}", 2 * .announced)]
    PointCount {
        /// The count that the edge gives.
        announced: usize,
        /// How many numbers follow.
        listed: usize,
    },
    /// The geometry is not a line.
    #[error("geometry `{0}` is not of the form `LINESTRING (x1 y1, x2 y2, …)` with at least two points")]
    NotALine(String),
    /// A node's identifier stands twice.
    #[error("node `{0}` was given before")]
    RepeatedNode(String),
    /// An edge ends at a node that is not there.
    #[error("node `{0}` does not exist, or comes later than its edge")]
    UnknownNode(String),
    /// The polyline does not lead from one node to the other.
    #[error("the polyline of edge `{from}`–`{to}` does not join these nodes: it misses one by {gap:.2} m")]
    LooseEnd {
        /// The first node.
        from: String,
        /// The second node.
        to: String,
        /// The larger of the two gaps in metres.
        gap: f64,
    },
}

impl StreetNetwork {
    /// The world of these streets: a place for every crossing, a link for every street.
    ///
    /// Stars come from the bearings by which the streets leave: two streets continue one another
    /// if they are mutually the straightest continuation and deviate from a straight line by at
    /// most 45°, half way between straight on and a right-angled turn. A street that nothing
    /// continues has a closed opposite at its bearing + 180°. Stars are named by their number of
    /// gateways: `3-way`.
    ///
    /// # Errors
    /// If there are no crossings, a crossing has no street, two streets leave a crossing by the
    /// same bearing, a street names a crossing that does not exist, or a coordinate is not finite.
    pub fn to_world(&self) -> Result<World, WorldError> {
        let mut leaving: Vec<Vec<(usize, usize, f64)>> = vec![Vec::new(); self.crossings.len()];
        for (index, street) in self.streets.iter().enumerate() {
            let way = self.way(index, street)?;
            for side in [0, 1] {
                leaving[street.ends[side]].push((index, side, leaving_bearing(&way, side == 1)));
            }
        }
        let mut links: Vec<Link> = self.streets.iter().map(unlinked).collect();
        let mut places = Vec::new();
        for (index, (crossing, leaving)) in self.crossings.iter().zip(&leaving).enumerate() {
            let bearings: Vec<f64> = leaving.iter().map(|&(_, _, bearing)| bearing).collect();
            let read =
                star_of_crossing(&bearings).ok_or_else(|| WorldError::NoStreet(crossing.name.clone()))?;
            for (&(street, side, _), &olp) in leaving.iter().zip(&read.olps) {
                links[street].ends[side] = WorldOlp { place: PlaceId(index as u32), olp };
            }
            places.push(Place {
                name: crossing.name.clone(),
                position: crossing.position,
                star: read.star,
                star_name: format!("{}-way", leaving.len()),
                bearings: read.bearings,
            });
        }
        World::new(places, links)
    }

    /// The whole polyline of a street, from crossing to crossing.
    fn way(&self, index: usize, street: &Street) -> Result<Vec<Point>, WorldError> {
        let position = |end: usize| match self.crossings.get(end) {
            Some(crossing) => Ok(crossing.position),
            None => {
                let gateway = WorldOlp { place: PlaceId(end as u32), olp: hssh_topology::Olp::new(0) };
                Err(WorldError::NoGateway { link: index, gateway })
            }
        };
        let mut way = vec![position(street.ends[0])?];
        way.extend(&street.bends);
        way.push(position(street.ends[1])?);
        if way.iter().all(|point| point.is_finite()) {
            Ok(way)
        } else {
            Err(WorldError::NotFinite(format!("a point of street {index}")))
        }
    }

    /// Adds a street from its whole polyline, which may run either way.
    pub(crate) fn add_street(
        &mut self,
        ends: [usize; 2],
        mut polyline: Vec<Point>,
    ) -> Result<(), StreetProblem> {
        let [from, to] = ends.map(|end| self.crossings[end].position);
        let gap = |line: &[Point]| from.distance_to(line[0]).max(to.distance_to(line[line.len() - 1]));
        let forward = gap(&polyline);
        polyline.reverse();
        let backward = gap(&polyline);
        if forward.min(backward) > END_TOLERANCE {
            let [from, to] = ends.map(|end| self.crossings[end].name.clone());
            return Err(StreetProblem::LooseEnd { from, to, gap: forward.min(backward) });
        }
        if forward <= backward {
            polyline.reverse();
        }
        let bends = polyline[1..polyline.len() - 1].to_vec();
        self.streets.push(Street { ends, bends });
        Ok(())
    }
}

/// A street's link before its stars are known; every end is set before the world is made.
fn unlinked(street: &Street) -> Link {
    let ends =
        street.ends.map(|end| WorldOlp { place: PlaceId(end as u32), olp: hssh_topology::Olp::new(0) });
    Link { ends, bends: street.bends.clone() }
}

/// The bearing of a polyline's first piece that has a length, from its start or from its end.
fn leaving_bearing(way: &[Point], from_the_end: bool) -> f64 {
    let mut points = way.to_vec();
    if from_the_end {
        points.reverse();
    }
    let next = points.iter().find(|point| point.distance_to(points[0]) > 0.0).unwrap_or(&points[0]);
    points[0].bearing_to(*next)
}

/// A finite number, or which field is none.
pub(crate) fn number(field: &'static str, text: &str) -> Result<f64, StreetProblem> {
    let not_a_number = || StreetProblem::NotANumber { field, text: text.to_owned() };
    text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(not_a_number)
}
