//! How much of the rims of regions was seen.

use super::flood::NO_PIECE;
use super::ground::Ground;

/// How thick the rim is that is looked at, in cells: so thick that at any angle about as many lie along a metre of it.
const THICKNESS: f64 = 4.0;

/// For each piece that stands for a region, as `region_of` says for each, the part of its rim that is wall; the rest was never
/// looked at, or the map ends there. The rim is what is nearest to where the middle of a robot may just be that fits through a
/// gap of `narrowest` metres: rays of a laser are none.
pub(super) fn explored(labels: &[u32], region_of: &[u32], ground: &Ground, narrowest: f64) -> Vec<f64> {
    if ground.is_all_wall() && !ground.has_open_edge() {
        return vec![1.0; region_of.len()];
    }
    let field = ground.field();
    let lattice = *field.lattice();
    // In cells between the middles, squared: what is no obstacle itself begins half a cell from it.
    let least = narrowest / 2.0 / lattice.resolution() + 0.5;
    let rim = [least, least + THICKNESS].map(|cells| (cells * cells).ceil() as u32);
    let mut cells = vec![[0_u32; 2]; region_of.len()];
    for (index, &label) in labels.iter().enumerate() {
        if !(rim[0]..rim[1]).contains(&field.squared_at(index)) {
            continue;
        }
        let cell = lattice.cell(index);
        if let Some(nearest) = field.nearest(cell).filter(|_| label != NO_PIECE) {
            let is_wall = ground.is_seen_wall(lattice.index(nearest));
            cells[region_of[label as usize] as usize][usize::from(is_wall)] += 1;
        }
    }
    let part = |[unseen, wall]: [u32; 2]| match unseen + wall {
        0 => 1.0,
        all => f64::from(wall) / f64::from(all),
    };
    cells.into_iter().map(part).collect()
}
