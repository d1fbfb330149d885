//! Surfaces seen by the laser: points with the direction they face, and a lattice of buckets to find the
//! nearest one.

use hssh_metrics::Pose;
use nalgebra::{Vector2, vector};
use rustc_hash::FxHashMap;

use crate::scan::Scan;

/// Hits of neighboring beams farther apart than this, in metres, are on different surfaces…
const GAP: f64 = 0.35;
/// …as are those farther apart than this many times the hit's range: far beams are far apart.
const GAP_PER_RANGE: f64 = 0.06;
/// Side of a bucket in metres: also how far [`Cloud::nearest`] looks at least.
const BUCKET: f64 = 0.5;

/// A hit and the direction that the surface there faces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SurfacePoint {
    pub(crate) position: Vector2<f64>,
    /// Of unit length; `None` where too few hits are near to tell.
    pub(crate) normal: Option<Vector2<f64>>,
}

/// The surfaces of a scan in the robot's frame, thinned to about `spacing` metres.
pub(crate) fn surfaces(scan: &Scan, reach: f64, spacing: f64) -> Vec<SurfacePoint> {
    let hits: Vec<(usize, Vector2<f64>)> = scan.hits(reach).collect();
    let mut points: Vec<SurfacePoint> = Vec::new();
    for (index, &(beam, position)) in hits.iter().enumerate() {
        if points.last().is_some_and(|last| (last.position - position).norm() < spacing) {
            continue;
        }
        let gap = GAP.max(GAP_PER_RANGE * position.norm());
        let near = |&(other, point): &(usize, Vector2<f64>)| {
            other.abs_diff(beam) <= 12 && (point - position).norm() < gap
        };
        let window = &hits[index.saturating_sub(12)..hits.len().min(index + 13)];
        let neighbors: Vec<Vector2<f64>> = window.iter().filter(|hit| near(hit)).map(|hit| hit.1).collect();
        points.push(SurfacePoint { position, normal: normal(&neighbors) });
    }
    points
}

/// The direction across the line through points, if they lie on a line.
fn normal(points: &[Vector2<f64>]) -> Option<Vector2<f64>> {
    if points.len() < 4 {
        return None;
    }
    let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for point in points {
        let d = point - mean;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    let along = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = along.sin_cos();
    let spread_along = xx * cos * cos + 2.0 * xy * sin * cos + yy * sin * sin;
    let spread_across = xx + yy - spread_along;
    (spread_across < 0.1 * spread_along).then(|| vector![-sin, cos])
}

/// Surface points in one frame, in buckets.
#[derive(Clone, Default, Debug)]
pub(crate) struct Cloud {
    points: Vec<SurfacePoint>,
    /// For each bucket, which points are in it.
    buckets: FxHashMap<(i32, i32), Vec<u32>>,
}

impl Cloud {
    /// Adds the surfaces seen from a pose of this frame, except where there are points within `spacing`
    /// metres already.
    pub(crate) fn insert(&mut self, pose: Pose, surfaces: &[SurfacePoint], spacing: f64) {
        let rotation = pose.rotation();
        for surface in surfaces {
            let position = pose.translation() + rotation * surface.position;
            let normal = surface.normal.map(|normal| rotation * normal);
            if self.nearest(position, spacing).is_some() {
                continue;
            }
            self.buckets.entry(bucket(position)).or_default().push(self.points.len() as u32);
            self.points.push(SurfacePoint { position, normal });
        }
    }

    /// All points, in the order in which they were added.
    pub(crate) fn points(&self) -> &[SurfacePoint] {
        &self.points
    }

    /// The nearest point with a normal within `reach` metres, which is at most a bucket's side.
    pub(crate) fn nearest(&self, position: Vector2<f64>, reach: f64) -> Option<&SurfacePoint> {
        let (column, row) = bucket(position);
        let mut best = None;
        let mut least = reach * reach;
        for dy in -1..=1 {
            for dx in -1..=1 {
                for &index in self.buckets.get(&(column + dx, row + dy)).into_iter().flatten() {
                    let point = &self.points[index as usize];
                    let distance = (point.position - position).norm_squared();
                    if distance < least && point.normal.is_some() {
                        (best, least) = (Some(point), distance);
                    }
                }
            }
        }
        best
    }
}

fn bucket(position: Vector2<f64>) -> (i32, i32) {
    ((position.x / BUCKET).floor() as i32, (position.y / BUCKET).floor() as i32)
}
