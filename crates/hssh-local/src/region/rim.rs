//! How much of the rims of regions was seen.

use super::flood::NO_PIECE;
use super::ground::Ground;

/// For each region the part of its rim that is wall; the rest was never looked at, or the map ends there. The rim is what is nearest to where the
/// middle of a robot may just be that fits through a gap of `narrowest` metres: rays of a laser are none.
pub(super) fn explored(labels: &[u32], regions: usize, ground: &Ground, narrowest: f64) -> Vec<f64> {
    if ground.is_all_wall() && !ground.has_open_edge() {
        return vec![1.0; regions];
    }
    let field = ground.field();
    let lattice = *field.lattice();
    let least = narrowest / 2.0;
    let rim = least..least + lattice.resolution();
    let mut cells = vec![[0_u32; 2]; regions];
    for cell in lattice.cells().filter(|&cell| rim.contains(&field.clearance(cell))) {
        let label = labels[lattice.index(cell)];
        if let Some(nearest) = field.nearest(cell).filter(|_| label != NO_PIECE) {
            cells[label as usize][usize::from(ground.is_seen_wall(lattice.index(nearest)))] += 1;
        }
    }
    let part = |[unseen, wall]: [u32; 2]| match unseen + wall {
        0 => 1.0,
        all => f64::from(wall) / f64::from(all),
    };
    cells.into_iter().map(part).collect()
}
