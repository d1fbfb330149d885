//! Free space: where a robot fits, and how far each of its cells is from obstacles.

use super::mask::Mask;
use super::options::{SkeletonOptions, UnknownSpace};
use crate::distance::DistanceField;
use crate::grid::{Cell, Occupancy, OccupancyGrid};

/// The cells of a grid where a robot fits, with the distance field of the obstacles around them.
#[derive(Clone, Debug)]
pub struct FreeSpace {
    field: DistanceField,
    pub(super) mask: Mask,
}

impl FreeSpace {
    /// The free space of a grid: without clutter, and without passages that are too narrow.
    #[must_use]
    pub fn new(grid: &OccupancyGrid, options: &SkeletonOptions) -> Self {
        let lattice = *grid.lattice();
        let is_obstacle = |index: usize| match grid.cells()[index] {
            Occupancy::Occupied => true,
            Occupancy::Unknown => options.unknown != UnknownSpace::Free,
            Occupancy::Free => false,
        };
        let mut obstacles = Mask::new(&lattice, is_obstacle);
        remove_clutter(&mut obstacles, (options.clutter / lattice.resolution()).round() as u32, grid);
        let is_obstacle: Vec<bool> = obstacles.in_lattice().collect();
        let field = DistanceField::new(lattice, |index| is_obstacle[index]);
        let narrowest = options.narrowest_passage / 2.0;
        let mask = Mask::new(&lattice, |index| {
            let clearance = field.clearance_at(index);
            clearance > 0.0 && clearance >= narrowest && clearance.is_finite()
        });
        FreeSpace { field, mask }
    }

    /// How far each cell is from the obstacles.
    #[must_use]
    pub fn field(&self) -> &DistanceField {
        &self.field
    }

    /// Whether a robot fits into a cell of the grid.
    #[must_use]
    pub fn contains(&self, cell: Cell) -> bool {
        self.mask.contains(self.mask.position(cell))
    }

    /// Whether a robot fits nowhere, or nothing limits where it fits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mask.members().next().is_none()
    }
}

/// Takes out the connected groups of obstacles of at most `longest` cells along both axes that do not
/// touch the border.
fn remove_clutter(obstacles: &mut Mask, longest: u32, grid: &OccupancyGrid) {
    let last = Cell { column: grid.lattice().width() - 1, row: grid.lattice().height() - 1 };
    let mut is_seen = vec![false; obstacles.positions()];
    let starts: Vec<usize> = obstacles.members().collect();
    for start in starts {
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
        let is_inside = low.column > 0 && low.row > 0 && high.column < last.column && high.row < last.row;
        if is_small && is_inside {
            group.into_iter().for_each(|position| obstacles.remove(position));
        }
    }
}
