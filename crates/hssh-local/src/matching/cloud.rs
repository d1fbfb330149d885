//! Surfaces seen by the laser: points with the direction they face, and a lattice of buckets to find the
//! nearest one.

use hssh_metrics::Pose;
use nalgebra::{Vector2, vector};
use rustc_hash::FxHashMap;

use crate::scan::Scan;

/// Hits of neighboring beams farther apart than this, in metres, are on different surfaces…
const GAP: f64 = 0.35;
/// …as are those farther apart than this many times the hit's range: far beams are far apart…
const GAP_PER_RANGE: f64 = 0.06;
/// …unless they lie on one line, as those of beams that graze a wall do: up to so many times the range.
const GRAZING_GAP_PER_RANGE: f64 = 0.3;
/// Hits are on one line if they are no farther off than this, in metres, root mean square.
const STRAIGHT: f64 = 0.03;
/// Between hits on one line, a wall is taken to be there every so many metres, if they are no farther apart than the second
/// number.
const FILLING: (f64, f64) = (0.2, 4.0);
/// Directions of surfaces differ by less than about 10° along a wall.
const PARALLEL: f64 = 0.985;
/// Side of a bucket in metres: also how far [`Cloud::nearest`] looks at most.
const BUCKET: f64 = 0.5;

/// A hit and the direction that the surface there faces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SurfacePoint {
    pub(crate) position: Vector2<f64>,
    /// Of unit length, towards where it was seen from: a jamb is another surface than the one across its doorway, which is seen from the
    /// other side only. `None` where too few hits are near to tell.
    pub(crate) normal: Option<Vector2<f64>>,
}

/// The surfaces of a scan in the robot's frame, thinned to about `spacing` metres.
pub(crate) fn surfaces(scan: &Scan, reach: f64, spacing: f64) -> Vec<SurfacePoint> {
    let hits: Vec<(usize, Vector2<f64>)> = scan.hits(reach).collect();
    let mut points: Vec<SurfacePoint> = Vec::new();
    for (index, &(_, position)) in hits.iter().enumerate() {
        if points.last().is_some_and(|last| (last.position - position).norm() < spacing) {
            continue;
        }
        let range = position.norm();
        let near = neighbors(&hits, index, GAP.max(GAP_PER_RANGE * range));
        let normal = normal(&near, f64::INFINITY)
            .or_else(|| normal(&neighbors(&hits, index, GRAZING_GAP_PER_RANGE * range), STRAIGHT))
            .map(|normal| if normal.dot(&position) > 0.0 { -normal } else { normal });
        points.push(SurfacePoint { position, normal });
    }
    points
}

/// The hits next to one on either side, up to a gap.
fn neighbors(hits: &[(usize, Vector2<f64>)], index: usize, gap: f64) -> Vec<Vector2<f64>> {
    const MOST: usize = 6;
    let follows = |one: usize, other: usize| {
        let ((beam, position), (next, point)) = (hits[one], hits[other]);
        beam.abs_diff(next) <= 2 && (point - position).norm() < gap
    };
    let mut first = index;
    while first > index.saturating_sub(MOST) && follows(first, first - 1) {
        first -= 1;
    }
    let mut last = index;
    while last < (index + MOST).min(hits.len() - 1) && follows(last, last + 1) {
        last += 1;
    }
    hits[first..=last].iter().map(|hit| hit.1).collect()
}

/// A direction across the line through points, one of two, if they lie on a line, off by `straight` metres at most.
fn normal(points: &[Vector2<f64>], straight: f64) -> Option<Vector2<f64>> {
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
    let is_line =
        spread_across < 0.1 * spread_along && spread_across <= straight * straight * points.len() as f64;
    is_line.then(|| vector![-sin, cos])
}

/// What lies between neighboring surface points on one straight wall, so that beams that graze it leave no gaps.
pub(crate) fn filled(surfaces: &[SurfacePoint]) -> Vec<SurfacePoint> {
    let mut all = surfaces.to_vec();
    for pair in surfaces.windows(2) {
        let (Some(one), Some(other)) = (pair[0].normal, pair[1].normal) else { continue };
        let way = pair[1].position - pair[0].position;
        let length = way.norm();
        let is_wall =
            one.dot(&other) > PARALLEL && one.dot(&way).abs().max(other.dot(&way).abs()) < 2.0 * STRAIGHT;
        if is_wall && length < FILLING.1 {
            let steps = (length / FILLING.0).floor() as usize;
            all.extend((1..steps).map(|step| SurfacePoint {
                position: pair[0].position + way * (step as f64 / steps as f64),
                normal: Some(one),
            }));
        }
    }
    all
}

/// Where a point is, and its number.
type Placed = (Vector2<f64>, u32);

/// Surface points in one frame, in buckets.
#[derive(Clone, Default, Debug)]
pub(crate) struct Cloud {
    points: Vec<SurfacePoint>,
    /// For each bucket, the numbers of its points that have a normal, with where they are.
    buckets: FxHashMap<(i32, i32), Vec<Placed>>,
    /// The same for points without one: posts and trunks, which stand alone.
    posts: FxHashMap<(i32, i32), Vec<Placed>>,
}

impl Cloud {
    /// Adds the surfaces seen from a pose of this frame, except where there are points of the same side within `spacing`
    /// metres already.
    pub(crate) fn insert(&mut self, pose: Pose, surfaces: &[SurfacePoint], spacing: f64) {
        let rotation = pose.rotation();
        for surface in surfaces {
            let position = pose.translation() + rotation * surface.position;
            let normal = surface.normal.map(|normal| rotation * normal);
            if self.nearest(position, normal, spacing).is_some() {
                continue;
            }
            let buckets = if normal.is_some() { &mut self.buckets } else { &mut self.posts };
            buckets.entry(bucket(position)).or_default().push((position, self.points.len() as u32));
            self.points.push(SurfacePoint { position, normal });
        }
    }

    /// All points, in the order in which they were added.
    pub(crate) fn points(&self) -> &[SurfacePoint] {
        &self.points
    }

    /// The nearest point with a normal within `reach` metres, which is at most a bucket's side; of a surface that is seen from the same
    /// side as one of that normal, if there is one.
    pub(crate) fn nearest(
        &self,
        position: Vector2<f64>,
        facing: Option<Vector2<f64>>,
        reach: f64,
    ) -> Option<&SurfacePoint> {
        let is_seen_so = |normal: Vector2<f64>| facing.is_none_or(|own| own.dot(&normal) > 0.0);
        self.nearest_of(&self.buckets, position, reach, |point| point.normal.is_some_and(is_seen_so))
    }

    /// The nearest point without a normal within `reach` metres, which is at most a bucket's side.
    pub(crate) fn nearest_post(&self, position: Vector2<f64>, reach: f64) -> Option<&SurfacePoint> {
        self.nearest_of(&self.posts, position, reach, |_| true)
    }

    fn nearest_of(
        &self,
        buckets: &FxHashMap<(i32, i32), Vec<Placed>>,
        position: Vector2<f64>,
        reach: f64,
        counts: impl Fn(&SurfacePoint) -> bool,
    ) -> Option<&SurfacePoint> {
        let ((first_column, first_row), (last_column, last_row)) =
            (bucket(position.add_scalar(-reach)), bucket(position.add_scalar(reach)));
        let mut best = None;
        let mut least = reach * reach;
        for row in first_row..=last_row {
            for column in first_column..=last_column {
                for &(there, index) in buckets.get(&(column, row)).into_iter().flatten() {
                    let distance = (there - position).norm_squared();
                    if distance >= least {
                        continue;
                    }
                    let point = &self.points[index as usize];
                    if counts(point) {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel seen from both sides is two surfaces, as thin as it may be.
    #[test]
    fn what_is_seen_from_the_other_side_is_another_surface() {
        let panel: Vec<SurfacePoint> = (-10..=10)
            .map(|k| SurfacePoint {
                position: vector![2.0, 0.1 * f64::from(k)],
                normal: Some(vector![-1.0, 0.0]),
            })
            .collect();
        let mut cloud = Cloud::default();
        cloud.insert(Pose::IDENTITY, &panel, 0.08);
        let facing = |x: f64| cloud.nearest(vector![2.03, 0.0], Some(vector![x, 0.0]), 0.5);
        assert!(facing(-1.0).is_some() && facing(1.0).is_none());
        assert!(cloud.nearest(vector![2.03, 0.0], None, 0.5).is_some());
        // From behind it, 4 m ahead and turned around, the same panel, 3 cm thick.
        let behind: Vec<SurfacePoint> = panel
            .iter()
            .map(|one| SurfacePoint { position: one.position - vector![0.03, 0.0], ..*one })
            .collect();
        cloud.insert(Pose::new(4.0, 0.0, std::f64::consts::PI), &behind, 0.08);
        assert_eq!(cloud.points().len(), 2 * panel.len());
        // Again from there, nothing is new.
        cloud.insert(Pose::new(4.0, 0.0, std::f64::consts::PI), &behind, 0.08);
        assert_eq!(cloud.points().len(), 2 * panel.len());
    }

    #[test]
    fn surfaces_face_who_sees_them() {
        let scan = Scan::of_half_turn((0..181).map(|beam| 3.0 + f64::from(beam % 60) / 100.0).collect());
        let seen = surfaces(&scan, 10.0, 0.0);
        let facing = seen.iter().filter_map(|one| Some((one.normal?, one.position)));
        assert!(facing.clone().count() > 100);
        assert!(facing.into_iter().all(|(normal, position)| normal.dot(&position) <= 0.0));
    }
}
