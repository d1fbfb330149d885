//! The exploration in the checker's own terms: stars as lists of ends, visits and travels by number.
//!
//! This is the only file that knows the types of the other crates; everything else works on indices.

use hssh_causal::Exploration;
use hssh_topology::{Olp, Star};
use nalgebra::Matrix3;

use crate::pose::Pose;

/// A star type: its ends in clockwise order.
pub(crate) struct Shape {
    /// Whether an end can be travelled.
    pub(crate) open: Vec<bool>,
    /// What else is known of an end.
    pub(crate) label: Vec<Option<String>>,
    /// The other end of the same local path.
    pub(crate) opposite: Vec<usize>,
    /// Where an end points, in radians counterclockwise, if that was measured.
    pub(crate) bearings: Vec<Option<f64>>,
}

/// A measured relative pose.
pub(crate) struct Motion {
    /// The arrival's frame in the departure's.
    pub(crate) pose: Pose,
    /// Its covariance.
    pub(crate) covariance: Matrix3<f64>,
}

/// A travel by the ends that it used.
pub(crate) struct Leg {
    /// The end of the departure's star.
    pub(crate) exit: usize,
    /// The end of the arrival's star.
    pub(crate) entry: usize,
    /// What was measured on the way.
    pub(crate) motion: Option<Motion>,
}

/// An exploration: travel `t` leads from visit `t` to visit `t + 1`.
pub(crate) struct Route {
    /// All star types.
    pub(crate) shapes: Vec<Shape>,
    /// The star type seen on each visit.
    pub(crate) visits: Vec<usize>,
    /// The travels in order.
    pub(crate) legs: Vec<Leg>,
    /// `matches[s][f][r]`: whether end `i` of `s` ↦ end `i + r` of `f` is a star isomorphism.
    matches: Vec<Vec<Vec<bool>>>,
}

impl Shape {
    fn of(star: &Star, bearings: &[Option<f64>]) -> Shape {
        let ends: Vec<Olp> = star.olps().collect();
        Shape {
            open: ends.iter().map(|&end| star.is_travelable(end)).collect(),
            label: star.ends().iter().map(|end| end.label.clone()).collect(),
            opposite: ends.iter().map(|&end| star.opposite(end).index()).collect(),
            bearings: bearings.to_vec(),
        }
    }

    /// How many ends it has.
    pub(crate) fn degree(&self) -> usize {
        self.open.len()
    }

    /// How many ends can be travelled.
    pub(crate) fn gateways(&self) -> usize {
        self.open.iter().filter(|&&open| open).count()
    }

    fn rotations_to(&self, other: &Shape) -> Vec<bool> {
        let n = self.degree();
        if n != other.degree() {
            return Vec::new();
        }
        let keeps = |i: usize, r: usize| {
            let image = (i + r) % n;
            self.open[i] == other.open[image]
                && self.label[i] == other.label[image]
                && (self.opposite[i] + r) % n == other.opposite[image]
        };
        (0..n).map(|r| (0..n).all(|i| keeps(i, r))).collect()
    }
}

impl Route {
    /// The exploration, with all isomorphisms between its star types.
    pub(crate) fn of(exploration: &Exploration) -> Route {
        let shapes: Vec<Shape> =
            exploration.star_types().iter().map(|named| Shape::of(&named.star, &named.bearings)).collect();
        let matches =
            shapes.iter().map(|from| shapes.iter().map(|to| from.rotations_to(to)).collect()).collect();
        let leg = |travel: &hssh_causal::Travel| Leg {
            exit: travel.exit.index(),
            entry: travel.entry.index(),
            motion: travel.odometry.as_ref().map(|odometry| Motion {
                pose: Pose::new(odometry.x, odometry.y, odometry.theta),
                covariance: Matrix3::from_fn(|row, column| odometry.covariance[row][column]),
            }),
        };
        Route {
            visits: exploration.visits().map(|star| star.index()).collect(),
            legs: exploration.travels().iter().map(leg).collect(),
            shapes,
            matches,
        }
    }

    /// The star type seen on a visit.
    pub(crate) fn shape(&self, visit: usize) -> &Shape {
        &self.shapes[self.visits[visit]]
    }

    /// How many travels there are.
    pub(crate) fn travels(&self) -> usize {
        self.legs.len()
    }

    /// The rotation that takes end `from` of star type `s` to end `to` of star type `f`, if it is an isomorphism.
    pub(crate) fn anchored(&self, s: usize, from: usize, f: usize, to: usize) -> Option<usize> {
        let rotations = &self.matches[s][f];
        let n = rotations.len();
        if n == 0 {
            return None;
        }
        let rotation = (to + n - from) % n;
        rotations[rotation].then_some(rotation)
    }

    /// All rotations that take star type `s` to star type `f`.
    pub(crate) fn isomorphisms(&self, s: usize, f: usize) -> impl Iterator<Item = usize> + '_ {
        self.matches[s][f].iter().enumerate().filter(|(_, holds)| **holds).map(|(rotation, _)| rotation)
    }
}
