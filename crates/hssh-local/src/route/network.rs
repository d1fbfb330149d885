//! The network of the robot's ways: spots where they part, turn back or where a place was sighted, and the ways
//! between them.

use nalgebra::{Vector2, vector};

use super::options::RouteOptions;
use crate::grid::{Cell, OccupancyGrid};
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
    pub(super) fn new(travelled: &OccupancyGrid, options: &RouteOptions) -> Self {
        let skeleton_options = SkeletonOptions {
            clutter: 0.0,
            narrowest_passage: 0.2,
            shallowest_branch: options.shortest_branch,
            ..SkeletonOptions::default()
        };
        let free = FreeSpace::new(travelled, &skeleton_options);
        let skeleton = Skeleton::new(travelled, &free, &skeleton_options);
        Self::of(&skeleton, options)
    }

    /// Junctions that short ways join become one spot.
    fn of(skeleton: &Skeleton, options: &RouteOptions) -> Self {
        let mut group: Vec<usize> = (0..skeleton.nodes.len()).collect();
        let lengths: Vec<f64> =
            skeleton.edges.iter().map(|edge| crate::skeleton::length(&edge.points)).collect();
        let is_junction = |node: usize| skeleton.nodes[node].ends.len() > 2;
        let is_core = |edge: usize| {
            let [from, to] = skeleton.edges[edge].nodes.map(|node| node.index());
            lengths[edge] < options.one_spot && is_junction(from) && is_junction(to)
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
