//! Thin lines that are parts of circles, in a raster.
//!
//! Each arc of a right angle runs along a diagonal somewhere, and what else is drawn hardly does: these are the cells that circles
//! are tried at. What a circle goes through is then fitted by least squares.

use std::f64::consts::{FRAC_PI_4, PI};
use std::ops::RangeInclusive;

use super::raster::{Raster, Vector, length, minus, plus, point, toward};
use crate::grid::{Cell, Lattice};

/// So far a line runs along a diagonal, in metres, to at least one side of where a circle is tried.
const RUN: f64 = 0.25;
/// Within it is nothing for so many metres, and without for so many.
const INNER: f64 = 0.4;
const OUTER: f64 = 0.2;
/// From one direction to the center to the next that is tried, in radians, and how many to either side of the diagonal.
const TURN: f64 = PI / 30.0;
const TURNS: i32 = 2;
/// From one radius that is tried to the next, in cells.
const RADII: f64 = 1.0;
/// From one point of an arc to the next, in cells.
const STEP: f64 = 1.0;
/// So many cells off the circle is a point still on it, ...
const OFF: [f64; 3] = [0.0, 1.0, -1.0];
/// ... and so many in a row may be missing.
const MISSING: u32 = 2;
/// Of an arc at least this part is drawn.
const DRAWN: f64 = 0.6;
/// So many of the circles that most is drawn of are fitted, ...
const TRIED: usize = 4;
/// ... each so many times.
const FITS: usize = 3;
/// Without this part of it at each end, where other lines touch it, an arc is fitted.
const ENDS: f64 = 0.12;
/// An arc is no longer than this, in radians, to either side of where it was found.
const LONGEST: f64 = 0.6 * PI;
/// So many points of a circle are looked at first, the one in the middle being where it is tried, ...
const PROBES: usize = 11;
/// ... so many radians from one another; ...
const PROBE: f64 = 0.05 * PI;
/// ... of those to both sides, ...
const LATER: [usize; 5] = [6, 7, 8, 9, 10];
const EARLIER: [usize; 5] = [4, 3, 2, 1, 0];
/// ... so many in a row are drawn.
const PROMISING: usize = 4;
/// An arc is at least this long, in radians.
const SHORTEST: f64 = 0.28 * PI;

/// A thin line along a circle; lengths in cells, angles in radians, counterclockwise from the one to the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) center: Vector,
    pub(super) radius: f64,
    pub(super) from: f64,
    pub(super) to: f64,
    /// How many cells of it are drawn; those that are off by one count half.
    pub(super) drawn: f64,
}

impl Arc {
    pub(super) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// The point of it at an angle.
    pub(super) fn at(&self, angle: f64) -> Vector {
        plus(self.center, toward(angle), self.radius)
    }

    /// The middle of the line that crosses its radius at an angle, if it is no thicker than that.
    pub(super) fn middle<F: Fn(usize) -> bool>(
        &self,
        angle: f64,
        raster: &Raster<F>,
        thickness: f64,
    ) -> Option<Vector> {
        let ahead = toward(angle);
        let is_at = |radius: f64| raster.is_at(plus(self.center, ahead, radius));
        let start = [0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5]
            .into_iter()
            .map(|off| self.radius + off)
            .find(|&radius| is_at(radius))?;
        let end = |sign: f64| {
            let steps = (0..=(4.0 * thickness) as i32).map(|step| start + sign * f64::from(step) / 4.0);
            steps.take_while(|&radius| is_at(radius)).last().unwrap_or(start)
        };
        let (inner, outer) = (end(-1.0), end(1.0));
        (outer - inner <= thickness).then(|| plus(self.center, ahead, (inner + outer) / 2.0))
    }

    /// The angles of points a cell apart, without a part of it at each end.
    fn angles(&self, ends: f64) -> impl Iterator<Item = f64> + use<> {
        let (first, step) = (self.from + ends * self.length(), STEP / self.radius);
        let count = ((1.0 - 2.0 * ends) * self.length() / step) as u32;
        (0..=count).map(move |number| first + f64::from(number) * step)
    }
}

/// All arcs of a raster with these radii, which are drawn no thicker than that, in cells; those first of which most is drawn, and often
/// several for one line.
pub(super) fn arcs<F: Fn(usize) -> bool>(
    raster: &Raster<F>,
    radii: RangeInclusive<f64>,
    thickness: f64,
) -> Vec<Arc> {
    let finder = Finder { raster, radii, thickness };
    let circles = [1, 3, 5, 7].map(|eighth| finder.circles(f64::from(eighth) * FRAC_PI_4));
    let mut arcs: Vec<Arc> =
        finder.seeds().filter_map(|(cell, side)| finder.arc_through(cell, &circles[side])).collect();
    arcs.sort_by(|one, other| other.drawn.total_cmp(&one.drawn));
    arcs
}

/// A circle that is tried at a cell: its center as seen from there, where the cell lies on it, and the steps by index to points of it,
/// and to those that are off by a cell.
struct Circle {
    center: Vector,
    radius: f64,
    angle: f64,
    probes: [[isize; OFF.len()]; PROBES],
}

struct Finder<'a, F> {
    raster: &'a Raster<F>,
    radii: RangeInclusive<f64>,
    thickness: f64,
}

impl<F: Fn(usize) -> bool> Finder<'_, F> {
    /// The cells at the outer side of thin lines that run along a diagonal, each with the number of the diagonal that it is the outer side at.
    fn seeds(&self) -> impl Iterator<Item = (Cell, usize)> {
        let lattice: Lattice = self.raster.lattice;
        let (width, height) = (lattice.width() as usize, lattice.height() as usize);
        let [run, within, without] = [RUN, INNER, OUTER]
            .map(|metres| (self.raster.cells(metres) / 2.0_f64.sqrt()).round().max(2.0) as isize);
        let frame = self.thickness.ceil() as usize + 3 + within as usize;
        let rows = frame..height.saturating_sub(frame);
        let inner =
            rows.flat_map(move |row| row * width + frame..(row * width + width.saturating_sub(frame)));
        let is_at = move |index: usize| (self.raster.is_obstacle)(index);
        let obstacles = inner.filter(move |&index| is_at(index) && !(is_at(index - 1) && is_at(index + 1)));
        let is_outer_side = move |index: usize, columns: isize, rows: isize| {
            let step = |columns: isize, rows: isize| {
                is_at(index.wrapping_add_signed(rows * width as isize + columns))
            };
            let inward = |cells: isize| step(-cells * columns, -cells * rows);
            let behind = (self.thickness / 2.0_f64.sqrt()).ceil() as isize + 1;
            // The line turns inward as it goes on, by no more than a cell.
            let goes_on = |sign: isize| {
                (1..=run).all(|cells| {
                    let (along, across) = (sign * cells * columns, -sign * cells * rows);
                    step(along, across) || step(along - columns, across) || step(along, across - rows)
                })
            };
            !step(columns, rows)
                && !step(columns, 0)
                && !step(0, rows)
                && (step(columns, -rows) || step(-columns, rows))
                && (goes_on(1) || goes_on(-1))
                && (1..=behind).any(|cells| !inward(cells))
                && (behind..=within).all(|cells| !inward(cells))
                && (2..=without).all(|cells| !inward(-cells))
        };
        let diagonals = [(1, 1), (-1, 1), (-1, -1), (1, -1)];
        obstacles.flat_map(move |index| {
            let sides =
                (0..).zip(diagonals).filter(move |&(_, (columns, rows))| is_outer_side(index, columns, rows));
            sides.map(move |(side, _)| (lattice.cell(index), side))
        })
    }

    /// The circles that are tried at a cell of which the center lies about opposite to a direction.
    fn circles(&self, outward: f64) -> Vec<Circle> {
        let width = self.raster.lattice.width() as isize;
        let radii = ((self.radii.end() - self.radii.start()) / RADII).ceil() as u32;
        let turns = (-TURNS..=TURNS).flat_map(|turn| (0..=radii).map(move |step| (turn, step)));
        let circle = |(turn, step): (i32, u32)| {
            let angle = outward + f64::from(turn) * TURN;
            let radius = self.radii.start() + f64::from(step) * RADII;
            let center = toward(angle).map(|axis| -radius * axis);
            let probe = |number: usize| {
                let ahead = toward(angle + (number as f64 - PROBES as f64 / 2.0 + 0.5) * PROBE);
                OFF.map(|off| {
                    let [columns, rows] = plus(center, ahead, radius + off).map(|axis| axis.round() as isize);
                    rows * width + columns
                })
            };
            Circle { center, radius, angle, probes: std::array::from_fn(probe) }
        };
        turns.map(circle).collect()
    }

    /// Whether so much of a circle at a cell may be drawn that it is worth a closer look.
    fn is_promising(&self, circle: &Circle, cell: Cell) -> bool {
        let reach = 2 * (*self.radii.end() as u32 + 2);
        let is_inner = |at: u32, cells: u32| at >= reach && at + reach < cells;
        if !is_inner(cell.column, self.raster.lattice.width())
            || !is_inner(cell.row, self.raster.lattice.height())
        {
            return true;
        }
        let index = self.raster.lattice.index(cell);
        let is_on = |&&number: &&usize| {
            circle.probes[number]
                .iter()
                .any(|&step| (self.raster.is_obstacle)(index.wrapping_add_signed(step)))
        };
        let run = |numbers: &[usize]| numbers.iter().take_while(is_on).count();
        run(&LATER) + run(&EARLIER) >= PROMISING
    }

    /// The longest arc through a cell along one of some circles.
    fn arc_through(&self, cell: Cell, circles: &[Circle]) -> Option<Arc> {
        let promising = circles.iter().filter(|circle| self.is_promising(circle, cell));
        let arcs = promising
            .map(|circle| self.along(plus(point(cell), circle.center, 1.0), circle.radius, circle.angle));
        let is_long = |arc: &Arc| arc.length() >= SHORTEST;
        let is_drawn = |arc: &Arc| arc.drawn >= DRAWN * arc.length() * arc.radius / STEP;
        let counted = |arc| self.counted(arc);
        let mut arcs: Vec<Arc> = arcs.filter(is_long).map(counted).filter(is_drawn).collect();
        arcs.sort_by(|one, other| other.drawn.total_cmp(&one.drawn));
        let fitted = arcs.iter().take(TRIED).filter_map(|arc| self.fitted(arc));
        let fitted = fitted.filter(|arc| is_long(arc) && self.radii.contains(&arc.radius));
        fitted.max_by(|one, other| one.drawn.total_cmp(&other.drawn))
    }

    /// An arc with how many cells of it are drawn.
    fn counted(&self, arc: Arc) -> Arc {
        let is_at =
            |angle: f64, off: f64| self.raster.is_at(plus(arc.center, toward(angle), arc.radius + off));
        let drawn = |angle: f64| match () {
            () if is_at(angle, 0.0) => 1.0,
            () if is_at(angle, 1.0) || is_at(angle, -1.0) => 0.5,
            () => -1.0,
        };
        Arc { drawn: arc.angles(0.0).map(drawn).sum(), ..arc }
    }

    /// What is drawn along a circle to both sides of an angle; its cells are not counted yet.
    fn along(&self, center: Vector, radius: f64, angle: f64) -> Arc {
        let step = STEP / radius;
        let end = |sign: f64| {
            let (mut last, mut missing) = (angle, 0);
            let mut turned = 0.0;
            while turned < LONGEST && missing <= MISSING {
                turned += step;
                let here = angle + sign * turned;
                if self.is_line(center, radius, here) {
                    (last, missing) = (here, 0);
                } else {
                    missing += 1;
                }
            }
            last
        };
        Arc { center, radius, from: end(-1.0), to: end(1.0), drawn: 0.0 }
    }

    /// Whether a thin line crosses the radius at an angle, with nothing within it.
    fn is_line(&self, center: Vector, radius: f64, angle: f64) -> bool {
        let ahead = toward(angle);
        let is_at = |radius: f64| self.raster.is_at(plus(center, ahead, radius));
        OFF.into_iter().any(|off| is_at(radius + off)) && !is_at(radius - self.thickness.max(2.0))
    }

    /// The arc along the circle that fits best to what is drawn along another.
    fn fitted(&self, arc: &Arc) -> Option<Arc> {
        let mut best = *arc;
        for _ in 0..FITS {
            let points: Vec<Vector> = best
                .angles(ENDS)
                .filter_map(|angle| best.middle(angle, self.raster, self.thickness))
                .collect();
            let (center, radius) = circle(&points)?;
            let [x, y] = minus(best.at((best.from + best.to) / 2.0), center);
            best = self.along(center, radius, y.atan2(x));
        }
        Some(self.counted(best))
    }
}

/// The circle of least squares, by what the squares of the distances miss (Kåsa 1976).
fn circle(points: &[Vector]) -> Option<(Vector, f64)> {
    let count = points.len() as f64;
    let mean = points.iter().fold([0.0; 2], |sum, &at| plus(sum, at, 1.0 / count));
    let (mut matrix, mut right) = (nalgebra::Matrix3::zeros(), nalgebra::Vector3::zeros());
    for &at in points {
        let [x, y] = minus(at, mean);
        let row = nalgebra::Vector3::new(2.0 * x, 2.0 * y, 1.0);
        matrix += row * row.transpose();
        right += row * (x * x + y * y);
    }
    let solved = nalgebra::Cholesky::new(matrix)?.solve(&right);
    let center = [solved[0], solved[1]];
    Some((plus(center, mean, 1.0), (solved[2] + length(center).powi(2)).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_found_by_its_points() {
        let points: Vec<Vector> =
            (0..9).map(|step| plus([3.0, -2.0], toward(f64::from(step) / 5.0), 7.0)).collect();
        let (center, radius) = circle(&points).unwrap();
        assert!(length(minus(center, [3.0, -2.0])) < 1e-9 && (radius - 7.0).abs() < 1e-9);
        assert!(circle(&points[..2]).is_none());
    }
}
