//! Leaves of doors that stand open: thin bars that hang on a jamb beside an opening that they would close, one alone or two
//! together. They part no rooms, and where they hang is a door.

use std::f64::consts::TAU;

use rustc_hash::FxHashSet;

use super::options::LeafOptions;
use super::raster::{Raster, Vector, length, minus, plus, point, unit};
use crate::grid::{Cell, Lattice};

/// So many directions from a hinge are tried for an opening.
const DIRECTIONS: u32 = 72;
/// The hinge lies up to so many metres within the jamb, and this is where it is looked for.
const DEPTHS: [f64; 3] = [0.0, 0.05, 0.1];
/// A leaf is no thicker than this in metres, ...
const THICKNESS: f64 = 0.07;
/// ... as it is drawn by so many cells more, in the mean, ...
const MEAN_BLUR: f64 = 1.0;
/// ... or anywhere: where one cell would do it takes up to two.
const BLUR: f64 = 2.0;
/// The steps to the cells that touch one.
const AROUND_A_CELL: [(i32, i32); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
/// So many neighbors of a tip in a row are free.
const CONVEX: usize = 4;
/// Around a tip so many points are looked at, ...
const RING: usize = 16;
/// ... of which a bar takes no more than this.
const BAR: usize = 4;
/// So much of a bar, in metres, has to be seen to say where it leads.
const BEGIN: f64 = 0.3;
/// ... and in cells less than this.
const FARTHEST: usize = 32;
/// How far beside and beyond an opening there must be space and wall, in metres, ...
const AROUND: f64 = 0.35;
/// ... or, if on one side alone, so much wall, ...
const LEADS_ON: f64 = 1.0;
/// ... and which part of the line beyond it is wall.
const WALLED: f64 = 0.8;
/// The shorter of two leaves is at least this part as long as the other.
const ALIKE: f64 = 0.6;
/// The cosines of the angles between a leaf that stands open and the opening: 14° to 120°.
const OPEN: std::ops::RangeInclusive<f64> = -0.5..=0.97;

/// A leaf that stands open; in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Leaf {
    /// Where it hangs.
    pub(super) hinge: [f64; 2],
    /// Its free end.
    pub(super) tip: [f64; 2],
}

impl Leaf {
    pub(super) fn length(&self) -> f64 {
        length(minus(self.tip, self.hinge))
    }
}

/// The leaves of a map of which the obstacles are given, and the cells that they cover.
pub(super) fn leaves(
    lattice: &Lattice,
    is_obstacle: impl Fn(usize) -> bool,
    options: &LeafOptions,
) -> (Vec<Leaf>, Vec<Cell>) {
    let field = Field { raster: Raster { lattice: *lattice, is_obstacle }, options };
    let bars = field.bars();
    let (mut leaves, mut cells) = (Vec::new(), Vec::new());
    for (number, bar) in bars.iter().enumerate() {
        let pairs = || bars.iter().enumerate().filter(|&(other, _)| other != number);
        if field.closes(bar) || pairs().any(|(_, other)| field.close_together(bar, other)) {
            leaves.push(Leaf { hinge: field.raster.metres(bar.hinge), tip: field.raster.metres(bar.tip) });
            cells.extend(field.cells_of(bar));
        }
    }
    (leaves, cells)
}

/// A thin bar with a free end and one at which it is joined to something.
#[derive(Clone, Copy, Debug)]
struct Bar {
    tip: Vector,
    hinge: Vector,
}

impl Bar {
    fn length(&self) -> f64 {
        length(minus(self.tip, self.hinge))
    }

    /// From the tip to the hinge, of length 1.
    fn direction(&self) -> Vector {
        unit(minus(self.hinge, self.tip))
    }
}

/// What is asked for leaves; lengths in cells, unless they are constants.
struct Field<'a, F> {
    raster: Raster<F>,
    options: &'a LeafOptions,
}

impl<F: Fn(usize) -> bool> Field<'_, F> {
    fn cells(&self, metres: f64) -> f64 {
        self.raster.cells(metres)
    }

    /// How far the beginning of a bar is looked at.
    fn reach(&self) -> f64 {
        self.cells(BEGIN).clamp(4.0, FARTHEST as f64 - 1.0)
    }

    fn thickness(&self) -> f64 {
        self.cells(THICKNESS) + BLUR
    }

    /// By how much an opening may be wider or narrower than what closes it.
    fn tolerance(&self, closing: f64) -> f64 {
        self.options.fits * closing + 1.5
    }

    fn is_at(&self, point: Vector) -> bool {
        self.raster.is_at(point)
    }

    /// All bars that are as long as leaves.
    fn bars(&self) -> Vec<Bar> {
        let lengths = self.cells(self.options.shortest)..=self.cells(self.options.longest);
        let is_leaf = |bar: &Bar| {
            lengths.contains(&bar.length())
                && self.cells_of(bar).len() as f64
                    <= (self.cells(THICKNESS) + MEAN_BLUR).max(BLUR) * bar.length()
        };
        let mut bars: Vec<Bar> = Vec::new();
        for tip in self.tips() {
            let Some(bar) = self.bar(tip).filter(is_leaf) else { continue };
            let is_near = |a: Vector, b: Vector| length(minus(a, b)) <= 1.5 * self.thickness();
            let is_same = |other: &Bar| is_near(bar.tip, other.tip) && is_near(bar.hinge, other.hinge);
            // In the order of their tips.
            let is_beside = |other: &&Bar| other.tip[1] + 3.0 * self.thickness() > bar.tip[1];
            if !bars.iter().rev().take_while(is_beside).any(is_same) {
                bars.push(bar);
            }
        }
        bars
    }

    /// The cells of obstacles at the ends of rows of them of which what lies around is free but for a bar.
    fn tips(&self) -> impl Iterator<Item = Cell> {
        let (width, height) = (self.raster.lattice.width() as usize, self.raster.lattice.height() as usize);
        let rings = [self.thickness() + 1.5, self.reach() - 1.0].map(|radius| self.ring(radius));
        let frame = (self.reach() + self.thickness()).ceil() as usize;
        let rows = frame..height.saturating_sub(frame);
        let inner =
            rows.flat_map(move |row| row * width + frame..(row * width + width.saturating_sub(frame)));
        let beside = AROUND_A_CELL.map(|(columns, rows)| rows as isize * width as isize + columns as isize);
        let is_tip = move |&index: &usize| {
            let is_obstacle = |index: usize| (self.raster.is_obstacle)(index);
            let is_convex = || {
                let around = beside.map(|step| is_obstacle(index.wrapping_add_signed(step)));
                (0..8).any(|first| (first..first + CONVEX).all(|at| !around[at % 8]))
            };
            let is_row_end = is_obstacle(index) && !(is_obstacle(index - 1) && is_obstacle(index + 1));
            let count = |ring: &[isize; RING]| {
                ring.iter().filter(|&&step| is_obstacle(index.wrapping_add_signed(step))).count()
            };
            is_row_end && is_convex() && rings.iter().all(|ring| count(ring) <= BAR)
        };
        inner.filter(is_tip).map(|index| self.raster.lattice.cell(index))
    }

    /// The steps, by index, to a ring around a cell.
    fn ring(&self, radius: f64) -> [isize; RING] {
        std::array::from_fn(|step| {
            let (sin, cos) = (step as f64 / RING as f64 * TAU).sin_cos();
            let [columns, rows] = [cos, sin].map(|axis| (radius * axis).round() as isize);
            rows * self.raster.lattice.width() as isize + columns
        })
    }

    /// The bar that ends in a tip.
    fn bar(&self, tip: Cell) -> Option<Bar> {
        let (start, mut at, mut ahead) = self.begin(tip)?;
        let longest = self.cells(self.options.longest) + 1.0;
        let mut line = vec![start];
        loop {
            match self.across(at, ahead) {
                Across::Bar(off) => {
                    let across = [-ahead[1], ahead[0]];
                    at = plus(at, across, off.clamp(-0.5, 0.5));
                    line.push(at);
                }
                Across::Wall => break,
                // What hangs loosely ends before the wall.
                Across::Nothing => {
                    let apart = self.cells(self.options.apart) as u32;
                    let beyond = (1..=apart).map(|step| plus(at, ahead, f64::from(step)));
                    at = beyond.into_iter().find(|&beyond| self.is_at(beyond))?;
                    break;
                }
            }
            if length(minus(at, start)) > longest {
                return None;
            }
            let so_far = minus(at, start);
            ahead = unit(so_far);
            at = plus(at, ahead, 1.0);
        }
        let bar = Bar { tip: start, hinge: at };
        let [dx, dy] = bar.direction();
        let is_straight = |&there: &Vector| {
            let [x, y] = minus(there, start);
            (dx * y - dy * x).abs() <= 1.2
        };
        line.iter().all(is_straight).then_some(bar)
    }

    /// Where the bar begins that ends in a tip, where it leads on, and in which direction.
    fn begin(&self, tip: Cell) -> Option<(Vector, Vector, Vector)> {
        let reach = self.reach();
        let most = ((reach + 2.0) * (self.thickness() + 1.0)) as usize;
        let start = point(tip);
        let (reached, width) = ((reach * reach) as i32, self.raster.lattice.width() as i32);
        let origin = self.raster.lattice.index(tip);
        // By steps from the tip, which is so far within the map that they lead to cells of it.
        let mut steps = vec![(0, 0)];
        let mut seen = [0_u64; 2 * FARTHEST];
        let mut is_first = |columns: i32, rows: i32| {
            let [column, row] = [columns, rows].map(|step| (step + FARTHEST as i32) as usize);
            let is_new = seen[row] >> column & 1 == 0;
            seen[row] |= 1 << column;
            is_new
        };
        is_first(0, 0);
        let mut at = 0;
        while at < steps.len() {
            let (column, row) = steps[at];
            for (columns, rows) in AROUND_A_CELL {
                let (columns, rows) = (column + columns, row + rows);
                let is_new = columns * columns + rows * rows <= reached
                    && (self.raster.is_obstacle)(
                        origin.wrapping_add_signed((rows * width + columns) as isize),
                    )
                    && is_first(columns, rows);
                if is_new {
                    steps.push((columns, rows));
                }
            }
            if steps.len() > most {
                return None;
            }
            at += 1;
        }
        let cells: Vec<Vector> =
            steps.iter().map(|&(columns, rows)| plus(start, [columns.into(), rows.into()], 1.0)).collect();
        let mean = |is_in: &dyn Fn(f64) -> bool| {
            let (mut sum, mut count) = ([0.0; 2], 0.0);
            for &cell in cells.iter().filter(|&&cell| is_in(length(minus(cell, start)))) {
                (sum, count) = (plus(sum, cell, 1.0), count + 1.0);
            }
            (count > 0.0).then(|| sum.map(|sum| sum / count))
        };
        let (near, far) = (mean(&|away| 2.0 * away <= reach)?, mean(&|away| 2.0 * away > reach)?);
        let (ahead, middle) = (unit(minus(far, near)), mean(&|_| true)?);
        let half = self.thickness() / 2.0 + 0.5;
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for &cell in &cells {
            let [x, y] = minus(cell, middle);
            if (ahead[0] * y - ahead[1] * x).abs() > half {
                return None;
            }
            let along = ahead[0] * x + ahead[1] * y;
            range = [range[0].min(along), range[1].max(along)];
        }
        let is_long = range[1] - range[0] >= reach - 1.5;
        let end = plus(middle, ahead, range[0]);
        // Beyond the hole in a wall is more of it.
        let apart = self.cells(self.options.apart) as u32;
        let is_free = |step: u32| !self.is_at(plus(end, ahead, -1.0 - f64::from(step)));
        let is_its_end = length(minus(end, start)) <= self.thickness() && (1..=apart).all(is_free);
        (is_long && is_its_end).then(|| (end, plus(middle, ahead, range[1] - 1.0), ahead))
    }

    /// What lies across a bar at a point of it.
    fn across(&self, at: Vector, ahead: Vector) -> Across {
        let thickness = self.thickness();
        let across = [-ahead[1], ahead[0]];
        let is_at = |half: i32| self.is_at(plus(at, across, f64::from(half) / 2.0));
        let Some(first) = [0, 1, -1, 2, -2].into_iter().find(|&half| is_at(half)) else {
            return Across::Nothing;
        };
        let most = (2.0 * thickness) as i32 + 1;
        let run = |sign: i32| (1..=most).take_while(|step| is_at(first + sign * step)).count() as i32;
        let (left, right) = (run(1), run(-1));
        if f64::from(left + right) / 2.0 > thickness {
            return Across::Wall;
        }
        Across::Bar(f64::from(2 * first + left - right) / 4.0)
    }

    /// Whether a bar would close an opening beside its hinge.
    fn closes(&self, bar: &Bar) -> bool {
        let directions = (0..DIRECTIONS).map(|turn| f64::from(turn) / f64::from(DIRECTIONS) * TAU);
        directions.map(f64::sin_cos).any(|(sin, cos)| self.close(&[*bar], [cos, sin]))
    }

    /// Whether two bars would together close an opening between their hinges. In cells that are larger than a leaf is thick they
    /// might as well be walls on both sides of an aisle.
    fn close_together(&self, one: &Bar, other: &Bar) -> bool {
        let apart = minus(other.hinge, one.hinge);
        let [shorter, longer] = [one.length().min(other.length()), one.length().max(other.length())];
        let is_near = length(apart)
            <= shorter + longer + self.tolerance(shorter + longer) + 2.0 * self.cells(DEPTHS[2]);
        let is_told_from_walls = self.cells(THICKNESS) >= 1.0;
        is_told_from_walls && is_near && shorter >= ALIKE * longer && self.close(&[*one, *other], unit(apart))
    }

    /// Whether bars would close an opening that leads from the hinge of the first in a direction.
    fn close(&self, bars: &[Bar], ahead: Vector) -> bool {
        let closing: f64 = bars.iter().map(Bar::length).sum();
        let tolerance = self.tolerance(closing);
        let is_beside = |bar: &Bar, [x, y]: Vector| {
            let along = bar.direction();
            OPEN.contains(&-(along[0] * x + along[1] * y))
        };
        let back = ahead.map(|axis| -axis);
        let is_open = bars.iter().zip([ahead, back]).all(|(bar, direction)| is_beside(bar, direction));
        is_open
            && DEPTHS.into_iter().any(|depth| {
                let hinge = plus(bars[0].hinge, bars[0].direction(), self.cells(depth));
                let is_closed = |wide: f64| (wide - closing).abs() <= tolerance;
                let wide = self.opening(bars, hinge, ahead, closing + tolerance + 1.0);
                wide.is_some_and(|wide| is_closed(wide) && self.is_between_walls(bars, hinge, ahead, wide))
            })
    }

    /// How far it is from a hinge to the other side of an opening, if it is no more than `most`.
    fn opening(&self, bars: &[Bar], hinge: Vector, ahead: Vector, most: f64) -> Option<f64> {
        let jamb = self.cells(self.options.apart);
        let at = |step: u32| f64::from(step) / 2.0;
        let is_wall = |step: &u32| self.is_wall(bars, plus(hinge, ahead, at(*step)));
        let begin = (1..=(2.0 * jamb) as u32).find(|step| !is_wall(step))?;
        (begin..=(2.0 * most) as u32).find(is_wall).map(at)
    }

    /// Whether an opening has space before and behind it and is in a wall: it leads on on both sides, or far on one.
    fn is_between_walls(&self, bars: &[Bar], hinge: Vector, ahead: Vector, wide: f64) -> bool {
        let across = [-ahead[1], ahead[0]];
        let around = self.cells(AROUND);
        let steps = |metres: f64| (1..=(2.0 * self.cells(metres)) as u32).map(|step| f64::from(step) / 2.0);
        let is_free = |at: Vector| !self.is_wall(bars, at);
        let middle = plus(hinge, ahead, wide / 2.0);
        let is_open = |far: f64| is_free(plus(middle, across, far)) && is_free(plus(middle, across, -far));
        let is_wall = |from: Vector, sign: f64, metres: f64| {
            let at = |far: f64, off: f64| plus(plus(from, ahead, sign * far), across, off);
            let is_on = |&far: &f64| [0.0, 1.0, -1.0].into_iter().any(|off| !is_free(at(far, off)));
            let part = steps(metres).filter(is_on).count() as f64 / steps(metres).count() as f64;
            part >= WALLED && [around, -around].into_iter().any(|off| is_free(at(around / 2.0, off)))
        };
        let jamb = plus(hinge, ahead, wide);
        steps(AROUND).all(is_open)
            && (is_wall(hinge, -1.0, AROUND) && is_wall(jamb, 1.0, AROUND)
                || is_wall(hinge, -1.0, LEADS_ON)
                || is_wall(jamb, 1.0, LEADS_ON))
    }

    /// Whether there is an obstacle at a point that belongs to none of the bars.
    fn is_wall(&self, bars: &[Bar], at: Vector) -> bool {
        self.is_at(at) && !bars.iter().any(|bar| self.is_on(bar, at))
    }

    /// Whether a point is on a bar, up to its hinge.
    fn is_on(&self, bar: &Bar, at: Vector) -> bool {
        let ([dx, dy], [x, y]) = (bar.direction(), minus(at, bar.tip));
        (-1.0..=bar.length() - 1.0).contains(&(dx * x + dy * y))
            && (dx * y - dy * x).abs() <= self.thickness() / 2.0 + 0.5
    }

    /// The cells that a bar covers, up to its hinge.
    fn cells_of(&self, bar: &Bar) -> FxHashSet<Cell> {
        let (ahead, half) = (bar.direction(), self.thickness() / 2.0 + 0.5);
        let across = [-ahead[1], ahead[0]];
        let steps = |from: f64, to: f64| {
            (0..=(2.0 * (to - from)) as u32).map(move |step| from + f64::from(step) / 2.0)
        };
        let points = steps(-1.0, bar.length() - 1.0).flat_map(|along| {
            steps(-half, half).map(move |off| plus(plus(bar.tip, ahead, along), across, off))
        });
        points.filter(|&at| self.is_at(at)).filter_map(|at| self.raster.cell_at(at)).collect()
    }
}

/// What lies across a bar.
enum Across {
    /// The bar, so many cells to the left.
    Bar(f64),
    /// More than a bar.
    Wall,
    Nothing,
}
