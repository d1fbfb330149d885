//! How wide a way from one room to another is at its narrowest, in a grid: a widest path, found on the grid alone.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use hssh_local::{Cell, DistanceField};

/// The width in metres of the widest way from the cells that are in one room to those in another, through these and cells that are in
/// none; 0 if there is no way. A way is as wide as the disc that fits through it.
pub(super) fn bottleneck(field: &DistanceField, room_of: &[Option<u32>], [from, to]: [u32; 2]) -> f64 {
    let lattice = *field.lattice();
    let width = |cell: Cell| 2.0 * field.clearance(cell);
    let mut is_seen = vec![false; lattice.len()];
    // The widest first. Widths are not negative, so that their bits are in their order.
    let mut waiting = BinaryHeap::new();
    for cell in lattice.cells().filter(|&cell| room_of[lattice.index(cell)] == Some(from)) {
        is_seen[lattice.index(cell)] = true;
        waiting.push((width(cell).to_bits(), Reverse(cell)));
    }
    while let Some((bits, Reverse(cell))) = waiting.pop() {
        let so_far = f64::from_bits(bits);
        if room_of[lattice.index(cell)] == Some(to) {
            return so_far;
        }
        for near in lattice.side_neighbors(cell) {
            let index = lattice.index(near);
            let is_open = room_of[index].is_none_or(|room| room == to) && width(near) > 0.0;
            if is_open && !std::mem::replace(&mut is_seen[index], true) {
                waiting.push((so_far.min(width(near)).to_bits(), Reverse(near)));
            }
        }
    }
    0.0
}
