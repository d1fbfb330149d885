//! The SVG figure of one map: places, gateways, links by path, the current place, title and measure.

use hssh_topology::{PlaceId, TopologicalMap};
use nalgebra::vector;

use super::building::{draw_building, draw_names};
use super::clearance::Obstacles;
use super::marks::Scene;
use super::{MapOptions, measure_line};
use crate::drawing::Drawing;
use crate::palette::Palette;
use crate::svg::{Anchor, Canvas, Point, text_width};

/// The length of a typical link, in pixels; everything else is in proportion.
const UNIT: f64 = 92.0;
const RADIUS: f64 = 15.0;
const LINE: f64 = 3.6;
const MARGIN: f64 = 18.0;
/// The size of star names, in pixels.
const NAME_SIZE: f64 = 11.0;

/// A map as an SVG document.
///
/// Places are numbered circles with their ends in the star's clockwise order: dots are linked gateways,
/// arrows with a hollow tip pending ones, blunt bars closed ends. Links have the color of their path;
/// what belongs to a path with a single place is gray. Around a place, if its covariance is known, the ellipse that
/// holds it with a probability of 95 %. `drawing` must have been made for `map`.
///
/// # Panics
/// If the drawing is of another map, with fewer places.
#[must_use]
pub fn draw_map(map: &TopologicalMap, drawing: &Drawing, options: &MapOptions) -> String {
    let (palette, origin) = (Palette::of(map), Point::zeros());
    let stretch = options.building.as_ref().map_or(1.0, |building| building.stretch(drawing.unit() / UNIT));
    let scene = Scene { map, drawing, palette, unit: UNIT, stretch, radius: RADIUS, line: LINE, origin };
    let mut canvas = Canvas::default();
    let mut obstacles = Obstacles::of(&scene);

    if let Some(building) = &options.building {
        draw_building(&mut canvas, &scene, building);
    }
    canvas.open(r#"class="links""#);
    scene.draw_links(&mut canvas);
    canvas.close();
    for place in map.places() {
        draw_place(&mut canvas, &scene, place, options);
    }
    draw_ellipses(&mut canvas, &scene);
    if let Some(place) = options.current.filter(|&place| place.number() < map.place_count()) {
        let center = scene.on_canvas(drawing.position(place));
        let distances = [0.1, 0.2, 0.34].map(|part| RADIUS + part * UNIT);
        let (direction, _) = obstacles.clearest_direction(center, &distances, RADIUS);
        canvas.open(r#"class="current""#);
        scene.draw_pointer(&mut canvas, center, direction);
        canvas.close();
        for distance in distances {
            obstacles.add(center + direction * distance, 0.07 * UNIT);
        }
    }
    for place in map.places() {
        if let Some(name) = options.star_name(map.star(place)) {
            draw_star_name(&mut canvas, &scene, place, name, &mut obstacles);
        }
    }
    if let Some(building) = &options.building {
        draw_names(&mut canvas, &scene, building, &mut obstacles);
    }
    draw_lines_of_text(&mut canvas, map, options);
    canvas.finish(MARGIN, options.title.as_deref().unwrap_or("Topological map"))
}

/// How sure the places' positions are.
fn draw_ellipses(canvas: &mut Canvas, scene: &Scene) {
    let ellipses: Vec<Vec<Point>> =
        scene.map.places().filter_map(|place| scene.drawing.ellipse(place)).collect();
    if ellipses.is_empty() {
        return;
    }
    canvas.open(r#"class="covariance""#);
    for corners in ellipses {
        let corners: Vec<Point> = corners.into_iter().map(|corner| scene.on_canvas(corner)).collect();
        canvas.polygon(&corners, r##"fill="#4a7ab5" fill-opacity="0.12" stroke="#4a7ab5" stroke-width="1""##);
    }
    canvas.close();
}

fn draw_place(canvas: &mut Canvas, scene: &Scene, place: PlaceId, options: &MapOptions) {
    let center = scene.on_canvas(scene.drawing.position(place));
    let fill = if options.current == Some(place) { "#ffe08a" } else { "#ffffff" };
    canvas.open(&format!(r#"class="place" data-place="{place}""#));
    canvas.circle(center, scene.radius, &format!(r##"fill="{fill}" stroke="#222222" stroke-width="1.6""##));
    for olp in scene.map.olps_of(place) {
        canvas.open(&format!(r#"class="end" data-end="{}""#, scene.map.local(olp)));
        scene.draw_end(canvas, olp);
        canvas.close();
    }
    let number = place.to_string();
    let size = if number.len() < 3 { 14.0 } else { 11.0 };
    canvas.text(center, size, Anchor::Middle, &number, r##"fill="#111111""##);
    canvas.close();
}

/// Writes the name of a place's star where there is most room beside the place, if there is any.
fn draw_star_name(canvas: &mut Canvas, scene: &Scene, place: PlaceId, name: &str, obstacles: &mut Obstacles) {
    let center = scene.on_canvas(scene.drawing.position(place));
    let half_width = text_width(name, NAME_SIZE) / 2.0;
    let distance = scene.radius + 4.0 + NAME_SIZE / 2.0;
    let (direction, room) =
        obstacles.clearest_direction(center, &[distance, distance + half_width], scene.radius);
    // What would hide something else helps nobody.
    if room < 0.0 {
        return;
    }
    // The text box touches the circle around the place: it is wider than high.
    let out = distance + (half_width - NAME_SIZE / 2.0).max(0.0) * direction.x.abs();
    let middle = center + direction * out;
    canvas.text(
        middle,
        NAME_SIZE,
        Anchor::Middle,
        name,
        r##"class="star" fill="#444444" font-style="italic" stroke="#ffffff" stroke-width="3" paint-order="stroke""##,
    );
    for part in [-0.7, 0.0, 0.7] {
        obstacles.add(middle + vector![part * half_width, 0.0], NAME_SIZE / 2.0);
    }
}

/// The title above the picture and the measure below it, in a size that goes with the picture's.
fn draw_lines_of_text(canvas: &mut Canvas, map: &TopologicalMap, options: &MapOptions) {
    let (low, high) = canvas.bounds();
    let (low, high) = (low.map(f64::round), high.map(f64::round));
    let size = ((high.x - low.x) / 48.0).clamp(11.5, 40.0);
    let middle = (low.x + high.x) / 2.0;
    if let Some(title) = &options.title {
        let size = 1.3 * size;
        let at = vector![middle, low.y - 1.4 * size];
        canvas.text(at, size, Anchor::Middle, title, r##"class="title" fill="#111111" font-weight="bold""##);
    }
    if options.measure {
        let line = measure_line(map);
        // In a narrow picture the line goes on two lines, in a very narrow one on more.
        let widest = (high.x - low.x).max(26.0 * size);
        for (row, text) in wrapped(&line, widest, size).iter().enumerate() {
            let at = vector![middle, high.y + (1.8 + 1.5 * row as f64) * size];
            canvas.text(
                at,
                size,
                Anchor::Middle,
                text,
                r##"class="measure" fill="#333333" xml:space="preserve""##,
            );
        }
    }
}

/// The parts of a line between its separators, as many in a row as fit into that width.
fn wrapped(line: &str, width: f64, size: f64) -> Vec<String> {
    const SEPARATOR: &str = "  ·  ";
    let mut rows: Vec<String> = Vec::new();
    for part in line.split(SEPARATOR) {
        match rows.last_mut() {
            Some(row)
                if text_width(row, size) + text_width(SEPARATOR, size) + text_width(part, size) <= width =>
            {
                row.push_str(SEPARATOR);
                row.push_str(part);
            }
            _ => rows.push(part.to_owned()),
        }
    }
    rows
}
