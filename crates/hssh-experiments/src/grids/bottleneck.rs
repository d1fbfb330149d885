//! How wide a way from one room to another is at its narrowest, in a grid: a widest path, found on the grid alone.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use hssh_local::{Cell, DistanceField};

/// A cell that was reached, with the width in metres of what leads there.
struct Reached {
    width: f64,
    cell: Cell,
}

/// The width in metres of the widest way from the cells that are in one room to those in another, through these and cells that are in
/// none; 0 if there is no way. A way is as wide as the disc that fits through it.
pub(super) fn bottleneck(field: &DistanceField, room_of: &[Option<u32>], [from, to]: [u32; 2]) -> f64 {
    let lattice = *field.lattice();
    let width = |cell: Cell| 2.0 * field.clearance(cell);
    let mut is_seen = vec![false; lattice.len()];
    let mut waiting = BinaryHeap::new();
    for cell in lattice.cells().filter(|&cell| room_of[lattice.index(cell)] == Some(from)) {
        is_seen[lattice.index(cell)] = true;
        waiting.push(Reached { width: width(cell), cell });
    }
    while let Some(Reached { width: so_far, cell }) = waiting.pop() {
        if room_of[lattice.index(cell)] == Some(to) {
            return so_far;
        }
        for near in lattice.side_neighbors(cell) {
            let index = lattice.index(near);
            let is_open = room_of[index].is_none_or(|room| room == to) && width(near) > 0.0;
            if is_open && !std::mem::replace(&mut is_seen[index], true) {
                waiting.push(Reached { width: so_far.min(width(near)), cell: near });
            }
        }
    }
    0.0
}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        self.width.total_cmp(&other.width).then_with(|| other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Reached {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Reached {}
