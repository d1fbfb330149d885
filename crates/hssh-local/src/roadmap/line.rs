//! The line of a way in metres: as straight as the obstacles allow, and how wide the way along it is.

use crate::distance::DistanceField;
use crate::grid::Cell;
use crate::skeleton::distance;

/// The clearance is looked at so often in the length of a cell.
const SAMPLES_PER_CELL: f64 = 2.0;

/// How near obstacles are to a line at its nearest, in metres, from the line to the side of their cells.
pub(super) fn least_clearance(line: &[[f64; 2]], field: &DistanceField) -> f64 {
    let samples = line.windows(2).flat_map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let count = (distance(a, b) / field.lattice().resolution() * SAMPLES_PER_CELL).ceil().max(1.0);
        (0..=count as u32).map(move |step| {
            let part = f64::from(step) / count;
            [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]
        })
    });
    let ends = line.first().map(|&point| clearance(point, field));
    samples.map(|point| clearance(point, field)).chain(ends).fold(f64::INFINITY, f64::min)
}

/// How far a point is from the sides of the nearest obstacles' cells.
fn clearance(point: [f64; 2], field: &DistanceField) -> f64 {
    let lattice = field.lattice();
    let Some(cell) = lattice.cell_at(point) else { return 0.0 };
    let half = lattice.resolution() / 2.0;
    let to_side = |site: Cell| {
        let center = lattice.center(site);
        let beyond = |axis: usize| ((point[axis] - center[axis]).abs() - half).max(0.0);
        beyond(0).powi(2) + beyond(1).powi(2)
    };
    let cells = (-1..=1).flat_map(|rows| (-1..=1).map(move |columns| (columns, rows)));
    let sites = cells.filter_map(|(columns, rows)| field.nearest(lattice.step(cell, columns, rows)?));
    sites.map(to_side).fold(f64::INFINITY, f64::min).sqrt()
}

/// A line with fewer corners that is nowhere farther from the old one than `off`, and no nearer to obstacles than `least`
/// (Douglas and Peucker's algorithm).
pub(super) fn straightened(line: &[[f64; 2]], off: f64, least: f64, field: &DistanceField) -> Vec<[f64; 2]> {
    let [first, .., last] = *line else { return line.to_vec() };
    let far = |point: [f64; 2]| {
        let along = [last[0] - first[0], last[1] - first[1]];
        let to = [point[0] - first[0], point[1] - first[1]];
        let length = along[0].hypot(along[1]);
        if length == 0.0 { to[0].hypot(to[1]) } else { (along[0] * to[1] - along[1] * to[0]).abs() / length }
    };
    let inner = 1..line.len() - 1;
    let Some(farthest) = inner.max_by(|&a, &b| far(line[a]).total_cmp(&far(line[b]))) else {
        return vec![first, last];
    };
    if far(line[farthest]) <= off && least_clearance(&[first, last], field) >= least {
        return vec![first, last];
    }
    let mut straight = straightened(&line[..=farthest], off, least, field);
    straight.pop();
    straight.extend(straightened(&line[farthest..], off, least, field));
    straight
}
