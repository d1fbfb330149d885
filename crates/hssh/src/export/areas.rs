//! Areas and the passages between them: the regions of a grid map, or the places and ways of a log's map.

use std::f64::consts::TAU;

use hssh_metrics::Pose;

use super::error::ExportError;
use super::names::{region_names, unique};
use super::provenance::Provenance;
use super::route_graph::{RouteGraph, distance};
use crate::account::PlacesAccount;
use crate::answer::{AnsweredMap, AnsweredPlace};

/// Areas and passages; metres in one frame.
#[derive(Clone, PartialEq, Debug)]
pub struct AreaGraph {
    /// Where it comes from.
    pub provenance: Provenance,
    /// The areas.
    pub areas: Vec<Area>,
    /// The passages.
    pub passages: Vec<AreaPassage>,
}

/// An area.
#[derive(Clone, PartialEq, Debug)]
pub struct Area {
    /// Its name; no other area has it.
    pub name: String,
    /// `room` or `corridor`.
    pub kind: String,
    /// The corners around it; the first is not repeated.
    pub ring: Vec<[f64; 2]>,
}

/// Where one area leads to another.
#[derive(Clone, PartialEq, Debug)]
pub struct AreaPassage {
    /// Its name.
    pub name: String,
    /// The areas, by number.
    pub between: [usize; 2],
    /// The line across.
    pub line: [[f64; 2]; 2],
}

impl AreaGraph {
    /// The regions of a grid map; holes are left out, for an area has one ring.
    ///
    /// # Errors
    /// If there are no regions: the places of a log have none.
    pub fn of_regions(account: &PlacesAccount) -> Result<Self, ExportError> {
        if account.regions.is_empty() {
            return Err(ExportError::NoRegions);
        }
        let areas = account.regions.iter().zip(region_names(account)).map(|(region, name)| Area {
            name,
            kind: if region.kind == "corridor" { "corridor" } else { "room" }.to_owned(),
            ring: region.outline.first().cloned().unwrap_or_default(),
        });
        let areas: Vec<Area> = areas.collect();
        let passage = |(number, passage): (usize, &crate::account::PassageAccount)| {
            let between = passage.regions.map(|region| region as usize);
            if let Some(&region) = between.iter().find(|&&region| region >= areas.len()) {
                let what = format!("passage {number}");
                return Err(ExportError::NoSuchPlace { what, place: region as u32, places: areas.len() });
            }
            let name = format!("{} {number}", passage.kind);
            Ok(AreaPassage { name, between, line: passage.gateway.line })
        };
        let passages = account.passages.iter().enumerate().map(passage).collect::<Result<_, _>>()?;
        Ok(AreaGraph { provenance: Provenance::of_places(account), areas, passages })
    }

    /// Of a log's map: each place is the area between its gateways, each way a strip as wide as the narrower of its two gateways, and
    /// each way has a passage at either end. The areas are drawn from gateways and ways, not from walls.
    ///
    /// # Errors
    /// If a place has no position, or its gateways are not known.
    pub fn of_map(graph: &RouteGraph, map: &AnsweredMap) -> Result<Self, ExportError> {
        if graph.ways.is_empty() {
            return Err(ExportError::NoLink);
        }
        let outlines = map.places.iter().enumerate().map(|(number, place)| outline(number, place));
        let outlines = outlines.collect::<Result<Vec<_>, _>>()?;
        let names = unique(
            graph
                .nodes
                .iter()
                .map(|node| node.name.clone())
                .chain((0..graph.ways.len()).map(|way| format!("way {way}"))),
        );
        let room = |(outline, name): (&Outline, &String)| Area {
            name: name.clone(),
            kind: "room".to_owned(),
            ring: outline.ring(),
        };
        let mut areas: Vec<Area> = outlines.iter().zip(&names).map(room).collect();
        let mut passages = Vec::new();
        for (number, (way, link)) in graph.ways.iter().zip(&map.links).enumerate() {
            let ends = [&link.from, &link.to];
            let mut gateways = [[[0.0; 2]; 2]; 2];
            for (gateway, end) in gateways.iter_mut().zip(ends) {
                let place = end.place as usize;
                let known = outlines[place].gateways.iter().find(|(name, _)| *name == end.end);
                *gateway = known.ok_or(ExportError::NoOutline { place })?.1;
            }
            let centers = way.ends.map(|place| outlines[place].center);
            let corridor = areas.len();
            let name = names[corridor].clone();
            areas.push(Area { name, kind: "corridor".to_owned(), ring: strip(gateways, centers, &way.line) });
            passages.extend([0, 1].map(|end| AreaPassage {
                name: format!("gateway {} of place {}, way {number}", ends[end].end, ends[end].place),
                between: [way.ends[end], corridor],
                line: gateways[end],
            }));
        }
        Ok(AreaGraph { provenance: graph.provenance.clone(), areas, passages })
    }
}

/// A place with its gateways, in the frame of the map.
struct Outline<'a> {
    center: [f64; 2],
    gateways: Vec<(&'a str, [[f64; 2]; 2])>,
}

fn outline(number: usize, place: &AnsweredPlace) -> Result<Outline<'_>, ExportError> {
    let pose = place.pose.ok_or(ExportError::NotPlaced { place: number })?;
    let frame = Pose::new(pose.x, pose.y, pose.theta);
    let placed = |[x, y]: [f64; 2]| {
        let point = frame.compose(Pose::new(x, y, 0.0));
        [point.x, point.y]
    };
    let gateways = place.ends.iter().filter_map(|end| Some((end.name.as_str(), end.gateway?.map(placed))));
    let gateways: Vec<_> = gateways.collect();
    if gateways.is_empty() {
        return Err(ExportError::NoOutline { place: number });
    }
    Ok(Outline { center: [pose.x, pose.y], gateways })
}

impl Outline<'_> {
    /// A ring around the center through the ends of all gateways; where there is none for long, as far away as these are at least. Seen
    /// from the center its corners come one after the other, so that it does not cross itself.
    fn ring(&self) -> Vec<[f64; 2]> {
        /// No two neighboring corners are farther apart, seen from the center.
        const WIDEST: f64 = TAU / 5.0;
        /// Nor nearer to one another, for they are rounded once.
        const NARROWEST: f64 = 0.02;
        let polar = |point: [f64; 2]| {
            let [x, y] = [point[0] - self.center[0], point[1] - self.center[1]];
            (y.atan2(x), x.hypot(y))
        };
        let mut corners: Vec<(f64, f64)> = self
            .gateways
            .iter()
            .flat_map(|(_, line)| line.map(polar))
            .filter(|corner| corner.1 > 1e-6)
            .collect();
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        corners.dedup_by(|a, b| a.0 - b.0 < NARROWEST);
        let nearest = corners.iter().map(|corner| corner.1).fold(f64::INFINITY, f64::min);
        let nearest = if nearest.is_finite() { nearest } else { 0.5 };
        let first = corners.first().map_or(0.0, |corner| corner.0);
        let next = corners.iter().skip(1).map(|corner| corner.0).chain([first + TAU]);
        let mut ring = Vec::new();
        for ((angle, radius), next) in corners.iter().copied().zip(next) {
            ring.push((angle, radius));
            let parts = ((next - angle) / WIDEST).ceil().max(1.0);
            ring.extend(
                (1..parts as u32).map(|part| (angle + f64::from(part) / parts * (next - angle), nearest)),
            );
        }
        let point = |(angle, radius): (f64, f64)| {
            [self.center[0] + radius * angle.cos(), self.center[1] + radius * angle.sin()]
        };
        ring.into_iter().map(point).collect()
    }
}

/// The strip along a way from one gateway to another: as wide as the narrower of the two, and narrower if it would cross itself. Where
/// nothing helps it is the quadrangle around both gateways.
fn strip(gateways: [[[f64; 2]; 2]; 2], centers: [[f64; 2]; 2], line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let middles = gateways.map(|[a, b]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
    let is_beyond = |point: &&[f64; 2]| {
        centers
            .iter()
            .zip(&middles)
            .all(|(&center, &middle)| distance(center, **point) > distance(center, middle))
    };
    let inner = line.iter().filter(is_beyond).copied();
    let spine: Vec<[f64; 2]> = std::iter::once(middles[0]).chain(inner).chain([middles[1]]).collect();
    let usual = gateways.map(|[a, b]| distance(a, b)).into_iter().fold(f64::INFINITY, f64::min) / 2.0;
    let narrower = [1.0, 0.5, 0.25, 0.125].map(|part| sides(gateways, &spine, part * usual));
    narrower.into_iter().find(|ring| is_simple(ring)).unwrap_or_else(|| hull(&gateways.concat()))
}

/// A ring along both sides of a spine, whose ends are gateways.
fn sides(gateways: [[[f64; 2]; 2]; 2], spine: &[[f64; 2]], half: f64) -> Vec<[f64; 2]> {
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for corner in spine.windows(3) {
        let [before, at, after] = [corner[0], corner[1], corner[2]];
        let normal = normal(before, after);
        left.push([at[0] + half * normal[0], at[1] + half * normal[1]]);
        right.push([at[0] - half * normal[0], at[1] - half * normal[1]]);
    }
    let oriented = |[a, b]: [[f64; 2]; 2], from: [f64; 2], to: [f64; 2]| {
        let normal = normal(from, to);
        let side = |point: [f64; 2]| normal[0] * point[0] + normal[1] * point[1];
        if side(a) > side(b) { [a, b] } else { [b, a] }
    };
    let [first, second] = [spine[0], spine[1]];
    let [last_but_one, last] = [spine[spine.len() - 2], spine[spine.len() - 1]];
    let [start_left, start_right] = oriented(gateways[0], first, second);
    let [end_left, end_right] = oriented(gateways[1], last_but_one, last);
    let mut ring = vec![start_left];
    ring.extend(left);
    ring.extend([end_left, end_right]);
    ring.extend(right.into_iter().rev());
    ring.push(start_right);
    ring
}

/// To the left of a direction, one metre.
fn normal(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let length = distance(from, to).max(1e-9);
    [(from[1] - to[1]) / length, (to[0] - from[0]) / length]
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether no two sides of a ring cross or come so near to one another that they may once coordinates are rounded.
fn is_simple(ring: &[[f64; 2]]) -> bool {
    /// Programs for OpenStreetMap keep coordinates to a centimetre.
    const APART: f64 = 0.02;
    let side = |index: usize| [ring[index % ring.len()], ring[(index + 1) % ring.len()]];
    let is_crossed = |[a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]| {
        cross(a, b, c) * cross(a, b, d) <= 0.0 && cross(c, d, a) * cross(c, d, b) <= 0.0
    };
    let is_near = |[a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]| {
        [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])]
            .iter()
            .any(|&(point, side)| off(point, side) < APART)
    };
    (0..ring.len()).all(|one| {
        let [a, b] = side(one);
        let [_, c] = side(one + 1);
        let is_spike = off(c, [a, b]) < APART || off(a, [b, c]) < APART;
        let mut others = one + 2..ring.len() - usize::from(one == 0);
        !is_spike && others.all(|other| !is_crossed([a, b], side(other)) && !is_near([a, b], side(other)))
    })
}

/// How far a point is from a side.
fn off(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((point[0] - from[0]) * along[0] + (point[1] - from[1]) * along[1]) / square.max(1e-12);
    let part = part.clamp(0.0, 1.0);
    distance(point, [from[0] + part * along[0], from[1] + part * along[1]])
}

/// The convex hull (Andrew's monotone chain).
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = points.to_vec();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while chain.len() > 1 && cross(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0.0 {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let lower = half(&mut points.iter().copied());
    let upper = half(&mut points.iter().rev().copied());
    [lower, upper].concat()
}
