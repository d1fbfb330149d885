//! Which spots are places of what kind: what was travelled, and beside it what can be seen.

use hssh_metrics::wrap_angle;
use nalgebra::Vector2;

use super::network::{Network, WayEnd};
use super::options::RouteOptions;
use crate::grid::OccupancyGrid;
use crate::place::{Gateway, PlaceOptions, Sighting, sight};

/// What was seen of one place, all along the ways around it.
struct Seen {
    center: Vector2<f64>,
    sightings: usize,
}

/// The ways out of a spot: first those that were travelled, in the order of the spot's arms, then those that were
/// only seen.
pub(super) struct WaysOut {
    pub(super) center: Vector2<f64>,
    pub(super) gateways: Vec<Gateway>,
    pub(super) travelled: Vec<WayEnd>,
    /// Whether it looks like a place, whatever was travelled.
    pub(super) is_sighted: bool,
}

/// Puts spots on ways where places are seen along them: where a way that nobody went leads on, or it turns.
pub(super) fn add_sighted(
    network: &mut Network,
    building: &OccupancyGrid,
    window: f64,
    options: &RouteOptions,
    place: &PlaceOptions,
) {
    for way in 0..network.ways.len() {
        let at: Vec<f64> = seen_along(network, way, building, window, options, place);
        network.split(way, &at);
    }
}

/// How far along a way the places are that are seen from it and are not at one of its ends.
fn seen_along(
    network: &Network,
    way: usize,
    building: &OccupancyGrid,
    window: f64,
    options: &RouteOptions,
    place: &PlaceOptions,
) -> Vec<f64> {
    let ways = &network.ways[way];
    let looks = (ways.length() / options.look_distance) as usize;
    let mut seen: Vec<Seen> = Vec::new();
    for look in 0..=looks {
        let from = ways.point_from(false, look as f64 * options.look_distance);
        let Some(sighting) = look_at(building, from, window, place).filter(|sighting| sighting.is_place)
        else {
            continue;
        };
        match seen.iter_mut().find(|seen| (seen.center - sighting.center).norm() <= options.same_place) {
            Some(seen) => seen.sightings += 1,
            None => seen.push(Seen { center: sighting.center, sightings: 1 }),
        }
    }
    let ends = ways.spots.map(|spot| network.spots[spot].center);
    let mut at: Vec<f64> = Vec::new();
    for seen in seen.iter().filter(|seen| seen.sightings >= options.least_sightings) {
        let off = |index: &usize| (ways.points[*index] - seen.center).norm();
        let Some(nearest) = (0..ways.points.len()).min_by(|a, b| off(a).total_cmp(&off(b))) else { continue };
        let along = ways.along[nearest];
        let is_at_end = ends.iter().any(|end| (end - seen.center).norm() <= options.same_place);
        let is_inside = along > options.same_place && ways.length() - along > options.same_place;
        if off(&nearest) <= options.same_place && !is_at_end && is_inside {
            at.push(along);
        }
    }
    at.sort_by(f64::total_cmp);
    at.dedup_by(|later, earlier| *later - *earlier < options.same_place);
    at
}

fn look_at(
    building: &OccupancyGrid,
    from: Vector2<f64>,
    window: f64,
    place: &PlaceOptions,
) -> Option<Sighting> {
    let grid = building.window([from.x, from.y], window)?;
    sight(&grid, from, place)
}

/// The ways out of a spot.
pub(super) fn ways_out(
    network: &Network,
    spot: usize,
    building: &OccupancyGrid,
    window: f64,
    options: &RouteOptions,
    place: &PlaceOptions,
) -> WaysOut {
    /// How wide a way is taken to be of which nobody saw the sides.
    const WIDTH: f64 = 1.5;
    let center = network.spots[spot].center;
    let seen = look_at(building, center, window, place)
        .filter(|sighting| (sighting.center - center).norm() <= options.same_place + sighting.clearance);
    let is_sighted = seen.as_ref().is_some_and(|sighting| sighting.is_place);
    let mut seen: Vec<Gateway> = seen.map(|sighting| sighting.gateways).unwrap_or_default();
    let mut gateways = Vec::new();
    for arm in &network.spots[spot].arms {
        let way = &network.ways[arm.way];
        let start = options.reach.min(way.length() / 3.0);
        let (from, to) =
            (way.point_from(arm.is_last, start), way.point_from(arm.is_last, start + options.aim));
        let outward = if (to - from).norm() > 1e-6 { to - from } else { from - center };
        let direction = outward.try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let bearing = direction.y.atan2(direction.x);
        let is_same = |gateway: &Gateway| {
            let near = way.points.iter().zip(&way.along).filter(|&(_, &along)| {
                let along = if arm.is_last { way.length() - along } else { along };
                along < options.reach + options.aim
            });
            let gap = |(point, _): (&Vector2<f64>, &f64)| (point - Vector2::from(gateway.position)).norm();
            let passes = near.map(gap).fold(f64::INFINITY, f64::min) < (gateway.width / 2.0).max(0.8);
            passes || wrap_angle(gateway.bearing - bearing).abs() < options.same_way
        };
        let width = seen.iter().filter(|gateway| is_same(gateway)).map(|gateway| gateway.width).next();
        seen.retain(|gateway| !is_same(gateway));
        gateways.push(Gateway::across([from.x, from.y], direction, width.unwrap_or(WIDTH)));
    }
    let travelled = network.spots[spot].arms.clone();
    gateways.extend(seen);
    WaysOut { center, gateways, travelled, is_sighted }
}
