//! Poses in the plane, the group SE(2), and the derivatives of its operations (section 4.2).

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3, matrix, vector};
use serde::{Deserialize, Serialize};

use crate::angle::wrap_angle;

/// A position and an orientation in the plane; or, seen otherwise, a frame of reference relative to another.
///
/// All operations return θ in (−π, π]. Two poses may hold the same θ differently wrapped and are then
/// unequal to `==` although they are the same pose.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Pose {
    /// Metres along the x axis.
    pub x: f64,
    /// Metres along the y axis.
    pub y: f64,
    /// Radians, counterclockwise from the x axis.
    pub theta: f64,
}

impl Pose {
    /// The origin, looking along the x axis: the neutral element of ⊕.
    pub const IDENTITY: Pose = Pose { x: 0.0, y: 0.0, theta: 0.0 };

    /// A pose from metres, metres and radians; θ is wrapped.
    #[must_use]
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        Pose { x, y, theta: wrap_angle(theta) }
    }

    /// The position alone.
    #[must_use]
    pub fn translation(self) -> Vector2<f64> {
        vector![self.x, self.y]
    }

    /// The rotation matrix of θ: it takes coordinates in this frame to the frame that the pose is given in.
    #[must_use]
    pub fn rotation(self) -> Matrix2<f64> {
        rotation(self.theta)
    }

    /// Whether all three numbers are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.theta.is_finite()
    }

    /// `self ⊕ other`: `other`, given in the frame of `self`, as seen from the frame that `self` is given in.
    #[must_use]
    pub fn compose(self, other: Pose) -> Pose {
        let position = self.translation() + self.rotation() * other.translation();
        Pose::new(position.x, position.y, self.theta + other.theta)
    }

    /// `⊖ self`: the original frame as seen from this pose.
    #[must_use]
    pub fn inverse(self) -> Pose {
        let position = -(self.rotation().transpose() * self.translation());
        Pose::new(position.x, position.y, -self.theta)
    }

    /// `(⊖ self) ⊕ other`: `other` as seen from `self`, equation (4.1).
    #[must_use]
    pub fn between(self, other: Pose) -> Pose {
        let position = self.rotation().transpose() * (other.translation() - self.translation());
        Pose::new(position.x, position.y, other.theta - self.theta)
    }

    /// The pose reached by following the twist (metres, metres, radians) for one unit of time.
    #[must_use]
    pub fn exp(twist: Vector3<f64>) -> Pose {
        let half = twist.z / 2.0;
        let position = sinc(half) * (rotation(half) * twist.xy());
        Pose::new(position.x, position.y, twist.z)
    }

    /// The twist with the smallest turn that leads from the origin here: the inverse of [`Pose::exp`].
    #[must_use]
    pub fn log(self) -> Vector3<f64> {
        let theta = wrap_angle(self.theta);
        let half = theta / 2.0;
        let velocity = rotation(-half) * self.translation() / sinc(half);
        vector![velocity.x, velocity.y, theta]
    }

    /// The matrix with `self ⊕ exp(ξ) ⊕ ⊖self = exp(adjoint · ξ)`.
    #[must_use]
    pub fn adjoint(self) -> Matrix3<f64> {
        let (s, c) = self.theta.sin_cos();
        matrix![c, -s, self.y; s, c, -self.x; 0.0, 0.0, 1.0]
    }

    /// The derivatives of `self ⊕ other` by (x, y, θ) of `self` and of `other`.
    #[must_use]
    pub fn compose_jacobians(self, other: Pose) -> (Matrix3<f64>, Matrix3<f64>) {
        let lever = self.rotation() * other.translation();
        let by_self = matrix![1.0, 0.0, -lever.y; 0.0, 1.0, lever.x; 0.0, 0.0, 1.0];
        (by_self, frame_rotation(self.theta))
    }

    /// The derivative of `⊖ self` by (x, y, θ).
    #[must_use]
    pub fn inverse_jacobian(self) -> Matrix3<f64> {
        between_jacobian_by_start(self.theta, self.inverse())
    }

    /// The derivatives of `(⊖ self) ⊕ other` by (x, y, θ) of `self` and of `other`: S (B.7) and E (B.8).
    #[must_use]
    pub fn between_jacobians(self, other: Pose) -> (Matrix3<f64>, Matrix3<f64>) {
        let by_self = between_jacobian_by_start(self.theta, self.between(other));
        (by_self, frame_rotation(-self.theta))
    }
}

/// S of (B.7): how the relative pose `tau` changes with the start pose, which looks along `theta`.
pub(crate) fn between_jacobian_by_start(theta: f64, tau: Pose) -> Matrix3<f64> {
    let (s, c) = theta.sin_cos();
    matrix![-c, -s, tau.y; s, -c, -tau.x; 0.0, 0.0, -1.0]
}

/// The matrix that turns (x, y) by `theta` and leaves an angle alone; with −θ_s it is E of (B.8).
pub(crate) fn frame_rotation(theta: f64) -> Matrix3<f64> {
    let (s, c) = theta.sin_cos();
    matrix![c, -s, 0.0; s, c, 0.0; 0.0, 0.0, 1.0]
}

fn rotation(theta: f64) -> Matrix2<f64> {
    let (s, c) = theta.sin_cos();
    matrix![c, -s; s, c]
}

/// sin(x) / x, which is exact near zero too.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}
