//! How much of the rims of regions was seen.

use super::flood::NO_PIECE;
use super::ground::Ground;

/// For each region the part of its rim that is wall; the rest was never looked at. Where one region leads to another, or
/// space is too narrow for any, is no rim.
pub(super) fn explored(labels: &[u32], regions: usize, ground: &Ground) -> Vec<f64> {
    let lattice = *ground.field().lattice();
    let mut sides = vec![[0_u32; 2]; regions];
    for cell in lattice.cells() {
        let label = labels[lattice.index(cell)];
        if label == NO_PIECE {
            continue;
        }
        for near in lattice.side_neighbors(cell).map(|near| lattice.index(near)) {
            if ground.is_obstacle(near) {
                sides[label as usize][usize::from(ground.is_wall(near))] += 1;
            }
        }
    }
    let part = |[unseen, wall]: [u32; 2]| match unseen + wall {
        0 => 1.0,
        all => f64::from(wall) / f64::from(all),
    };
    sides.into_iter().map(part).collect()
}
