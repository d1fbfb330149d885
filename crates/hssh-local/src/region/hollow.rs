//! Hollows: what lies between the two faces of a wall that a plan draws as lines.

use crate::disjoint_sets::DisjointSets;
use crate::distance::DistanceField;
use crate::grid::OccupancyGrid;

/// The cells, by index, of free space that is closed on all sides and nowhere as wide as so many metres, unless one of the points
/// in metres is in it.
pub(super) fn hollows(
    grid: &OccupancyGrid,
    is_obstacle: impl Fn(usize) -> bool,
    widest: f64,
    but: &[[f64; 2]],
) -> Vec<usize> {
    let lattice = *grid.lattice();
    let field = DistanceField::new(lattice, &is_obstacle);
    let (part_of, parts) = parts(lattice.width() as usize, lattice.len(), &is_obstacle);
    let mut is_hollow = vec![true; parts];
    for (index, &part) in part_of.iter().enumerate() {
        if part != OBSTACLE && 2.0 * field.clearance_at(index) >= widest {
            is_hollow[part as usize] = false;
        }
    }
    for &at in but {
        if let Some(cell) = lattice.cell_at(at).filter(|&cell| part_of[lattice.index(cell)] != OBSTACLE) {
            is_hollow[part_of[lattice.index(cell)] as usize] = false;
        }
    }
    let is_in = |&(_, &part): &(usize, &u32)| part != OBSTACLE && is_hollow[part as usize];
    part_of.iter().enumerate().filter(is_in).map(|(index, _)| index).collect()
}

/// The part of a cell that is none.
const OBSTACLE: u32 = u32::MAX;

/// For each cell the part of free space that it is in, where cells hang together along rows and columns, and how many sets there are.
fn parts(width: usize, cells: usize, is_obstacle: impl Fn(usize) -> bool) -> (Vec<u32>, usize) {
    let mut sets = DisjointSets::default();
    let mut part_of = vec![OBSTACLE; cells];
    for index in (0..cells).filter(|&index| !is_obstacle(index)) {
        let left = if index % width > 0 { part_of[index - 1] } else { OBSTACLE };
        let below = if index >= width { part_of[index - width] } else { OBSTACLE };
        part_of[index] = match (left, below) {
            (OBSTACLE, OBSTACLE) => sets.add(),
            (part, OBSTACLE) | (OBSTACLE, part) => part,
            (left, below) => {
                let [left, below] = [left, below].map(|part| sets.representative(part));
                sets.join(left.max(below), left.min(below));
                left.min(below)
            }
        };
    }
    for part in part_of.iter_mut().filter(|part| **part != OBSTACLE) {
        *part = sets.representative(*part);
    }
    (part_of, sets.len())
}
