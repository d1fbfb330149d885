//! The star of a place from its gateways (Definition 2.1).

use std::f64::consts::{PI, TAU};

use hssh_metrics::wrap_angle;
use hssh_topology::{Olp, OlpName, Passability, Sign, Star, StarEnd};

use super::local_path::continuations;
use super::{Gateway, PlaceOptions};

/// Two ends of a star differ in bearing by at least this much, in radians.
const APART: f64 = 1e-6;

/// What a place looks like by its gateways.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum PlaceKind {
    /// Two gateways that continue one another: a corridor, no place.
    Passage,
    /// One gateway.
    DeadEnd,
    /// Two gateways that do not continue one another.
    Corner,
    /// Three gateways or more.
    Junction,
}

/// A star together with what its ends are in the grid; the lists have one entry per end, clockwise as
/// the star is.
#[derive(Clone, PartialEq, Debug)]
pub struct LocalStar {
    /// The star.
    pub star: Star,
    /// Where each end points, in radians counterclockwise from the grid's x axis; they decrease around
    /// the star and come around in one full turn. A closed end points away from its gateway.
    pub bearings: Vec<f64>,
    /// The gateway of each travelable end.
    pub gateways: Vec<Option<Gateway>>,
}

/// An end before it has its place in the star.
struct End {
    bearing: f64,
    local_path: usize,
    /// The gateway's position in the list given; a closed end has none.
    gateway: Option<usize>,
}

impl LocalStar {
    /// The star of gateways around `center`; `None` if there are none. Every gateway is one end; the
    /// other end of its local path is the gateway that continues it, or closed.
    #[must_use]
    pub fn new(center: [f64; 2], gateways: &[Gateway], options: &PlaceOptions) -> Option<Self> {
        let other = continuations(gateways, options);
        Self::with_paths(gateways, &directions(center, gateways), &other)
    }

    /// The same where it is known which gateway continues which.
    pub(crate) fn with_continuations(
        center: [f64; 2],
        gateways: &[Gateway],
        other: &[Option<usize>],
    ) -> Option<Self> {
        Self::with_paths(gateways, &directions(center, gateways), other)
    }

    /// The star of a way that just goes on: one local path between two gateways.
    pub(super) fn passage(gateways: [Gateway; 2]) -> Option<Self> {
        let bearings = gateways.map(|gateway| gateway.bearing);
        Self::with_paths(&gateways, &bearings, &[Some(1), Some(0)])
    }

    /// The end of the star that a gateway is.
    pub(crate) fn olp_of(&self, gateway: &Gateway) -> Option<Olp> {
        self.star.olps().find(|olp| self.gateways[olp.index()].as_ref() == Some(gateway))
    }

    fn with_paths(gateways: &[Gateway], directions: &[f64], other: &[Option<usize>]) -> Option<Self> {
        let mut ends = Vec::new();
        for (index, &bearing) in directions.iter().enumerate() {
            let local_path = other[index].map_or(index, |other| other.min(index));
            ends.push(End { bearing, local_path, gateway: Some(index) });
            if other[index].is_none() {
                ends.push(End { bearing: wrap_angle(bearing + PI), local_path, gateway: None });
            }
        }
        ends.sort_by(|a, b| b.bearing.total_cmp(&a.bearing).then(b.gateway.cmp(&a.gateway)));
        let star = Star::new(named(&ends)).ok()?;
        let gateways = ends.iter().map(|end| end.gateway.map(|index| gateways[index])).collect();
        Some(LocalStar { star, bearings: spread(ends.iter().map(|end| end.bearing).collect()), gateways })
    }

    /// What a place with this star is.
    #[must_use]
    pub fn kind(&self) -> PlaceKind {
        match (self.gateways().count(), self.star.degree()) {
            (1, _) => PlaceKind::DeadEnd,
            (2, 2) => PlaceKind::Passage,
            (2, _) => PlaceKind::Corner,
            _ => PlaceKind::Junction,
        }
    }

    /// The gateways, clockwise.
    pub fn gateways(&self) -> impl Iterator<Item = &Gateway> {
        self.gateways.iter().flatten()
    }
}

/// Where each gateway points as seen in the star: its own bearing, unless that contradicts the order
/// in which the gateways lie around the center; then the direction from the center.
fn directions(center: [f64; 2], gateways: &[Gateway]) -> Vec<f64> {
    let from_center =
        |gateway: &Gateway| (gateway.position[1] - center[1]).atan2(gateway.position[0] - center[0]);
    let around: Vec<f64> = gateways.iter().map(from_center).collect();
    let outward: Vec<f64> = gateways.iter().map(|gateway| gateway.bearing).collect();
    if circular_order(&around) == circular_order(&outward) { outward } else { around }
}

/// The order of directions clockwise, beginning with the first.
fn circular_order(directions: &[f64]) -> Vec<usize> {
    let clockwise = |index: usize| (directions[0] - directions[index]).rem_euclid(TAU);
    let mut order: Vec<usize> = (0..directions.len()).collect();
    order.sort_by(|&a, &b| clockwise(a).total_cmp(&clockwise(b)).then(a.cmp(&b)));
    order
}

/// The ends with names: local paths are numbered, and their first ends called `+`, in clockwise order.
fn named(ends: &[End]) -> Vec<StarEnd> {
    let mut seen: Vec<usize> = Vec::new();
    let mut name = |end: &End| {
        let number = seen.iter().position(|&local_path| local_path == end.local_path);
        let sign = if number.is_some() { Sign::Minus } else { Sign::Plus };
        let local_path = number.unwrap_or_else(|| {
            seen.push(end.local_path);
            seen.len() - 1
        }) as u32;
        let passability = if end.gateway.is_some() { Passability::Travelable } else { Passability::Closed };
        StarEnd { name: OlpName { local_path, sign }, passability, label: None }
    };
    ends.iter().map(&mut name).collect()
}

/// The same bearings, each a little less than the one before even where two coincided.
fn spread(mut bearings: Vec<f64>) -> Vec<f64> {
    for index in 1..bearings.len() {
        bearings[index] = bearings[index].min(bearings[index - 1] - APART);
    }
    bearings
}
