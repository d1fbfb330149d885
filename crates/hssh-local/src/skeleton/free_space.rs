//! Free space: where a robot fits, and how far each of its cells is from obstacles.

use super::clutter::remove_clutter;
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
        let field = clear_field(grid, options);
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

/// How far each cell is from the obstacles of a grid without its clutter.
pub(crate) fn clear_field(grid: &OccupancyGrid, options: &SkeletonOptions) -> DistanceField {
    let lattice = *grid.lattice();
    let is_obstacle = |index: usize| match grid.cells()[index] {
        Occupancy::Occupied => true,
        Occupancy::Unknown => options.unknown != UnknownSpace::Free,
        Occupancy::Free => false,
    };
    let mut obstacles = Mask::new(&lattice, is_obstacle);
    let cells = |metres: f64| (metres / lattice.resolution()).round() as u32;
    remove_clutter(&mut obstacles, cells(options.clutter), cells(options.apart));
    DistanceField::new(lattice, |index| obstacles.contains(obstacles.position_of(index)))
}
