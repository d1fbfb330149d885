//! What a robot is sent by: points and straight legs between them, the corners of ways among the points.

use super::error::ExportError;
use super::route_graph::{Door, RouteGraph, distance};

/// No two neighboring points of a way are farther apart, in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spacing(f64);

/// A graph in which straight from point to point can be driven wherever there is a leg.
#[derive(Clone, PartialEq, Debug)]
pub struct DriveGraph<'a> {
    /// What it is made of.
    pub routes: &'a RouteGraph,
    /// The nodes of the routes in their order, and behind them the points on the ways, way by way.
    pub points: Vec<DrivePoint>,
    /// The legs, way by way; each can be driven in both directions. There is one at least.
    pub legs: Vec<DriveLeg>,
}

/// A point to drive to.
#[derive(Clone, PartialEq, Debug)]
pub struct DrivePoint {
    /// Its name; no other point has it.
    pub name: String,
    /// Where it is, in metres.
    pub position: [f64; 2],
    /// The way that it is a corner of; `None` for nodes.
    pub way: Option<usize>,
}

/// A straight part of a way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DriveLeg {
    /// The points, by number; they are different ones.
    pub ends: [usize; 2],
    /// The way that it is a part of.
    pub way: usize,
}

impl Spacing {
    /// Nothing is driven by points that are nearer than that, in metres.
    pub const LEAST: f64 = 0.05;

    /// So many metres; `None` if that is less than [`Spacing::LEAST`] or no number.
    #[must_use]
    pub fn new(metres: f64) -> Option<Self> {
        (metres >= Self::LEAST && metres.is_finite()).then_some(Spacing(metres))
    }

    /// In metres.
    #[must_use]
    pub fn metres(self) -> f64 {
        self.0
    }
}

/// Five metres.
impl Default for Spacing {
    fn default() -> Self {
        Spacing(5.0)
    }
}

impl<'a> DriveGraph<'a> {
    /// So many points are made at most.
    pub const MOST_POINTS: usize = 1_000_000;
    /// Corners nearer to the point before are left out, in metres.
    const NEAREST: f64 = 1e-3;

    /// The points and legs of routes, with the corners of their ways and, where these are far apart, points between.
    ///
    /// # Errors
    /// If there is no way, a node has no position, a way has no line, or there would be too many points.
    pub fn new(routes: &'a RouteGraph, spacing: Spacing) -> Result<Self, ExportError> {
        if routes.ways.is_empty() {
            return Err(ExportError::NoLink);
        }
        let node = |(number, node): (usize, &super::RouteNode)| {
            Ok(DrivePoint { name: node.name.clone(), position: routes.position(number)?, way: None })
        };
        let points = routes.nodes.iter().enumerate().map(node).collect::<Result<_, ExportError>>()?;
        let mut graph = DriveGraph { routes, points, legs: Vec::new() };
        for way in 0..routes.ways.len() {
            graph.add_way(way, spacing)?;
        }
        Ok(graph)
    }

    fn add_way(&mut self, number: usize, spacing: Spacing) -> Result<(), ExportError> {
        let way = &self.routes.ways[number];
        let [from, to] = way.ends;
        let corners = corners(&way.line, [from, to].map(|end| self.points[end].position));
        let line = subdivided(&corners, spacing).ok_or(ExportError::TooMany { most: Self::MOST_POINTS })?;
        let inner = &line[1..line.len() - 1];
        if from == to && inner.is_empty() {
            return Err(ExportError::UnknownLoop { way: number, place: from });
        }
        if self.points.len() + inner.len() > Self::MOST_POINTS {
            return Err(ExportError::TooMany { most: Self::MOST_POINTS });
        }
        let first = self.points.len();
        self.points.extend(inner.iter().enumerate().map(|(index, &position)| DrivePoint {
            name: format!("way {number}.{}", index + 1),
            position,
            way: Some(number),
        }));
        let chain: Vec<usize> =
            std::iter::once(from).chain(first..first + inner.len()).chain(std::iter::once(to)).collect();
        self.legs.extend(chain.windows(2).map(|pair| DriveLeg { ends: [pair[0], pair[1]], way: number }));
        Ok(())
    }

    /// The door that a leg leads through: the one of which it crosses or touches the line from post to post.
    #[must_use]
    pub fn door(&self, leg: &DriveLeg) -> Option<&'a Door> {
        let [from, to] = leg.ends.map(|end| self.points[end].position);
        self.routes.doors.iter().find(|door| meet([from, to], door.posts))
    }

    /// How long a leg is, in metres.
    #[must_use]
    pub fn length(&self, leg: &DriveLeg) -> f64 {
        let [from, to] = leg.ends.map(|end| self.points[end].position);
        distance(from, to)
    }
}

/// The corners of a line from node to node: those that lie on the one before are left out, and the last ones that lie on its end.
fn corners(line: &[[f64; 2]], [from, to]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let is_apart = |one: [f64; 2], other: [f64; 2]| distance(one, other) > DriveGraph::NEAREST;
    let mut corners = vec![from];
    for &corner in line.get(1..line.len().saturating_sub(1)).unwrap_or_default() {
        if is_apart(corner, corners[corners.len() - 1]) {
            corners.push(corner);
        }
    }
    while corners.len() > 1 && !is_apart(corners[corners.len() - 1], to) {
        corners.pop();
    }
    corners.push(to);
    corners
}

/// The line with points between corners that are too far apart; `None` if they would be too many.
fn subdivided(corners: &[[f64; 2]], spacing: Spacing) -> Option<Vec<[f64; 2]>> {
    let mut line = vec![corners[0]];
    for pair in corners.windows(2) {
        let parts = (distance(pair[0], pair[1]) / spacing.metres()).ceil().max(1.0);
        let most = DriveGraph::MOST_POINTS as f64;
        // Of lengths that are no numbers nothing can be said.
        if (parts + line.len() as f64).total_cmp(&most).is_gt() {
            return None;
        }
        let between = |part: u64| {
            let part = part as f64 / parts;
            [0, 1].map(|axis| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]))
        };
        line.extend((1..parts as u64).map(between));
        line.push(pair[1]);
    }
    Some(line)
}

/// Whether two straight lines cross or touch.
fn meet(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> bool {
    /// What is nearer than this touches, in metres.
    const TOUCH: f64 = 1e-6;
    // How far a point is to the left of a line.
    let left = |[a, b]: [[f64; 2]; 2], point: [f64; 2]| {
        let length = distance(a, b).max(f64::MIN_POSITIVE);
        ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])) / length
    };
    let parts = |line: [[f64; 2]; 2], points: [[f64; 2]; 2]| {
        let [a, b] = points.map(|point| left(line, point));
        a.min(b) <= TOUCH && a.max(b) >= -TOUCH
    };
    let are_near = |axis: usize| {
        let [one, other] = [one, other].map(|[a, b]| [a[axis].min(b[axis]), a[axis].max(b[axis])]);
        one[0] <= other[1] + TOUCH && other[0] <= one[1] + TOUCH
    };
    parts(one, other) && parts(other, one) && (0..2).all(are_near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_meet_where_they_cross_or_touch() {
        let door = [[0.0, -0.5], [0.0, 0.5]];
        assert!(meet([[-1.0, 0.0], [1.0, 0.2]], door));
        assert!(meet([[-1.0, 0.0], [0.0, 0.0]], door));
        assert!(!meet([[-1.0, 0.0], [-0.1, 0.0]], door));
        assert!(!meet([[-1.0, 0.6], [1.0, 0.6]], door));
        assert!(!meet([[-1.0, 2.0], [1.0, -0.4]], door));
        assert!(!meet([[0.0, 0.6], [0.0, 3.0]], door));
    }
}
