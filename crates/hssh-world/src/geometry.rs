//! Points and bearings of the plane: x east, y north, metres and radians counterclockwise.

use std::f64::consts::{PI, TAU};

/// A point of the world, in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point {
    /// Metres east.
    pub x: f64,
    /// Metres north.
    pub y: f64,
}

impl Point {
    /// The point at (x, y).
    #[must_use]
    pub fn new(x: f64, y: f64) -> Self {
        Point { x, y }
    }

    /// The straight distance to another point, in metres.
    #[must_use]
    pub fn distance_to(self, other: Point) -> f64 {
        (other.x - self.x).hypot(other.y - self.y)
    }

    /// The bearing of another point, in (−π, π] counterclockwise from east.
    #[must_use]
    pub fn bearing_to(self, other: Point) -> f64 {
        wrap((other.y - self.y).atan2(other.x - self.x))
    }

    pub(crate) fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

/// An angle brought into (−π, π].
pub(crate) fn wrap(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// The length of a chain of straight pieces, in metres.
pub(crate) fn length(chain: &[Point]) -> f64 {
    chain.windows(2).map(|piece| piece[0].distance_to(piece[1])).sum()
}
