//! The robot's walk on the network: at which spots it was, one after the other, and by which ways it went.

use hssh_metrics::Pose;

use super::network::{Network, WayEnd};
use super::options::RouteOptions;
use crate::geodesic::Geodesic;
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
    let at = poses[scan].translation();
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
        let off = |scan: &usize| (poses[*scan].translation() - center).norm();
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
    let everywhere = f64::from(lattice.width().max(lattice.height()));
    let nearest =
        Geodesic::from_nearest(lattice, &sources, everywhere, |cell| travelled.get(cell) == Occupancy::Free);
    let position = |pose: &Pose| Some(told[nearest.nearest(lattice.cell_at([pose.x, pose.y])?)?]);
    poses.iter().map(position).collect()
}

#[cfg(test)]
mod tests {
    use super::super::drawn::{along, drawn, travelled};
    use super::*;

    /// The robot goes along a line through corners, with a scan every `every` points of 10 cm.
    fn walked(network: &Network, corners: &[[f64; 2]], every: usize) -> Vec<Stay> {
        let poses: Vec<Pose> = poses(corners, every);
        let stays = walk(network, &travelled(network), &poses, &RouteOptions::default());
        // Each stay has scans within the reach of its spot, and they follow one another.
        for stay in &stays {
            let off = |scan: usize| (poses[scan].translation() - network.spots[stay.spot].center).norm();
            assert!(stay.scans.0 <= stay.scans.1);
            assert!(off(stay.scans.0) < 1.6 + 0.1 * every as f64, "{stay:?}: {}", off(stay.scans.0));
        }
        assert!(stays.windows(2).all(|pair| pair[0].scans.1 <= pair[1].scans.0), "{stays:?}");
        stays
    }

    fn poses(corners: &[[f64; 2]], every: usize) -> Vec<Pose> {
        let points = along(corners);
        let count = points.len();
        let kept =
            points.into_iter().enumerate().filter(|(index, _)| index % every == 0 || index + 1 == count);
        kept.map(|(_, at)| Pose::new(at.x, at.y, 0.0)).collect()
    }

    /// An end of a way, as numbers.
    type End = (usize, bool);

    /// Spots, ends by which the robot came, and ends by which it left: the way and whether it is the last.
    fn told(stays: &[Stay]) -> Vec<(usize, Option<End>, Option<End>)> {
        let end = |end: Option<WayEnd>| end.map(|end| (end.way, end.is_last));
        stays.iter().map(|stay| (stay.spot, end(stay.came), end(stay.left))).collect()
    }

    /// A spot in the middle, and spots 10 m to the west, east, north and south of it; ways lead outward.
    fn plus() -> Network {
        let spots = [[0.0, 0.0], [-10.0, 0.0], [10.0, 0.0], [0.0, 10.0], [0.0, -10.0]];
        let lines: Vec<_> = (1..5).map(|spot| (0, spot, vec![])).collect();
        drawn(&spots, &lines)
    }

    #[test]
    fn across_a_crossing_and_back_from_an_end() {
        let way = [[-10.0, 0.0], [0.0, 0.0], [0.0, 10.0], [0.0, 0.0], [10.0, 0.0]];
        for every in [1, 3, 7] {
            assert_eq!(
                told(&walked(&plus(), &way, every)),
                [
                    (1, None, Some((0, true))),
                    (0, Some((0, false)), Some((2, false))),
                    (3, Some((2, true)), Some((2, true))),
                    (0, Some((2, false)), Some((1, false))),
                    (2, Some((1, true)), None),
                ]
            );
        }
    }

    #[test]
    fn who_turns_back_on_the_way_never_left() {
        let way = [[-10.0, 0.0], [0.0, 0.0], [0.0, 5.0], [0.0, 0.0], [10.0, 0.0]];
        let stays = walked(&plus(), &way, 2);
        assert_eq!(
            told(&stays),
            [(1, None, Some((0, true))), (0, Some((0, false)), Some((1, false))), (2, Some((1, true)), None),]
        );
    }

    #[test]
    fn a_spot_that_no_scan_came_near_was_passed() {
        let network = plus();
        let before = poses(&[[-10.0, 0.0], [-3.0, 0.0]], 2);
        let after = poses(&[[0.0, -3.0], [0.0, -10.0]], 2);
        let poses: Vec<Pose> = before.into_iter().chain(after).collect();
        let stays = walk(&network, &travelled(&network), &poses, &RouteOptions::default());
        assert_eq!(
            told(&stays),
            [(1, None, Some((0, true))), (0, Some((0, false)), Some((3, false))), (4, Some((3, true)), None),]
        );
    }

    #[test]
    fn who_begins_on_a_way_comes_by_it() {
        let stays = walked(&plus(), &[[-5.0, 0.0], [0.0, 0.0], [0.0, -5.0]], 2);
        assert_eq!(told(&stays), [(0, Some((0, false)), None)]);
    }

    /// Two spots at opposite sides of a ring: way 0 leads from the left to the right above, way 1 below.
    fn ring() -> Network {
        let (above, below) = (vec![[-8.0, 6.0], [8.0, 6.0]], vec![[-8.0, -6.0], [8.0, -6.0]]);
        drawn(&[[-8.0, 0.0], [8.0, 0.0]], &[(0, 1, above), (0, 1, below)])
    }

    const AROUND: [[f64; 2]; 7] =
        [[-8.0, 0.0], [-8.0, 6.0], [8.0, 6.0], [8.0, 0.0], [8.0, -6.0], [-8.0, -6.0], [-8.0, 0.0]];

    #[test]
    fn around_a_ring_twice_and_back() {
        let corners: Vec<[f64; 2]> =
            AROUND.iter().chain(&AROUND[1..]).chain(AROUND.iter().rev().skip(1)).copied().collect();
        let stays = walked(&ring(), &corners, 2);
        assert_eq!(stays.iter().map(|stay| stay.spot).collect::<Vec<_>>(), [0, 1, 0, 1, 0, 1, 0]);
        let ends = |spot: usize, way: usize| Some((way, spot == 1));
        // Clockwise twice: above to the right, below to the left; then the same below first.
        let ways = [0, 1, 0, 1, 1, 0];
        for (index, way) in ways.into_iter().enumerate() {
            let (from, to) = (stays[index], stays[index + 1]);
            assert_eq!(told(&[from])[0].2, ends(from.spot, way), "{index}");
            assert_eq!(told(&[to])[0].1, ends(to.spot, way), "{index}");
        }
    }

    /// A ring with one spot: its way leads back to where it began.
    #[test]
    fn around_a_ring_with_one_spot() {
        let network = drawn(&[[-8.0, 0.0]], &[(0, 0, AROUND[1..6].to_vec())]);
        let there = walked(&network, &AROUND, 2);
        assert_eq!(told(&there), [(0, None, Some((0, false))), (0, Some((0, true)), None)]);
        let corners: Vec<[f64; 2]> = AROUND.iter().rev().copied().collect();
        let back = walked(&network, &corners, 2);
        assert_eq!(told(&back), [(0, None, Some((0, true))), (0, Some((0, false)), None)]);
        let half: Vec<[f64; 2]> = AROUND[..3].iter().chain(AROUND[..2].iter().rev()).copied().collect();
        assert_eq!(told(&walked(&network, &half, 2)), [(0, None, None)]);
    }
}
