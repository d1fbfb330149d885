//! Where there is room: for the arrow to the current place, for star names and those of regions.

use std::f64::consts::{FRAC_PI_4, TAU};

use nalgebra::vector;

use super::marks::{CLOSED_LENGTH, PENDING_LENGTH, Scene};
use crate::interior::roomiest;
use crate::svg::{Point, along};

/// How many directions around a place are tried.
const DIRECTIONS: u32 = 48;
/// How many points of a link keep labels away.
const SAMPLES: u32 = 16;

/// Everything that labels should stay away from, as points with a radius (pixels).
pub(crate) struct Obstacles(Vec<(Point, f64)>);

impl Obstacles {
    /// What is drawn of a map without labels.
    pub(crate) fn of(scene: &Scene) -> Self {
        let map = scene.map;
        let mut obstacles: Vec<(Point, f64)> = map
            .places()
            .map(|place| (scene.on_canvas(scene.drawing.position(place)), scene.radius))
            .collect();
        for (from, to) in map.links() {
            let points = scene.link(from, to);
            let points = points.iter().flat_map(|cubic| along(cubic, SAMPLES));
            obstacles.extend(points.map(|point| (point, scene.line / 2.0)));
        }
        for olp in map.places().flat_map(|place| map.olps_of(place)) {
            let reach = match (map.is_pending(olp), map.linked(olp)) {
                (true, _) => PENDING_LENGTH * scene.unit,
                (false, None) => CLOSED_LENGTH * scene.line,
                (false, Some(_)) => continue,
            };
            for part in [0.25, 0.5, 0.75, 1.0] {
                obstacles.push((scene.along_end(olp, scene.radius + part * reach), 1.5 * scene.line));
            }
        }
        Obstacles(obstacles)
    }

    /// Keeps later labels away from here.
    pub(crate) fn add(&mut self, point: Point, radius: f64) {
        self.0.push((point, radius));
    }

    /// Where within rings there is most room for a label.
    pub(super) fn roomiest(&self, rings: &[Vec<Point>]) -> Option<Point> {
        roomiest(rings, &self.0)
    }

    /// The direction around `center` in which a label that covers the points at these distances
    /// (pixels) has most room, and how much: less than nothing if it covers something. `own_radius` is that of the place itself,
    /// which is no obstacle.
    pub(crate) fn clearest_direction(
        &self,
        center: Point,
        distances: &[f64],
        own_radius: f64,
    ) -> (Point, f64) {
        let reach = distances.iter().copied().fold(0.0, f64::max) * 2.5;
        let near: Vec<(Point, f64)> = self
            .0
            .iter()
            .copied()
            .filter(|(point, radius)| {
                let distance = (point - center).norm();
                distance < reach + radius && !(distance < 1e-6 && *radius <= own_radius)
            })
            .collect();
        let mut best = (vector![1.0, 0.0], f64::NEG_INFINITY);
        for step in 0..DIRECTIONS {
            // From the upper right on, clockwise; on the canvas y points down.
            let angle = -FRAC_PI_4 + TAU * f64::from(step) / f64::from(DIRECTIONS);
            let direction = vector![angle.cos(), angle.sin()];
            let room = |distance: f64| {
                let point = center + direction * distance;
                near.iter().map(|(other, radius)| (other - point).norm() - radius).fold(reach, f64::min)
            };
            let room = distances.iter().map(|&distance| room(distance)).fold(reach, f64::min);
            if room > best.1 + 1e-6 {
                best = (direction, room);
            }
        }
        best
    }
}
