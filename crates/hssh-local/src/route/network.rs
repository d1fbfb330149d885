//! The network of the robot's ways: spots where they part, turn back or where a place was sighted, and the ways
//! between them.

use nalgebra::{Vector2, vector};

use super::options::RouteOptions;
use crate::grid::{Cell, Occupancy, OccupancyGrid};
use crate::skeleton::{FreeSpace, Skeleton, SkeletonOptions};

/// One end of a way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct WayEnd {
    pub(super) way: usize,
    /// Whether it is the last point and not the first.
    pub(super) is_last: bool,
}

/// A way between two spots, which may be the same.
#[derive(Clone, Debug)]
pub(super) struct Way {
    pub(super) cells: Vec<Cell>,
    pub(super) points: Vec<Vector2<f64>>,
    /// How far along each point is, in metres.
    pub(super) along: Vec<f64>,
    pub(super) spots: [usize; 2],
}

/// Where ways meet or end, or where a place is.
#[derive(Clone, Debug)]
pub(super) struct Spot {
    pub(super) center: Vector2<f64>,
    /// The ends of ways here, in no particular order.
    pub(super) arms: Vec<WayEnd>,
    /// The cells of short ways within the spot.
    pub(super) core: Vec<Cell>,
}

/// Spots and ways.
#[derive(Clone, Debug, Default)]
pub(super) struct Network {
    pub(super) spots: Vec<Spot>,
    pub(super) ways: Vec<Way>,
}

/// How far it is from a cell to the nearest wall, in metres; `most` if it is farther.
fn room(building: &OccupancyGrid, from: Cell, most: f64) -> f64 {
    let lattice = building.lattice();
    let reach = (most / lattice.resolution()).ceil() as i32;
    let around = (-reach..=reach).flat_map(|rows| (-reach..=reach).map(move |columns| (columns, rows)));
    let walls = around.filter(|&(columns, rows)| {
        lattice.step(from, columns, rows).is_some_and(|cell| building.get(cell) == Occupancy::Occupied)
    });
    let off = |(columns, rows): (i32, i32)| f64::from(columns).hypot(f64::from(rows)) * lattice.resolution();
    walls.map(off).fold(most, f64::min)
}

impl WayEnd {
    pub(super) fn opposite(self) -> Self {
        WayEnd { is_last: !self.is_last, ..self }
    }
}

impl Way {
    fn new(cells: Vec<Cell>, points: Vec<Vector2<f64>>, spots: [usize; 2]) -> Self {
        let mut along = vec![0.0];
        for pair in points.windows(2) {
            along.push(along[along.len() - 1] + (pair[1] - pair[0]).norm());
        }
        Way { cells, points, along, spots }
    }

    pub(super) fn length(&self) -> f64 {
        self.along[self.along.len() - 1]
    }

    /// The point so many metres from one of the ends, or the other end if the way is shorter.
    pub(super) fn point_from(&self, is_last: bool, distance: f64) -> Vector2<f64> {
        let at = if is_last { self.length() - distance } else { distance };
        let index = self.along.partition_point(|&along| along < at).min(self.points.len() - 1);
        self.points[index]
    }
}

impl Network {
    /// The network of travelled cells.
    pub(super) fn new(travelled: &OccupancyGrid, building: &OccupancyGrid, options: &RouteOptions) -> Self {
        let skeleton_options = SkeletonOptions {
            clutter: 0.0,
            narrowest_passage: 0.2,
            shallowest_branch: options.shortest_branch,
            ..SkeletonOptions::default()
        };
        let free = FreeSpace::new(travelled, &skeleton_options);
        let skeleton = Skeleton::new(travelled, &free, &skeleton_options);
        let room: Vec<f64> =
            skeleton.nodes.iter().map(|node| room(building, node.at.cell, options.largest_spot)).collect();
        Self::of(&skeleton, &room, options)
    }

    /// Junctions that short ways join become one spot: ways no longer than there is room around them, by node in `room`.
    fn of(skeleton: &Skeleton, room: &[f64], options: &RouteOptions) -> Self {
        let mut group: Vec<usize> = (0..skeleton.nodes.len()).collect();
        let lengths: Vec<f64> =
            skeleton.edges.iter().map(|edge| crate::skeleton::length(&edge.points)).collect();
        let is_junction = |node: usize| skeleton.nodes[node].ends.len() > 2;
        let is_core = |edge: usize| {
            let [from, to] = skeleton.edges[edge].nodes.map(|node| node.index());
            let one_spot = options.one_spot.max(options.roomy * room[from].max(room[to]));
            lengths[edge] < one_spot.min(options.largest_spot) && is_junction(from) && is_junction(to)
        };
        for (index, edge) in skeleton.edges.iter().enumerate() {
            if is_core(index) {
                let [from, to] = edge.nodes.map(|node| group[node.index()]);
                group.iter_mut().filter(|member| **member == to).for_each(|member| *member = from);
            }
        }
        let mut network = Network::default();
        let mut spot_of = vec![usize::MAX; skeleton.nodes.len()];
        for root in 0..skeleton.nodes.len() {
            let members: Vec<usize> = (0..skeleton.nodes.len()).filter(|&node| group[node] == root).collect();
            if members.is_empty() {
                continue;
            }
            let positions = members.iter().map(|&node| Vector2::from(skeleton.nodes[node].at.point));
            let center = positions.sum::<Vector2<f64>>() / members.len() as f64;
            members.iter().for_each(|&node| spot_of[node] = network.spots.len());
            let core = members.iter().map(|&node| skeleton.nodes[node].at.cell).collect();
            network.spots.push(Spot { center, arms: Vec::new(), core });
        }
        for (index, edge) in skeleton.edges.iter().enumerate() {
            let spots = edge.nodes.map(|node| spot_of[node.index()]);
            let cells = edge.points.iter().map(|point| point.cell);
            if is_core(index) {
                network.spots[spots[0]].core.extend(cells);
            } else {
                let points =
                    edge.points.iter().map(|point| vector![point.point[0], point.point[1]]).collect();
                network.ways.push(Way::new(cells.collect(), points, spots));
            }
        }
        network.connect();
        network
    }

    /// Tells each spot its arms.
    fn connect(&mut self) {
        self.spots.iter_mut().for_each(|spot| spot.arms.clear());
        for (index, way) in self.ways.iter().enumerate() {
            for (is_last, spot) in [(false, way.spots[0]), (true, way.spots[1])] {
                self.spots[spot].arms.push(WayEnd { way: index, is_last });
            }
        }
    }

    /// Puts new spots on a way, at these positions along it in increasing order.
    pub(super) fn split(&mut self, way: usize, at: &[f64]) -> Vec<usize> {
        let old = self.ways[way].clone();
        let mut added = Vec::new();
        let (mut first, mut spot) = (0, old.spots[0]);
        for (number, &at) in at.iter().enumerate() {
            let index = old.along.partition_point(|&along| along < at).clamp(first + 1, old.points.len() - 2);
            self.spots.push(Spot { center: old.points[index], arms: Vec::new(), core: Vec::new() });
            let next = self.spots.len() - 1;
            added.push(next);
            let part =
                Way::new(old.cells[first..=index].to_vec(), old.points[first..=index].to_vec(), [spot, next]);
            if number == 0 {
                self.ways[way] = part
            } else {
                self.ways.push(part)
            }
            (first, spot) = (index, next);
        }
        if !at.is_empty() {
            self.ways.push(Way::new(
                old.cells[first..].to_vec(),
                old.points[first..].to_vec(),
                [spot, old.spots[1]],
            ));
        }
        self.connect();
        added
    }

    /// The ways on the shortest path between two spots, as ends to leave by; nothing if there is none.
    pub(super) fn path(&self, from: usize, to: usize) -> Vec<WayEnd> {
        let mut came: Vec<Option<WayEnd>> = vec![None; self.spots.len()];
        let mut distance = vec![f64::INFINITY; self.spots.len()];
        let mut open = vec![from];
        distance[from] = 0.0;
        while let Some(position) =
            (0..open.len()).min_by(|&a, &b| distance[open[a]].total_cmp(&distance[open[b]]))
        {
            let spot = open.swap_remove(position);
            if spot == to {
                break;
            }
            for &arm in &self.spots[spot].arms {
                let next = self.spot_at(arm.opposite());
                let farther = distance[spot] + self.ways[arm.way].length();
                if farther < distance[next] {
                    distance[next] = farther;
                    came[next] = Some(arm);
                    if !open.contains(&next) {
                        open.push(next);
                    }
                }
            }
        }
        let mut path = Vec::new();
        let mut spot = to;
        while spot != from {
            let Some(arm) = came[spot] else { return Vec::new() };
            path.push(arm);
            spot = self.spot_at(arm);
        }
        path.reverse();
        path
    }

    /// The spot at the end of a way.
    pub(super) fn spot_at(&self, end: WayEnd) -> usize {
        self.ways[end.way].spots[usize::from(end.is_last)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawn::{drawn, networks};
    use super::*;
    use proptest::prelude::*;

    /// Whether every end of a way is an arm of its spot, and no other arm is.
    fn is_connected(network: &Network) -> bool {
        let mut arms: Vec<(WayEnd, usize)> = Vec::new();
        for (index, spot) in network.spots.iter().enumerate() {
            arms.extend(spot.arms.iter().map(|&arm| (arm, index)));
        }
        arms.sort();
        let ends = (0..network.ways.len()).flat_map(|way| {
            [false, true]
                .map(|is_last| (WayEnd { way, is_last }, network.ways[way].spots[usize::from(is_last)]))
        });
        arms == ends.collect::<Vec<_>>()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn split_keeps_lengths_and_connections(
            corners in prop::collection::vec((-15.0_f64..15.0, -15.0_f64..15.0).prop_map(|(x, y)| [x, y]), 1..4),
            parts in prop::collection::vec(0.2_f64..1.0, 1..5),
        ) {
            let mut network =
                drawn(&[[-16.0, 0.0], [16.0, 0.0], [0.0, 17.0]], &[(0, 1, corners), (1, 2, vec![]), (2, 0, vec![])]);
            let old = network.ways[0].clone();
            let total: f64 = parts.iter().sum::<f64>() + 0.3;
            let at: Vec<f64> = parts
                .iter()
                .scan(0.0, |sum, part| { *sum += part; Some(*sum / total * old.length()) })
                .collect();
            let added = network.split(0, &at);
            prop_assert!(is_connected(&network));
            prop_assert_eq!(&added, &(3..3 + at.len()).collect::<Vec<_>>());
            // The parts in order are the first one and those at the end of the list.
            let chain: Vec<usize> = [0].into_iter().chain(3..network.ways.len()).collect();
            let mut points: Vec<Vector2<f64>> = Vec::new();
            let (mut spot, mut length) = (0, 0.0);
            for (number, &way) in chain.iter().enumerate() {
                let way = &network.ways[way];
                prop_assert_eq!(way.spots[0], spot);
                prop_assert_eq!((way.points.len(), way.cells.len()), (way.along.len(), way.along.len()));
                prop_assert_eq!(way.along[0], 0.0);
                prop_assert!(way.points.len() > 1);
                points.extend(&way.points[usize::from(number > 0)..]);
                (spot, length) = (way.spots[1], length + way.length());
                if let Some(at) = at.get(number) {
                    prop_assert!((length - at).abs() <= 0.11, "at {} instead of {}", length, at);
                    prop_assert_eq!(network.spots[spot].center, way.points[way.points.len() - 1]);
                }
            }
            prop_assert_eq!((spot, points), (1, old.points));
            prop_assert!((length - old.along[old.along.len() - 1]).abs() < 1e-9);
            prop_assert_eq!((network.ways[1].spots, network.ways[2].spots), ([1, 2], [2, 0]));
        }

        /// Against the algorithm of Floyd and Warshall.
        #[test]
        fn paths_are_shortest(network in networks(), from in 0_usize..6, to in 0_usize..6) {
            let count = network.spots.len();
            let (from, to) = (from % count, to % count);
            let mut distances = vec![vec![f64::INFINITY; count]; count];
            for way in &network.ways {
                let [one, other] = way.spots;
                let length: f64 = way.points.windows(2).map(|pair| (pair[0] - pair[1]).norm()).sum();
                distances[one][other] = distances[one][other].min(length);
                distances[other][one] = distances[other][one].min(length);
            }
            for middle in 0..count {
                for (one, other) in (0..count).flat_map(|one| (0..count).map(move |other| (one, other))) {
                    let by = distances[one][middle] + distances[middle][other];
                    distances[one][other] = distances[one][other].min(by);
                }
            }
            let path = network.path(from, to);
            if from == to || distances[from][to].is_infinite() {
                prop_assert!(path.is_empty());
            } else {
                let (mut at, mut length) = (from, 0.0);
                for arm in path {
                    let spots = network.ways[arm.way].spots;
                    prop_assert_eq!(spots[usize::from(arm.is_last)], at);
                    at = spots[usize::from(!arm.is_last)];
                    length += network.ways[arm.way].length();
                }
                prop_assert_eq!(at, to);
                prop_assert!((length - distances[from][to]).abs() < 1e-9);
            }
        }
    }
}
