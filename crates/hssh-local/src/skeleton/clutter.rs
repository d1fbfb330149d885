//! Clutter: what stands free, is small, and is no part of a wall.

use std::f64::consts::TAU;
use std::ops::Range;

use rustc_hash::{FxHashMap, FxHashSet};

use super::mask::Mask;
use crate::disjoint_sets::DisjointSets;
use crate::grid::Cell;

/// What is at least this many times as long as it is wide is a piece of a wall.
const SLENDER: f64 = 4.0;
/// Directions in which the walls are told apart that something lies between, ...
const DIRECTIONS: usize = 24;
/// ... which are opposite if the cosine of the angle between them is no greater: 150°.
const OPPOSITE: f64 = -0.866;

/// Takes out the clutter: connected groups of obstacles of at most `longest` cells along both axes that do not touch the
/// border. Groups in a row, each no more than `apart` cells from the next, are no clutter if the row is longer, or if it
/// leads from one large obstacle to another: they are a wall that was seen in pieces.
pub(super) fn remove_clutter(obstacles: &mut Mask, longest: u32, apart: u32) {
    let groups = small_groups(obstacles, longest);
    let mut clutter = obstacles.without_members();
    groups.iter().flatten().for_each(|&position| clutter.insert(position));
    for row in rows(&mut clutter, &groups, apart) {
        let is_wall =
            || is_long(&row, f64::from(longest), obstacles) || is_between_walls(&row, apart, obstacles);
        if apart == 0 || !is_wall() {
            row.into_iter().for_each(|position| obstacles.remove(position));
        }
    }
}

/// The connected groups of at most `longest` cells along both axes that do not touch the border.
fn small_groups(obstacles: &Mask, longest: u32) -> Vec<Vec<usize>> {
    let runs: Vec<Run> = obstacles.runs().map(|run| Run::new(run, obstacles)).collect();
    let mut groups = Groups::new(&runs);
    let mut below = 0;
    for (here, run) in runs.iter().enumerate() {
        // The runs of the row below that end before this one begins touch no later one either.
        while runs[below].row + 1 < run.row || (runs[below].row < run.row && runs[below].end < run.start) {
            below += 1;
        }
        let touching =
            (below..here).take_while(|&other| runs[other].row < run.row && runs[other].start <= run.end);
        touching.for_each(|other| groups.join(other as u32, here as u32));
    }
    let [width, height] = obstacles.size();
    let mut number_of: FxHashMap<u32, usize> = FxHashMap::default();
    let mut small: Vec<Vec<usize>> = Vec::new();
    for (here, run) in runs.iter().enumerate() {
        let root = groups.sets.representative(here as u32);
        let [low, high] = groups.bounds[root as usize];
        let is_small = high.column - low.column < longest && high.row - low.row < longest;
        let is_inside = low.column > 0 && low.row > 0 && high.column + 1 < width && high.row + 1 < height;
        if is_small && is_inside {
            let number = *number_of.entry(root).or_insert(small.len());
            if number == small.len() {
                small.push(Vec::new());
            }
            let start = obstacles.position(Cell { column: run.start, row: run.row });
            small[number].extend(start..start + (run.end - run.start) as usize);
        }
    }
    small
}

/// Obstacles side by side in a row, from a first column to behind the last.
struct Run {
    row: u32,
    start: u32,
    end: u32,
}

impl Run {
    fn new(positions: Range<usize>, mask: &Mask) -> Self {
        let Cell { column, row } = mask.cell(positions.start);
        Run { row, start: column, end: column + positions.len() as u32 }
    }
}

/// Which runs hang together.
struct Groups {
    sets: DisjointSets,
    /// The lowest and the highest column and row of the group that a run stands for.
    bounds: Vec<[Cell; 2]>,
}

impl Groups {
    fn new(runs: &[Run]) -> Self {
        let cell = |column: u32, row: u32| Cell { column, row };
        let bounds = runs.iter().map(|run| [cell(run.start, run.row), cell(run.end - 1, run.row)]);
        Groups { sets: DisjointSets::singletons(runs.len()), bounds: bounds.collect() }
    }

    fn join(&mut self, one: u32, other: u32) {
        let [one, other] = [one, other].map(|run| self.sets.representative(run));
        let (kept, gone) = (one.min(other), one.max(other));
        self.sets.join(gone, kept);
        let [gone_low, gone_high] = self.bounds[gone as usize];
        let [low, high] = &mut self.bounds[kept as usize];
        *low = Cell { column: low.column.min(gone_low.column), row: low.row.min(gone_low.row) };
        *high = Cell { column: high.column.max(gone_high.column), row: high.row.max(gone_high.row) };
    }
}

/// Groups that are no more than `apart` cells from one another along both axes, as one.
fn rows(members: &mut Mask, groups: &[Vec<usize>], apart: u32) -> Vec<Vec<usize>> {
    let mut rows = Vec::new();
    for &start in groups.iter().filter_map(|group| group.first()) {
        if !members.contains(start) {
            continue;
        }
        members.remove(start);
        let mut row = vec![start];
        let mut at = 0;
        while at < row.len() {
            let near: Vec<usize> = members.within(row[at], apart.max(1)).collect();
            near.iter().for_each(|&near| members.remove(near));
            row.extend(near);
            at += 1;
        }
        rows.push(row);
    }
    rows
}

/// Whether cells are in a row that is longer than so many cells, and slender.
fn is_long(row: &[usize], longest: f64, mask: &Mask) -> bool {
    let points = || row.iter().map(|&position| point(position, mask));
    let mean = middle(row, mask);
    let [xx, xy, yy] = points().fold([0.0; 3], |[xx, xy, yy], [x, y]| {
        let [x, y] = [x - mean[0], y - mean[1]];
        [xx + x * x, xy + x * y, yy + y * y]
    });
    let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let extent = |[ax, ay]: [f64; 2]| {
        let along = points().map(|[x, y]| x * ax + y * ay);
        let [low, high] =
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
        high - low + 1.0
    };
    let (length, width) = (extent([cos, sin]), extent([-sin, cos]));
    length > longest && length >= SLENDER * width
}

/// Whether cells that are no more than `apart` cells from the rest of the obstacles are so on both ends of a line along
/// which they lie, and no farther from it than this.
fn is_between_walls(row: &[usize], apart: u32, obstacles: &Mask) -> bool {
    let own: FxHashSet<usize> = row.iter().copied().collect();
    let middle = middle(row, obstacles);
    let mut nearest: [Option<(f64, [f64; 2])>; DIRECTIONS] = [None; DIRECTIONS];
    for &position in row {
        for wall in obstacles.within(position, apart).filter(|wall| !own.contains(wall)) {
            let [x, y] = point(wall, obstacles);
            let away = [x - middle[0], y - middle[1]];
            let far = away[0].hypot(away[1]);
            let turn = away[1].atan2(away[0]).rem_euclid(TAU) / TAU;
            let nearest = &mut nearest[(turn * DIRECTIONS as f64) as usize % DIRECTIONS];
            if nearest.is_none_or(|(least, _)| far < least) {
                *nearest = Some((far, away));
            }
        }
    }
    let is_along = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
        let (dx, dy) = (bx - ax, by - ay);
        let length = dx.hypot(dy);
        let is_opposite = ax * bx + ay * by <= OPPOSITE * ax.hypot(ay) * bx.hypot(by);
        is_opposite
            && row.iter().all(|&position| {
                let [x, y] = point(position, obstacles);
                let off = dx * (y - middle[1] - ay) - dy * (x - middle[0] - ax);
                off.abs() <= f64::from(apart) * length
            })
    };
    let ends: Vec<[f64; 2]> = nearest.into_iter().flatten().map(|(_, away)| away).collect();
    ends.iter().enumerate().any(|(at, &one)| ends[at + 1..].iter().any(|&other| is_along(one, other)))
}

/// The middle of the cells at positions.
fn middle(row: &[usize], mask: &Mask) -> [f64; 2] {
    let count = row.len() as f64;
    let points = row.iter().map(|&position| point(position, mask));
    points.fold([0.0; 2], |sum, [x, y]| [sum[0] + x / count, sum[1] + y / count])
}

fn point(position: usize, mask: &Mask) -> [f64; 2] {
    let cell = mask.cell(position);
    [f64::from(cell.column), f64::from(cell.row)]
}
