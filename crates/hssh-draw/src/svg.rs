//! A small SVG writer: shapes in the order they are drawn, coordinates rounded, the frame found from what was drawn.

use std::fmt::Write;

use nalgebra::{Vector2, vector};

/// A position or a displacement in the plane. On a [`Canvas`]: pixels, x to the right, y down.
pub(crate) type Point = Vector2<f64>;

/// The four points of a cubic Bézier curve.
pub(crate) type Cubic = [Point; 4];

/// The unit vector in a direction (radians, counterclockwise from the x axis, y up).
pub(crate) fn toward(direction: f64) -> Point {
    vector![direction.cos(), direction.sin()]
}

/// Where a text stands relative to its position.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
}

/// The estimated width of a character of a sans-serif font, as a part of the font size.
const CHARACTER_WIDTH: f64 = 0.56;

/// How wide a text is drawn, in pixels, give or take a little: the fonts of the viewer are unknown.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * CHARACTER_WIDTH
}

/// A picture in the making.
#[derive(Default)]
pub(crate) struct Canvas {
    body: String,
    depth: usize,
    /// Lower and upper corner of all that was drawn.
    bounds: Option<(Point, Point)>,
}

impl Canvas {
    /// Makes the picture large enough for a disk.
    pub(crate) fn make_room(&mut self, center: Point, radius: f64) {
        let reach = vector![radius, radius];
        let (low, high) = self.bounds.unwrap_or((center, center));
        self.bounds = Some((low.inf(&(center - reach)), high.sup(&(center + reach))));
    }

    /// Lower and upper corner of all that was drawn; of nothing, twice the origin.
    pub(crate) fn bounds(&self) -> (Point, Point) {
        self.bounds.unwrap_or_default()
    }

    fn line_of_text(&mut self, text: &str) {
        let indent = 2 * (self.depth + 1);
        let _ = writeln!(self.body, "{:indent$}{text}", "");
    }

    /// Opens a group; `attributes` as they stand in the text.
    pub(crate) fn open(&mut self, attributes: &str) {
        self.line_of_text(&format!("<g {attributes}>"));
        self.depth += 1;
    }

    /// Closes the group opened last.
    pub(crate) fn close(&mut self) {
        self.depth -= 1;
        self.line_of_text("</g>");
    }

    pub(crate) fn line(&mut self, from: Point, to: Point, attributes: &str) {
        self.make_room(from, 1.0);
        self.make_room(to, 1.0);
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(number);
        self.line_of_text(&format!(r#"<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" {attributes}/>"#));
    }

    pub(crate) fn circle(&mut self, center: Point, radius: f64, attributes: &str) {
        self.make_room(center, radius);
        let [x, y, r] = [center.x, center.y, radius].map(number);
        self.line_of_text(&format!(r#"<circle cx="{x}" cy="{y}" r="{r}" {attributes}/>"#));
    }

    pub(crate) fn rectangle(&mut self, low: Point, high: Point, attributes: &str) {
        self.make_room(low, 0.0);
        self.make_room(high, 0.0);
        let [x, y, width, height] = [low.x, low.y, high.x - low.x, high.y - low.y].map(number);
        self.line_of_text(&format!(
            r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" {attributes}/>"#
        ));
    }

    pub(crate) fn polygon(&mut self, corners: &[Point], attributes: &str) {
        for &corner in corners {
            self.make_room(corner, 1.0);
        }
        let corners: Vec<String> =
            corners.iter().map(|corner| format!("{},{}", number(corner.x), number(corner.y))).collect();
        self.line_of_text(&format!(r#"<polygon points="{}" {attributes}/>"#, corners.join(" ")));
    }

    /// An area within rings, by the even-odd rule if the attributes say so.
    pub(crate) fn area(&mut self, rings: &[Vec<Point>], attributes: &str) {
        for &corner in rings.iter().flatten() {
            self.make_room(corner, 1.0);
        }
        let corner = |point: &Point| format!("{} {}", number(point.x), number(point.y));
        let ring = |ring: &Vec<Point>| format!("M{}Z", ring.iter().map(corner).collect::<Vec<_>>().join("L"));
        let path: String = rings.iter().map(ring).collect();
        self.line_of_text(&format!(r#"<path d="{path}" {attributes}/>"#));
    }

    /// Cubic Bézier curves, each beginning where the one before ends.
    pub(crate) fn curve(&mut self, cubics: &[Cubic], attributes: &str) {
        for point in cubics.iter().flat_map(|cubic| along(cubic, 12)) {
            self.make_room(point, 2.0);
        }
        let text = |point: Point| format!("{} {}", number(point.x), number(point.y));
        let mut path = cubics.first().map(|cubic| format!("M {}", text(cubic[0]))).unwrap_or_default();
        for &[_, first, second, end] in cubics {
            let _ = write!(path, " C {}, {}, {}", text(first), text(second), text(end));
        }
        self.line_of_text(&format!(r#"<path d="{path}" {attributes}/>"#));
    }

    /// A text whose vertical middle is at `at`; `size` in pixels.
    pub(crate) fn text(&mut self, at: Point, size: f64, anchor: Anchor, text: &str, attributes: &str) {
        let width = text_width(text, size);
        let (left, name) = match anchor {
            Anchor::Start => (0.0, "start"),
            Anchor::Middle => (-width / 2.0, "middle"),
        };
        self.make_room(at + vector![left, 0.0], size / 2.0);
        self.make_room(at + vector![left + width, 0.0], size / 2.0);
        // 0.35 em: half the height of capitals and digits. Viewers disagree about dominant-baseline.
        let [x, y, font] = [at.x, at.y + 0.35 * size, size].map(number);
        let text = escape(text);
        self.line_of_text(&format!(
            r#"<text x="{x}" y="{y}" font-size="{font}" text-anchor="{name}" {attributes}>{text}</text>"#
        ));
    }

    /// The whole document, with a margin (pixels) around what was drawn and a white ground under it.
    pub(crate) fn finish(&self, margin: f64, description: &str) -> String {
        let (low, high) = self.bounds();
        let [x, y] = [low.x - margin, low.y - margin].map(f64::floor);
        let [width, height] = [high.x + margin - x, high.y + margin - y].map(f64::ceil);
        let frame = [x, y, width, height].map(number);
        let [x, y, width, height] = &frame;
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}" width="{width}" height="{height}" "#,
                r#"font-family="Helvetica, Arial, 'DejaVu Sans', sans-serif" fill="none">"#,
                "\n  <title>{title}</title>\n",
                r##"  <rect x="{x}" y="{y}" width="{width}" height="{height}" fill="#ffffff"/>"##,
                "\n{body}</svg>\n"
            ),
            view = frame.join(" "),
            title = escape(description),
            body = self.body,
            x = x,
            y = y,
            width = width,
            height = height,
        )
    }
}

/// Points along a cubic Bézier curve, its ends included, `steps` of them apart in the parameter.
pub(crate) fn along(&[start, first, second, end]: &Cubic, steps: u32) -> impl Iterator<Item = Point> + use<> {
    (0..=steps).map(move |step| {
        let t = f64::from(step) / f64::from(steps);
        let s = 1.0 - t;
        start * (s * s * s) + first * (3.0 * s * s * t) + second * (3.0 * s * t * t) + end * (t * t * t)
    })
}

/// A number with at most two decimals, without trailing zeros, never `-0`.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A text as it may stand inside an XML element or a quoted attribute; control characters are dropped.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let texts: Vec<String> = [1.0, -0.001, 0.125, -2.5, 100.0, 3.999].map(number).to_vec();
        assert_eq!(texts, ["1", "0", "0.12", "-2.5", "100", "4"]);
    }

    #[test]
    fn markup_in_texts_stays_text() {
        assert_eq!(escape("<a & \"b\">\u{7}"), "&lt;a &amp; &quot;b&quot;&gt; ");
    }
}
