//! A map whose image is turned against its frame, as cells along the axes of the frame.

use crate::grid::{Lattice, LatticeError, Occupancy, OccupancyGrid};

/// Into how many parts each side of a cell is divided to see what lies in it.
const PARTS: u32 = 3;

/// The grid of the frame around an image of which the lower left corner is the origin of `image` and that is turned by `yaw`
/// radians, counterclockwise, around it. A cell in which something occupied lies is occupied, so that no wall gets holes;
/// whatever lies in none of the image's cells is unknown.
///
/// # Errors
/// If the turned image needs too many cells.
pub(super) fn turned(image: &OccupancyGrid, yaw: f64) -> Result<OccupancyGrid, LatticeError> {
    let lattice = image.lattice();
    let ([x, y], side) = (lattice.origin(), lattice.resolution());
    let (sin, cos) = yaw.sin_cos();
    let (width, height) = (f64::from(lattice.width()) * side, f64::from(lattice.height()) * side);
    let corners = [[0.0, 0.0], [width, 0.0], [0.0, height], [width, height]];
    let corners = corners.map(|[along, up]| [x + cos * along - sin * up, y + sin * along + cos * up]);
    let bound = |axis: usize, better: fn(f64, f64) -> f64| {
        corners.iter().map(|corner| corner[axis]).reduce(better).unwrap_or_default()
    };
    let (low, high) = ([bound(0, f64::min), bound(1, f64::min)], [bound(0, f64::max), bound(1, f64::max)]);
    let cells = |axis: usize| ((high[axis] - low[axis]) / side - 1e-6).ceil().max(1.0) as u32;
    let frame = Lattice::new(cells(0), cells(1), side, low)?;
    let mut grid = OccupancyGrid::filled(frame, Occupancy::Unknown);
    for cell in frame.cells() {
        let parts = (0..PARTS * PARTS).filter_map(|part| {
            let inside = |part: u32| (f64::from(part) + 0.5) / f64::from(PARTS);
            let [px, py] = frame.point([
                f64::from(cell.column) + inside(part % PARTS),
                f64::from(cell.row) + inside(part / PARTS),
            ]);
            let (dx, dy) = (px - x, py - y);
            let there = lattice.cell_at([x + cos * dx + sin * dy, y + cos * dy - sin * dx])?;
            Some(image.cells()[lattice.index(there)])
        });
        grid.set(cell, what_lies_in(parts));
    }
    Ok(grid)
}

/// What a cell is in parts of which these lie; the others are unknown.
fn what_lies_in(parts: impl Iterator<Item = Occupancy>) -> Occupancy {
    let (mut free, mut occupied) = (0, 0);
    for part in parts {
        free += u32::from(part == Occupancy::Free);
        occupied += u32::from(part == Occupancy::Occupied);
    }
    match () {
        () if occupied > 0 => Occupancy::Occupied,
        () if 2 * free > PARTS * PARTS => Occupancy::Free,
        () => Occupancy::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::grid::Cell;

    /// A strip of three cells: free, unknown, occupied.
    fn strip() -> OccupancyGrid {
        let lattice = Lattice::new(3, 1, 0.5, [10.0, 20.0]).unwrap();
        OccupancyGrid::new(lattice, vec![Occupancy::Free, Occupancy::Unknown, Occupancy::Occupied]).unwrap()
    }

    /// Quarter turns are exact: what was along x is along y.
    #[test]
    fn quarter_turns_move_cells_and_change_none() {
        for (yaw, origin, is_upward) in [(FRAC_PI_2, [9.5, 20.0], true), (-FRAC_PI_2, [10.0, 18.5], false)] {
            let grid = turned(&strip(), yaw).unwrap();
            assert_eq!((grid.lattice().width(), grid.lattice().height()), (1, 3));
            let off = [0, 1].map(|axis| (grid.lattice().origin()[axis] - origin[axis]).abs());
            assert!(off[0] < 1e-9 && off[1] < 1e-9);
            let mut cells = strip().cells().to_vec();
            if !is_upward {
                cells.reverse();
            }
            assert_eq!(grid.cells(), cells);
        }
    }

    /// A wall turned by any angle still separates its two sides: no free cell touches another across it.
    #[test]
    fn walls_get_no_holes() {
        let lattice = Lattice::new(40, 41, 0.1, [-1.0, 3.0]).unwrap();
        let wall = |cell: Cell| if cell.row == 20 { Occupancy::Occupied } else { Occupancy::Free };
        let image = OccupancyGrid::new(lattice, lattice.cells().map(wall).collect()).unwrap();
        for yaw in [0.1, 0.5, 0.8, 2.0, -1.2, 3.0] {
            let grid = turned(&image, yaw).unwrap();
            let frame = *grid.lattice();
            let side = |cell: Cell| {
                let [x, y] = frame.center(cell);
                yaw.cos() * (y - 3.0) - yaw.sin() * (x + 1.0) > 2.05
            };
            let is_free = |cell: Cell| grid.cells()[frame.index(cell)] == Occupancy::Free;
            let free = frame.cells().filter(|&cell| is_free(cell)).collect::<Vec<_>>();
            assert!(free.len() > 1000, "{yaw}: {}", free.len());
            for cell in free {
                for (columns, rows) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
                    let other = frame.step(cell, columns, rows).filter(|&other| is_free(other));
                    assert!(other.is_none_or(|other| side(cell) == side(other)), "{yaw}: {cell:?}");
                }
            }
        }
    }
}
