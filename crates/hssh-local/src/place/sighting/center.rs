//! The center of a place: where the axes of its ways out meet.

use nalgebra::{Matrix2, Vector2};

use super::axis::Axis;

/// The point with the least sum of squared distances to the axes. A weak pull toward `middle` decides
/// where the axes do not, as between two that are nearly parallel.
pub(super) fn center(axes: impl Iterator<Item = Axis>, middle: Vector2<f64>) -> Vector2<f64> {
    /// Weight of the middle against that of one axis.
    const PULL: f64 = 0.05;
    let mut matrix = Matrix2::identity() * PULL;
    let mut right_side = middle * PULL;
    for axis in axes {
        let across = Matrix2::identity() - axis.direction * axis.direction.transpose();
        matrix += across;
        right_side += across * axis.point;
    }
    matrix.cholesky().map_or(middle, |cholesky| cholesky.solve(&right_side))
}
