//! Lettering: words and numbers in a plan. They stand free, and along a line of them ink and paper alternate.

use rustc_hash::FxHashSet;

use super::thing::{Thing, things};
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};

/// What is no farther apart than this is one word, in metres.
const APART: f64 = 0.2;
/// Words are no longer than this, in metres, ...
const LONGEST: f64 = 12.0;
/// ... no higher, two lines of them included, ...
const HIGHEST: f64 = 1.2;
/// ... and letters no lower.
const LOWEST: f64 = 0.12;
/// Words are at least so many times as long as they are high.
const ELONGATION: f64 = 1.5;
/// Lines through words lie so far from the middle, in heights.
const LINES: [f64; 5] = [-0.3, -0.15, 0.0, 0.15, 0.3];
/// For each height of it, so many strokes cross a line through a word, in the mean, ...
const DENSE: f64 = 0.8;
/// ... and so many at least in all.
const STROKES: f64 = 3.5;
/// Letters are drawn apart: there are at least so many of them.
const LETTERS: usize = 4;

/// The cells of obstacles, by index, that are lettering; `drawn` is the plan as it is drawn.
pub(super) fn lettering(drawn: &OccupancyGrid, is_obstacle: impl Fn(usize) -> bool) -> Vec<usize> {
    let lattice = *drawn.lattice();
    let words = Words { drawn, times: (APART / lattice.resolution()).round().max(1.0) as u32 };
    let mut found = Vec::new();
    let longest = (words.cells(LONGEST) / f64::from(words.times)) as u32;
    for thing in things(&lattice, &is_obstacle, words.times) {
        if thing.size().into_iter().all(|cells| cells <= longest) {
            let obstacles = words.obstacles(&thing, &is_obstacle);
            if words.is_word(&obstacles) {
                found.extend(obstacles.into_iter().map(|cell| lattice.index(cell)));
            }
        }
    }
    found
}

struct Words<'a> {
    drawn: &'a OccupancyGrid,
    /// Things are told apart in cells that are so many times as large.
    times: u32,
}

impl Words<'_> {
    fn lattice(&self) -> &Lattice {
        self.drawn.lattice()
    }

    fn cells(&self, metres: f64) -> f64 {
        metres / self.lattice().resolution()
    }

    /// The obstacles that a thing consists of.
    fn obstacles(&self, thing: &Thing, is_obstacle: impl Fn(usize) -> bool) -> Vec<Cell> {
        let lattice = *self.lattice();
        let within = |at: u32, cells: u32| at * self.times..((at + 1) * self.times).min(cells);
        let cells = thing.members.iter().flat_map(|member| {
            let columns = within(member.column, lattice.width());
            let rows = within(member.row, lattice.height());
            rows.flat_map(move |row| columns.clone().map(move |column| Cell { column, row }))
        });
        cells.filter(|&cell| is_obstacle(lattice.index(cell))).collect()
    }

    /// Whether strokes alternate with paper along a thing.
    fn is_word(&self, thing: &[Cell]) -> bool {
        let count = thing.len() as f64;
        let points = || thing.iter().map(|cell| [f64::from(cell.column), f64::from(cell.row)]);
        let mean = points().fold([0.0; 2], |[x, y], [px, py]| [x + px / count, y + py / count]);
        let [xx, xy, yy] = points().fold([0.0; 3], |[xx, xy, yy], [x, y]| {
            let [x, y] = [x - mean[0], y - mean[1]];
            [xx + x * x, xy + x * y, yy + y * y]
        });
        let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
        let extent = |[ax, ay]: [f64; 2]| {
            let along = points().map(|[x, y]| (x - mean[0]) * ax + (y - mean[1]) * ay);
            along.fold([0.0_f64; 2], |[low, high], at| [low.min(at), high.max(at)])
        };
        let [[start, end], [bottom, top]] = [extent([cos, sin]), extent([-sin, cos])];
        let (length, high) = (end - start + 1.0, top - bottom + 1.0);
        let is_as_large = length >= ELONGATION * high
            && length <= self.cells(LONGEST)
            && (self.cells(LOWEST)..=self.cells(HIGHEST)).contains(&high);
        if !is_as_large || high < 3.0 {
            return false;
        }
        let value = |along: f64, off: f64| {
            let [x, y] = [mean[0] + along * cos - off * sin, mean[1] + along * sin + off * cos];
            let on = |at: f64, cells: u32| {
                (at.round() >= 0.0 && at.round() < f64::from(cells)).then_some(at.round() as u32)
            };
            let column = on(x, self.lattice().width())?;
            Some(self.drawn.get(Cell { column, row: on(y, self.lattice().height())? }))
        };
        let middle = (bottom + top) / 2.0;
        let changes = |line: f64| {
            let values: Vec<Option<Occupancy>> = (0..=(length as u32 + 2))
                .map(|step| value(start - 1.0 + f64::from(step), middle + line * high))
                .collect();
            values.windows(2).filter(|pair| pair[0] != pair[1]).count() as f64
        };
        let strokes = LINES.into_iter().map(changes).sum::<f64>() / 2.0 / LINES.len() as f64;
        strokes >= (DENSE * length / high).max(STROKES) && self.letters(thing) >= LETTERS
    }

    /// How many groups of ink there are in a thing, without the gray between them.
    fn letters(&self, thing: &[Cell]) -> usize {
        let is_ink = |cell: &&Cell| self.drawn.get(**cell) == Occupancy::Occupied;
        let mut ink: FxHashSet<Cell> = thing.iter().filter(is_ink).copied().collect();
        let mut count = 0;
        for &start in thing {
            if !ink.remove(&start) {
                continue;
            }
            count += 1;
            let mut waiting = vec![start];
            while let Some(here) = waiting.pop() {
                let around = (-1..=1).flat_map(|rows| (-1..=1).map(move |columns| (columns, rows)));
                let near = around.filter_map(|(columns, rows)| self.lattice().step(here, columns, rows));
                waiting.extend(near.filter(|near| ink.remove(near)));
            }
        }
        count
    }
}
