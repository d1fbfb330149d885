//! Anchors: cells that are on the medial axis because neighbors have nearest obstacles in clearly
//! different directions (the integer medial axis of Hesselink and Roerdink, 2008, with their test by
//! the bisector and pruned by the angle between the two obstacles).

use super::mask::Mask;
use crate::distance::DistanceField;
use crate::grid::Cell;

/// Marks the anchors among the members of `mask`, by position.
pub(super) fn anchors(mask: &Mask, field: &DistanceField, opening_angle: f64) -> Vec<bool> {
    let mut is_anchor = vec![false; mask.positions()];
    let chord = (2.0 * (opening_angle / 2.0).sin()).powi(2);
    for position in mask.members() {
        let around = mask.around(position);
        for near in [around[0], around[2]] {
            if !mask.contains(near) {
                continue;
            }
            let (here, there) = (mask.cell(position), mask.cell(near));
            let Some([first, second]) = separated_by(here, there, field, chord) else { continue };
            is_anchor[position] |= first;
            is_anchor[near] |= second;
        }
    }
    is_anchor
}

/// If the nearest obstacles of two neighboring cells are at least the angle apart, which of the two
/// cells is nearer to the obstacles' bisector; both if they are equally near.
fn separated_by(here: Cell, there: Cell, field: &DistanceField, chord: f64) -> Option<[bool; 2]> {
    let [p, q] = [here, there].map(vector);
    let (f, g) = (vector(field.nearest(here)?), vector(field.nearest(there)?));
    let radius = field.squared_cells(here)?.max(field.squared_cells(there)?);
    let apart = [g[0] - f[0], g[1] - f[1]];
    let separation = apart[0] * apart[0] + apart[1] * apart[1];
    if separation <= 2 || (separation as f64) < chord * f64::from(radius) {
        return None;
    }
    let side = (0..2).map(|axis| apart[axis] * (f[axis] + g[axis] - p[axis] - q[axis])).sum::<i64>();
    Some([side <= 0, side >= 0])
}

fn vector(cell: Cell) -> [i64; 2] {
    [i64::from(cell.column), i64::from(cell.row)]
}
