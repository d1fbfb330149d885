//! Clutter: what stands free, is small, and is no part of a wall.

use super::mask::Mask;
use crate::grid::Cell;

/// What is at least this many times as long as it is wide is a piece of a wall.
const SLENDER: f64 = 4.0;

/// Takes out the clutter: connected groups of obstacles of at most `longest` cells along both axes that do not touch the
/// border. Groups in a row, each no more than `apart` cells from the next, are no clutter if the row is longer: they are a
/// wall that was seen in pieces.
pub(super) fn remove_clutter(obstacles: &mut Mask, longest: u32, apart: u32) {
    let groups = small_groups(obstacles, longest);
    let mut clutter = obstacles.without_members();
    groups.iter().flatten().for_each(|&position| clutter.insert(position));
    for row in rows(&mut clutter, &groups, apart) {
        if apart == 0 || !is_wall(&row, f64::from(longest), obstacles) {
            row.into_iter().for_each(|position| obstacles.remove(position));
        }
    }
}

/// The connected groups of at most `longest` cells along both axes that do not touch the border.
fn small_groups(obstacles: &Mask, longest: u32) -> Vec<Vec<usize>> {
    let mut is_seen = vec![false; obstacles.positions()];
    let mut small = Vec::new();
    for start in obstacles.members() {
        if is_seen[start] {
            continue;
        }
        let mut group = vec![start];
        is_seen[start] = true;
        let (mut low, mut high) = (obstacles.cell(start), obstacles.cell(start));
        let mut at = 0;
        while at < group.len() {
            for near in obstacles.neighbors(group[at]) {
                if !is_seen[near] {
                    is_seen[near] = true;
                    let Cell { column, row } = obstacles.cell(near);
                    low = Cell { column: low.column.min(column), row: low.row.min(row) };
                    high = Cell { column: high.column.max(column), row: high.row.max(row) };
                    group.push(near);
                }
            }
            at += 1;
        }
        let is_small = high.column - low.column < longest && high.row - low.row < longest;
        let [width, height] = obstacles.size();
        let is_inside = low.column > 0 && low.row > 0 && high.column + 1 < width && high.row + 1 < height;
        if is_small && is_inside {
            small.push(group);
        }
    }
    small
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
fn is_wall(row: &[usize], longest: f64, mask: &Mask) -> bool {
    let points = || {
        row.iter()
            .map(|&position| mask.cell(position))
            .map(|cell| [f64::from(cell.column), f64::from(cell.row)])
    };
    let count = row.len() as f64;
    let mean = points().fold([0.0; 2], |sum, [x, y]| [sum[0] + x / count, sum[1] + y / count]);
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
