//! The robot's body in a grid: a disc that must not meet anything.

use hssh_local::{Occupancy, OccupancyGrid};

/// Whether a disc around a point reaches into a cell that is not free, or beyond the grid; metres.
#[must_use]
pub fn touches(grid: &OccupancyGrid, center: [f64; 2], radius: f64) -> bool {
    let lattice = grid.lattice();
    let resolution = lattice.resolution();
    let Some(here) = lattice.cell_at(center) else { return true };
    let cells = (radius / resolution).ceil() as i32 + 1;
    (-cells..=cells).any(|rows| {
        (-cells..=cells).any(|columns| {
            let [x, y] = lattice.center(here);
            let middle = [x + f64::from(columns) * resolution, y + f64::from(rows) * resolution];
            // The point of the cell that is nearest to the disc's center.
            let off = [0, 1].map(|axis| ((middle[axis] - center[axis]).abs() - resolution / 2.0).max(0.0));
            let is_free =
                || lattice.step(here, columns, rows).is_some_and(|cell| grid.get(cell) == Occupancy::Free);
            off[0].hypot(off[1]) < radius && !is_free()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hssh_local::Lattice;

    #[test]
    fn a_disc_touches_what_is_nearer_than_its_radius() {
        let lattice = Lattice::new(40, 40, 0.1, [0.0, 0.0]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
        grid.set(lattice.cell_at([3.05, 2.05]).unwrap(), Occupancy::Occupied);
        // The obstacle begins at x = 3, and covers y from 2 to 2.1.
        for (x, y, expected) in [
            (2.6, 2.05, false),
            (2.76, 2.05, true),
            (2.74, 2.05, false),
            (2.9, 1.76, false),
            (2.9, 1.8, true),
            (0.2, 2.0, true),
            (0.3, 2.0, false),
            (-1.0, 2.0, true),
        ] {
            assert_eq!(touches(&grid, [x, y], 0.25), expected, "at ({x}, {y})");
        }
    }
}
