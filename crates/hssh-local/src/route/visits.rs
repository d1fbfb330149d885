//! The visits of a route: the same star at every visit to one spot.

use std::collections::BTreeSet;

use hssh_metrics::Pose;
use hssh_topology::Olp;
use nalgebra::Vector2;

use super::network::{Network, WayEnd};
use super::options::RouteOptions;
use super::paths::{pair, part_loops};
use super::places::{WaysOut, add_sighted, ways_out};
use super::travelled::travelled;
use super::walk::{Stay, walk};
use crate::grid::OccupancyGrid;
use crate::place::{LocalStar, PlaceKind, PlaceOptions};

/// A visit on a route.
#[derive(Clone, Debug)]
pub(crate) struct RouteVisit {
    /// Which spot, counted over all visited spots.
    pub(crate) spot: usize,
    /// The first and the last scan there.
    pub(crate) scans: (usize, usize),
    /// The scan nearest to the center.
    pub(crate) reference: usize,
    /// By which end of the star the robot came and left.
    pub(crate) entry: Option<Olp>,
    pub(crate) exit: Option<Olp>,
}

/// A spot that was visited.
#[derive(Clone, Debug)]
pub(crate) struct RoutePlace {
    pub(crate) center: Vector2<f64>,
    pub(crate) star: LocalStar,
}

/// A robot's way as a sequence of visits.
#[derive(Clone, Debug, Default)]
pub(crate) struct Route {
    pub(crate) places: Vec<RoutePlace>,
    pub(crate) visits: Vec<RouteVisit>,
}

/// The route of a robot through a building, both in one frame. Places are looked at in squares of side `window`.
pub(crate) fn route(
    building: &OccupancyGrid,
    poses: &[Pose],
    window: f64,
    options: &RouteOptions,
    place: &PlaceOptions,
) -> Route {
    let travelled = travelled(building, poses, options);
    let mut network = Network::new(&travelled, building, options);
    add_sighted(&mut network, building, window, options, place);
    part_loops(&mut network);
    let out: Vec<WaysOut> = (0..network.spots.len())
        .map(|spot| ways_out(&network, spot, building, window, options, place))
        .collect();
    let pairing = pair(&network, &out, place);
    let stars: Vec<Option<LocalStar>> = out
        .iter()
        .zip(&pairing)
        .map(|(out, pairing)| LocalStar::with_continuations(out.center.into(), &out.gateways, pairing))
        .collect();
    let is_passage: Vec<bool> =
        stars.iter().map(|star| star.as_ref().is_none_or(|star| star.kind() == PlaceKind::Passage)).collect();
    let stays = without_passages(walk(&network, &travelled, poses, options), &is_passage);
    let stays = between_places(stays, poses.len() - 1, &network, &out);
    let mut number: Vec<Option<usize>> = vec![None; network.spots.len()];
    let mut route = Route::default();
    for stay in &stays {
        let Some(star) = &stars[stay.spot] else { continue };
        let spot = *number[stay.spot].get_or_insert_with(|| {
            route.places.push(RoutePlace { center: out[stay.spot].center, star: star.clone() });
            route.places.len() - 1
        });
        let end = |arm: Option<WayEnd>| {
            let index = out[stay.spot].travelled.iter().position(|&other| Some(other) == arm)?;
            star.olp_of(&out[stay.spot].gateways[index])
        };
        let off = |scan: &usize| (poses[*scan].translation() - out[stay.spot].center).norm();
        let reference = (stay.scans.0..=stay.scans.1).min_by(|a, b| off(a).total_cmp(&off(b)));
        route.visits.push(RouteVisit {
            spot,
            scans: stay.scans,
            reference: reference.unwrap_or(stay.scans.0),
            entry: end(stay.came),
            exit: end(stay.left),
        });
    }
    route
}

/// The stays at spots that are more than a way that goes on. What turned back at such a spot turned back on the way,
/// and never left the place before.
fn without_passages(stays: Vec<Stay>, is_passage: &[bool]) -> Vec<Stay> {
    let mut kept: Vec<Stay> = Vec::new();
    for stay in stays.into_iter().filter(|stay| !is_passage[stay.spot]) {
        match kept.last_mut() {
            Some(last) if last.spot == stay.spot && last.left == stay.came => {
                (last.scans.1, last.left) = (stay.scans.1, stay.left);
            }
            _ => kept.push(stay),
        }
    }
    kept
}

/// The stays without the spots where the log just begins or ends, if nothing there looks like a place and the robot did
/// not turn back there. If there is nothing else, they are the two ends of one way. `last` is the last scan.
fn between_places(mut stays: Vec<Stay>, last: usize, network: &Network, out: &[WaysOut]) -> Vec<Stay> {
    let is_end = |stay: &Stay| stay.scans.0 == 0 || stay.scans.1 == last;
    let turned: BTreeSet<usize> = stays.iter().filter(|stay| !is_end(stay)).map(|stay| stay.spot).collect();
    let is_open_end = |stay: &Stay| {
        let spot = stay.spot;
        is_end(stay)
            && network.spots[spot].arms.len() <= 1
            && !out[spot].is_sighted
            && !turned.contains(&spot)
    };
    if !stays.iter().all(is_open_end) {
        if stays.first().is_some_and(is_open_end) {
            stays.remove(0);
        }
        if stays.last().is_some_and(is_open_end) {
            stays.pop();
        }
    }
    if let Some(last) = stays.last_mut() {
        last.left = None;
    }
    stays
}
