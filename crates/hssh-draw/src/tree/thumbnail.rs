//! A map so small that a node of a search tree can be drawn as it: places as solid points.

use hssh_topology::{PlaceId, TopologicalMap};
use nalgebra::vector;

use crate::drawing::Drawing;
use crate::map::{Obstacles, Scene};
use crate::palette::Palette;
use crate::svg::{Canvas, Point, along};

/// The length of a link, in pixels.
const UNIT: f64 = 26.0;
const RADIUS: f64 = 3.6;
const LINE: f64 = 1.5;
/// How far marks reach beyond the middle of a place: the arrow, and pending gateways.
const REACH: f64 = 13.0;

/// A little map, not drawn yet.
pub(super) struct Thumbnail<'a> {
    map: &'a TopologicalMap,
    current: PlaceId,
    drawing: Drawing,
}

impl<'a> Thumbnail<'a> {
    pub(super) fn new(map: &'a TopologicalMap, current: PlaceId, drawing: Drawing) -> Self {
        Thumbnail { map, current, drawing }
    }

    fn scene(&self) -> Scene<'_> {
        let (map, drawing) = (self.map, &self.drawing);
        Scene {
            map,
            drawing,
            palette: Palette::of(map),
            unit: UNIT,
            stretch: 1.0,
            radius: RADIUS,
            line: LINE,
            origin: Point::zeros(),
        }
    }

    /// The corners of the box that it takes, around the origin of its drawing.
    fn corners(&self) -> (Point, Point) {
        let scene = self.scene();
        let reach = vector![REACH, REACH];
        let places = self.map.places().map(|place| scene.on_canvas(self.drawing.position(place)));
        let boxes = places.map(|at| (at - reach, at + reach));
        let cubics = self.map.links().flat_map(|(from, to)| scene.link(from, to));
        let links = cubics.flat_map(|cubic| along(&cubic, 8));
        let all = boxes.chain(links.map(|at| (at, at)));
        all.reduce(|(low, high), (other_low, other_high)| (low.inf(&other_low), high.sup(&other_high)))
            .unwrap_or((-reach, reach))
    }

    /// Width and height of that box.
    pub(super) fn size(&self) -> Point {
        let (low, high) = self.corners();
        high - low
    }

    /// Draws it with the middle of its box at `middle`.
    pub(super) fn draw(&self, canvas: &mut Canvas, middle: Point) {
        let (low, high) = self.corners();
        let scene = Scene { origin: middle - (low + high) / 2.0, ..self.scene() };
        scene.draw_links(canvas);
        for place in self.map.places() {
            for olp in self.map.olps_of(place).filter(|&olp| self.map.is_pending(olp)) {
                scene.draw_stub(canvas, olp);
            }
            let center = scene.on_canvas(self.drawing.position(place));
            canvas.circle(center, RADIUS, r##"fill="#111111""##);
        }
        if self.current.number() < self.map.place_count() {
            let center = scene.on_canvas(self.drawing.position(self.current));
            let distances = [0.3, 0.45, 0.6].map(|part| RADIUS + part * UNIT);
            let (direction, _) = Obstacles::of(&scene).clearest_direction(center, &distances, RADIUS);
            scene.draw_pointer(canvas, center, direction);
        }
    }
}
