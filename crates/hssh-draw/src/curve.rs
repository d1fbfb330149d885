//! Links as smooth curves that leave and enter each place in the direction of the end, so that the drawn
//! circular order is the star's.

use hssh_topology::MapOlp;

use crate::drawing::Drawing;
use crate::svg::{Cubic, Point, toward};

/// An end that looks farther away from the other end of its link than that (0: straight at it, 2: straight
/// away) makes the link go around its own place.
const LOOKS_AWAY: f64 = 1.4;
/// How far from the circle of the place it does so, in units of a link.
const DETOUR: f64 = 0.2;

/// A link that follows a line leaves it in favor of the direction of its end that near to a place, in radii of the place.
const APPROACH: f64 = 1.8;

/// A point that a curve passes, and its direction there (a unit vector).
#[derive(Clone, Copy)]
struct Waypoint {
    at: Point,
    heading: Point,
}

/// The link between two gateways as Bézier curves, in units of the drawing, from and to the circles of that
/// radius around the two places: along its line, if the drawing has one.
pub(crate) fn link_curve(drawing: &Drawing, from: MapOlp, to: MapOlp, radius: f64) -> Vec<Cubic> {
    let (leaving, entering) = (toward(drawing.direction(from)), toward(drawing.direction(to)));
    let (here, there) = (drawing.position_of_end(from), drawing.position_of_end(to));
    let (start, end) = (here + radius * leaving, there + radius * entering);
    let chord = (end - start).try_normalize(1e-9).unwrap_or(leaving);
    let side = Point::new(-chord.y, chord.x);
    let beside = |place: Point, lean: f64| {
        let side = if lean < 0.0 { -side } else { side };
        Waypoint { at: place + side * (radius + DETOUR * drawing.unit()), heading: chord }
    };

    if let Some(line) = drawing.way(from) {
        let is_beyond =
            |point: &Point| [here, there].iter().all(|place| (point - place).norm() > APPROACH * radius);
        let points: Vec<Point> =
            [start].into_iter().chain(line.iter().copied().filter(is_beyond)).chain([end]).collect();
        return along_points(&points, leaving, -entering, drawing.unit());
    }

    let mut way = vec![Waypoint { at: start, heading: leaving }];
    if 1.0 - leaving.dot(&chord) > LOOKS_AWAY {
        way.push(beside(here, leaving.dot(&side)));
    }
    if 1.0 + entering.dot(&chord) > LOOKS_AWAY && (way.len() == 1 || here != there) {
        way.push(beside(there, entering.dot(&side)));
    }
    way.push(Waypoint { at: end, heading: -entering });
    way.windows(2).map(|pair| cubic(pair[0], pair[1], drawing.unit())).collect()
}

/// A smooth curve through points, the first and the last passed with those headings.
fn along_points(points: &[Point], leaving: Point, arriving: Point, unit: f64) -> Vec<Cubic> {
    let ahead = |pair: &[Point]| (pair[1] - pair[0]).try_normalize(1e-9);
    let headings: Vec<Option<Point>> = points.windows(2).map(ahead).collect();
    let mut way = vec![Waypoint { at: points[0], heading: leaving }];
    for (corner, sides) in points[1..].iter().zip(headings.windows(2)) {
        // Halfway between the directions before and behind.
        let sum = sides.iter().flatten().sum::<Point>();
        let Some(heading) = sum.try_normalize(1e-9).or(sides[0]) else { continue };
        way.push(Waypoint { at: *corner, heading });
    }
    way.push(Waypoint { at: points[points.len() - 1], heading: arriving });
    way.windows(2).map(|pair| cubic(pair[0], pair[1], unit)).collect()
}

/// The curve between two points: straight if both look at each other, rounder the more they look away.
fn cubic(start: Waypoint, end: Waypoint, unit: f64) -> Cubic {
    let gap = end.at - start.at;
    let chord = gap.try_normalize(1e-9).unwrap_or(start.heading);
    let handle =
        |heading: Point| gap.norm() / 3.0 + 0.22 * unit.min(2.0 * gap.norm()) * (1.0 - heading.dot(&chord));
    let first = start.at + start.heading * handle(start.heading);
    let last = end.at - end.heading * handle(end.heading);
    [start.at, first, last, end.at]
}
