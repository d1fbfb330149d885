//! The robot's walk on the network: at which spots it was, one after the other, and by which ways it went.

use hssh_metrics::Pose;
use nalgebra::Vector2;

use super::flood::{UNREACHED, flood};
use super::network::{Network, WayEnd};
use super::options::RouteOptions;
use crate::grid::{Cell, Occupancy, OccupancyGrid};

/// A stay at a spot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Stay {
    pub(super) spot: usize,
    /// The first and the last scan there.
    pub(super) scans: (usize, usize),
    /// By which end of which way the robot came; nothing at the beginning.
    pub(super) came: Option<WayEnd>,
    /// By which end of which way it left; nothing at the end.
    pub(super) left: Option<WayEnd>,
}

/// Where a scan was taken.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Position {
    Spot(usize),
    /// On a way, so far along.
    Way(usize, f64),
}

/// The stays in order.
pub(super) fn walk(
    network: &Network,
    travelled: &OccupancyGrid,
    poses: &[Pose],
    options: &RouteOptions,
) -> Vec<Stay> {
    let positions = positions(network, travelled, poses, options);
    let mut stays: Vec<Stay> = Vec::new();
    // On which way the robot is since it left the last spot, and where it was on it first and last.
    let mut on: Option<(usize, f64, f64)> = None;
    for (scan, position) in positions.into_iter().enumerate() {
        match position {
            None => {}
            Some(Position::Way(way, along)) => match &mut on {
                Some((other, _, last)) if *other == way => *last = along,
                Some((other, first, last)) => {
                    let (other, first, last) = (*other, *first, *last);
                    jump(network, poses, scan, (other, first, last), way, &mut stays);
                    let start = stays.last().map_or(along, |stay| start_at(network, way, stay.spot, along));
                    on = Some((way, start, along));
                }
                None => {
                    let start = stays.last().map_or(along, |stay| start_at(network, way, stay.spot, along));
                    on = Some((way, start, along));
                }
            },
            Some(Position::Spot(spot)) => {
                arrive(network, poses, scan, spot, on.take(), &mut stays);
            }
        }
    }
    stays
}

/// Where on a way the robot began that left a spot: at the end that is there; the nearer one if both are.
fn start_at(network: &Network, way: usize, spot: usize, along: f64) -> f64 {
    let way = &network.ways[way];
    match (way.spots[0] == spot, way.spots[1] == spot) {
        (true, false) => 0.0,
        (false, true) => way.length(),
        _ => along,
    }
}

/// The end of a way that is nearer to a position on it.
fn nearer_end(network: &Network, way: usize, along: f64) -> WayEnd {
    WayEnd { way, is_last: along > network.ways[way].length() / 2.0 }
}

/// The robot comes to a spot, from the way it was on.
fn arrive(
    network: &Network,
    poses: &[Pose],
    scan: usize,
    spot: usize,
    on: Option<(usize, f64, f64)>,
    stays: &mut Vec<Stay>,
) {
    let Some(last) = stays.last().copied() else {
        let came = on.map(|(way, _, along)| nearer_end(network, way, along));
        let came = came.filter(|&end| network.spot_at(end) == spot);
        stays.push(Stay { spot, scans: (scan, scan), came, left: None });
        return;
    };
    let Some((way, first, along)) = on else {
        if last.spot == spot {
            stays.last_mut().expect("there is one").scans.1 = scan;
        } else {
            go(network, poses, (last.scans.1, scan), spot, stays);
        }
        return;
    };
    let ends = [WayEnd { way, is_last: false }, WayEnd { way, is_last: true }];
    let (left, came) = match ends.map(|end| network.spot_at(end)) {
        [from, to] if from == last.spot && to == spot && from != to => (ends[0], ends[1]),
        [to, from] if from == last.spot && to == spot && from != to => (ends[1], ends[0]),
        [one, other] if one == other && one == spot && last.spot == spot => {
            (nearer_end(network, way, first), nearer_end(network, way, along))
        }
        [one, other] if last.spot == spot && (one == spot || other == spot) => {
            // It turned back on the way.
            let end = ends[usize::from(one != spot)];
            (end, end)
        }
        _ => {
            go(network, poses, (last.scans.1, scan), spot, stays);
            return;
        }
    };
    if left == came {
        stays.last_mut().expect("there is one").scans.1 = scan;
        return;
    }
    stays.last_mut().expect("there is one").left = Some(left);
    stays.push(Stay { spot, scans: (scan, scan), came: Some(came), left: None });
}

/// The robot is suddenly on another way: it passed the spots between without coming near.
fn jump(
    network: &Network,
    poses: &[Pose],
    scan: usize,
    from: (usize, f64, f64),
    way: usize,
    stays: &mut Vec<Stay>,
) {
    let here = network.ways[from.0].spots;
    let there = network.ways[way].spots;
    let shared: Vec<usize> = here.into_iter().filter(|spot| there.contains(spot)).collect();
    let at = Vector2::new(poses[scan].x, poses[scan].y);
    let off = |spot: &usize| (network.spots[*spot].center - at).norm();
    let nearest = |spots: &[usize]| spots.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)));
    if let Some(spot) = nearest(&shared).or_else(|| nearest(&there)) {
        arrive(network, poses, scan, spot, Some(from), stays);
    }
}

/// The robot went to a spot unseen: on the shortest path.
fn go(network: &Network, poses: &[Pose], scans: (usize, usize), spot: usize, stays: &mut Vec<Stay>) {
    let Some(last) = stays.last().copied() else { return };
    let path = network.path(last.spot, spot);
    for arm in path {
        let next = network.spot_at(arm.opposite());
        let center = network.spots[next].center;
        let off = |scan: &usize| (Vector2::new(poses[*scan].x, poses[*scan].y) - center).norm();
        let since = stays.last().map_or(scans.0, |stay| stay.scans.1);
        let nearest = (since..=scans.1).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(scans.1);
        stays.last_mut().expect("there is one").left = Some(arm);
        stays.push(Stay { spot: next, scans: (nearest, nearest), came: Some(arm.opposite()), left: None });
    }
    if let Some(last) = stays.last_mut() {
        last.scans.1 = scans.1;
    }
}

/// Where each scan was taken; nothing if off the network.
fn positions(
    network: &Network,
    travelled: &OccupancyGrid,
    poses: &[Pose],
    options: &RouteOptions,
) -> Vec<Option<Position>> {
    let lattice = travelled.lattice();
    let mut sources: Vec<Cell> = Vec::new();
    let mut told: Vec<Position> = Vec::new();
    for (index, spot) in network.spots.iter().enumerate() {
        sources.extend(&spot.core);
        told.resize(sources.len(), Position::Spot(index));
    }
    for (index, way) in network.ways.iter().enumerate() {
        let reach = options.reach.min(way.length() / 3.0);
        for (&cell, &along) in way.cells.iter().zip(&way.along) {
            sources.push(cell);
            told.push(if along <= reach {
                Position::Spot(way.spots[0])
            } else if along >= way.length() - reach {
                Position::Spot(way.spots[1])
            } else {
                Position::Way(index, along)
            });
        }
    }
    let nearest = flood(lattice, &sources, f64::from(lattice.width().max(lattice.height())), |cell| {
        travelled.get(cell) == Occupancy::Free
    });
    let position = |pose: &Pose| {
        let source = nearest[lattice.index(lattice.cell_at([pose.x, pose.y])?)];
        (source != UNREACHED).then(|| told[source as usize])
    };
    poses.iter().map(position).collect()
}
