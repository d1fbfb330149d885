//! The axis of a way out: the line along the middle of a corridor.

use nalgebra::Vector2;

/// A line with a direction, in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Axis {
    /// A point of it.
    pub(super) point: Vector2<f64>,
    /// Of unit length, outward.
    pub(super) direction: Vector2<f64>,
}

/// The line that passes best through points, the first of which is the innermost.
pub(super) fn fit(points: &[Vector2<f64>]) -> Option<Axis> {
    let (first, last) = (points.first()?, points.last()?);
    let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for point in points {
        let off = point - mean;
        (xx, xy, yy) = (xx + off.x * off.x, xy + off.x * off.y, yy + off.y * off.y);
    }
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let direction = Vector2::new(angle.cos(), angle.sin());
    let is_outward = direction.dot(&(last - first)) >= 0.0;
    Some(Axis { point: mean, direction: if is_outward { direction } else { -direction } })
}
