//! The marks that a map is drawn with, in pixels: what a gateway, a closed end and a link look like.

use hssh_topology::{MapOlp, TopologicalMap};
use nalgebra::vector;

use crate::curve::link_curve;
use crate::drawing::Drawing;
use crate::palette::{Palette, PathStyle};
use crate::svg::{Canvas, Cubic, Point, number};

/// A map with its drawing at a scale.
pub(crate) struct Scene<'a> {
    pub(crate) map: &'a TopologicalMap,
    pub(crate) drawing: &'a Drawing,
    pub(crate) palette: Palette,
    /// The length of a typical link, in pixels.
    pub(crate) unit: f64,
    /// By how much places are farther apart than that, so that there is room for a building.
    pub(crate) stretch: f64,
    /// The radius of a place, in pixels.
    pub(crate) radius: f64,
    /// The width of a link, in pixels.
    pub(crate) line: f64,
    /// Where the origin of the drawing comes to lie.
    pub(crate) origin: Point,
}

/// How long a pending gateway is drawn, in units of a link.
pub(super) const PENDING_LENGTH: f64 = 0.3;
/// How long a closed end is drawn, in widths of a line.
pub(super) const CLOSED_LENGTH: f64 = 1.9;

impl Scene<'_> {
    /// Drawing to canvas: scaled, and y down.
    pub(crate) fn on_canvas(&self, point: Point) -> Point {
        let scale = self.stretch * self.unit / self.drawing.unit();
        self.origin + vector![point.x * scale, -point.y * scale]
    }

    /// The point at a distance (pixels) from the middle of an end's place in the direction of the end.
    pub(crate) fn along_end(&self, olp: MapOlp, distance: f64) -> Point {
        let center = self.on_canvas(self.drawing.position_of_end(olp));
        center + distance * self.end_direction(olp)
    }

    /// The direction of an end on the canvas.
    fn end_direction(&self, olp: MapOlp) -> Point {
        let direction = self.drawing.direction(olp);
        vector![direction.cos(), -direction.sin()]
    }

    /// A link on the canvas.
    pub(crate) fn link(&self, from: MapOlp, to: MapOlp) -> Vec<Cubic> {
        let radius = self.radius / (self.stretch * self.unit) * self.drawing.unit();
        let cubics = link_curve(self.drawing, from, to, radius);
        cubics.into_iter().map(|cubic| cubic.map(|point| self.on_canvas(point))).collect()
    }

    /// All links, each on a white border so that crossings read as over and under.
    pub(crate) fn draw_links(&self, canvas: &mut Canvas) {
        for (from, to) in self.map.links() {
            let cubics = self.link(from, to);
            let style = self.palette.style(self.map.path(from));
            let border = number(self.line * 2.6);
            canvas.curve(&cubics, &format!(r##"stroke="#ffffff" stroke-width="{border}""##));
            canvas.curve(&cubics, &stroke(style, self.line));
        }
    }

    /// An end of a star at the circle of its place: a dot for a linked gateway, an arrow into the open for
    /// a pending one, a blunt bar for a closed end.
    pub(crate) fn draw_end(&self, canvas: &mut Canvas, olp: MapOlp) {
        let style = PathStyle { dashes: &[], ..self.palette.style(self.map.path(olp)) };
        let direction = self.end_direction(olp);
        let side = vector![-direction.y, direction.x];
        let start = self.along_end(olp, self.radius);
        if self.map.is_pending(olp) {
            let tip = self.along_end(olp, self.radius + PENDING_LENGTH * self.unit);
            let (length, half_width) = (3.6 * self.line, 1.5 * self.line);
            let base = tip - direction * length;
            canvas.line(start, base, &stroke(style, self.line));
            let width = number(self.line * 0.5);
            let attributes = format!(
                r##"fill="#ffffff" stroke="{}" stroke-width="{width}" stroke-linejoin="round""##,
                style.color
            );
            canvas.polygon(&[tip, base + side * half_width, base - side * half_width], &attributes);
        } else if self.map.dart(olp).is_none() {
            let end = self.along_end(olp, self.radius + CLOSED_LENGTH * self.line);
            canvas.line(start, end, &stroke(style, 0.8 * self.line));
            let bar = side * (1.6 * self.line);
            canvas.line(end - bar, end + bar, &stroke(style, 0.8 * self.line));
            return;
        }
        let attributes = format!(r##"fill="{}" stroke="#ffffff" stroke-width="0.8""##, style.color);
        canvas.circle(start, 0.85 * self.line, &attributes);
    }

    /// A pending gateway in a map too small for arrows: a short line into the open.
    pub(crate) fn draw_stub(&self, canvas: &mut Canvas, olp: MapOlp) {
        let style = PathStyle { dashes: &[], ..self.palette.style(self.map.path(olp)) };
        let tip = self.along_end(olp, self.radius + PENDING_LENGTH * self.unit);
        canvas.line(self.along_end(olp, 0.0), tip, &stroke(style, 0.8 * self.line));
    }

    /// The little closed-headed arrow of Figure 2.5: its tip at the circle of the place at `center`,
    /// coming from `direction`.
    pub(crate) fn draw_pointer(&self, canvas: &mut Canvas, center: Point, direction: Point) {
        let (tip, tail) = (self.radius + 0.4 * self.line, self.radius + 0.34 * self.unit);
        let head = (0.15 * self.unit).max(3.0 * self.line);
        let side = vector![-direction.y, direction.x] * (0.45 * head);
        let at = |distance: f64| center + direction * distance;
        let width = number(0.6 * self.line);
        canvas.line(at(tip + head), at(tail), &format!(r##"stroke="#111111" stroke-width="{width}""##));
        canvas.polygon(&[at(tip), at(tip + head) + side, at(tip + head) - side], r##"fill="#111111""##);
    }
}

/// How a line is drawn.
fn stroke(style: PathStyle, width: f64) -> String {
    let color = style.color;
    let dashes: Vec<String> = style.dashes.iter().map(|dash| number(dash * width)).collect();
    let dashes = match dashes.as_slice() {
        [] => String::new(),
        dashes => format!(r#" stroke-dasharray="{}""#, dashes.join(" ")),
    };
    format!(r#"stroke="{color}" stroke-width="{}"{dashes}"#, number(width))
}
