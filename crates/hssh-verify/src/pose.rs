//! Poses in the plane, as much of them as the checker needs.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

/// A pose: metres, metres, radians counterclockwise.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Pose {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) theta: f64,
}

/// An angle in (−π, π].
pub(crate) fn wrap(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// The mean direction of angles: of the sum of their unit vectors.
pub(crate) fn circular_mean(angles: impl Iterator<Item = f64>) -> f64 {
    let (sine, cosine) = angles.fold((0.0, 0.0), |(s, c), angle| (s + angle.sin(), c + angle.cos()));
    sine.atan2(cosine)
}

/// The matrix that turns x and y and leaves the angle.
pub(crate) fn rotation(angle: f64) -> Matrix3<f64> {
    let (sine, cosine) = angle.sin_cos();
    Matrix3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0)
}

impl Pose {
    /// The frame that all others are seen from.
    pub(crate) const ORIGIN: Pose = Pose { x: 0.0, y: 0.0, theta: 0.0 };

    pub(crate) fn new(x: f64, y: f64, theta: f64) -> Pose {
        Pose { x, y, theta }
    }

    /// `self ⊕ other`.
    pub(crate) fn compose(self, other: Pose) -> Pose {
        let (sine, cosine) = self.theta.sin_cos();
        Pose {
            x: self.x + cosine * other.x - sine * other.y,
            y: self.y + sine * other.x + cosine * other.y,
            theta: self.theta + other.theta,
        }
    }

    /// `⊖self ⊕ other`: `other` as seen from `self`.
    pub(crate) fn sees(self, other: Pose) -> Pose {
        let (sine, cosine) = self.theta.sin_cos();
        let (x, y) = (other.x - self.x, other.y - self.y);
        Pose { x: cosine * x + sine * y, y: cosine * y - sine * x, theta: other.theta - self.theta }
    }

    /// `self − other`, number by number, the angle wrapped.
    pub(crate) fn minus(self, other: Pose) -> Vector3<f64> {
        Vector3::new(self.x - other.x, self.y - other.y, wrap(self.theta - other.theta))
    }

    /// The derivatives of `⊖self ⊕ other` by `self` and by `other`.
    pub(crate) fn sees_derivatives(self, other: Pose) -> [Matrix3<f64>; 2] {
        let seen = self.sees(other);
        let by_other = rotation(-self.theta);
        let mut by_self = -by_other;
        by_self[(0, 2)] = seen.y;
        by_self[(1, 2)] = -seen.x;
        [by_self, by_other]
    }

    /// The derivatives of `self ⊕ other` by `self` and by `other`.
    pub(crate) fn compose_derivatives(self, other: Pose) -> [Matrix3<f64>; 2] {
        let sum = self.compose(other);
        let by_self = Matrix3::new(1.0, 0.0, self.y - sum.y, 0.0, 1.0, sum.x - self.x, 0.0, 0.0, 1.0);
        [by_self, rotation(self.theta)]
    }
}
