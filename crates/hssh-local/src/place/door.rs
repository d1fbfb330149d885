//! Doors: constrictions behind which there is a previously obscured area (section 2.2.2, second definition of
//! gateways).

use super::{DoorOptions, Gateway};
use crate::grid::{Cell, Occupancy, OccupancyGrid};

impl DoorOptions {
    /// Whether a constriction that hides so many square metres is a door.
    #[must_use]
    pub fn accept(&self, constriction: &Gateway, hidden_area: f64) -> bool {
        constriction.width <= self.widest && hidden_area >= self.least_hidden
    }
}

/// Which of some constrictions are doors.
#[must_use]
pub fn doors(grid: &OccupancyGrid, constrictions: &[Gateway], options: &DoorOptions) -> Vec<Gateway> {
    let is_door = |gateway: &&Gateway| options.accept(gateway, hidden_area(grid, gateway, options));
    constrictions.iter().filter(is_door).copied().collect()
}

/// How much a gateway hides: the square metres that are in sight from a point before it or from one behind it, but
/// not from both.
#[must_use]
pub fn hidden_area(grid: &OccupancyGrid, gateway: &Gateway, options: &DoorOptions) -> f64 {
    let (sin, cos) = gateway.bearing.sin_cos();
    let at = |step: f64| [gateway.position[0] + step * cos, gateway.position[1] + step * sin];
    let in_sight = |step: f64| {
        grid.lattice().cell_at(at(step)).map(|from| in_sight(grid, from, options.reach)).unwrap_or_default()
    };
    let (before, behind) = (in_sight(-options.step), in_sight(options.step));
    let shared = before.iter().filter(|cell| behind.binary_search(cell).is_ok()).count();
    let hidden = before.len() + behind.len() - 2 * shared;
    hidden as f64 * grid.lattice().resolution().powi(2)
}

/// The free cells that are in sight from a cell within `reach` metres, in order: those on straight lines of free
/// cells to the circle around it.
fn in_sight(grid: &OccupancyGrid, from: Cell, reach: f64) -> Vec<Cell> {
    let lattice = grid.lattice();
    let radius = (reach / lattice.resolution()).ceil();
    // So many lines that neighbors are a cell apart at their ends.
    let lines = (std::f64::consts::TAU * radius).ceil() as u32;
    let end = |line: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(line) / f64::from(lines)).sin_cos();
        let along = |at: u32, part: f64, count: u32| {
            (f64::from(at) + radius * part).round().clamp(0.0, f64::from(count - 1)) as u32
        };
        Cell { column: along(from.column, cos, lattice.width()), row: along(from.row, sin, lattice.height()) }
    };
    let free =
        |line: u32| lattice.line(from, end(line)).take_while(|&cell| grid.get(cell) == Occupancy::Free);
    let mut cells: Vec<Cell> = (0..lines).flat_map(free).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Lattice;

    /// Two rooms of 5 m by 5 m side by side, with a wall between them that has an opening of 1 m in its middle, or
    /// only two pieces of 0.3 m beside the opening, like the legs of desks.
    fn rooms(with_wall: bool) -> OccupancyGrid {
        let lattice = Lattice::new(104, 54, 0.1, [-5.2, -2.7]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
        for cell in lattice.cells() {
            let [x, y] = lattice.center(cell);
            let is_inside = x.abs() < 5.1 && y.abs() < 2.6;
            let is_between = x.abs() < 0.1 && y.abs() > 0.5 && (with_wall || y.abs() < 0.8);
            if is_inside && !is_between {
                grid.set(cell, Occupancy::Free);
            }
        }
        grid
    }

    #[test]
    fn a_wall_hides_more_than_desks_do() {
        let gateway =
            Gateway { position: [0.0, 0.0], bearing: 0.0, width: 1.0, line: [[0.0, 0.5], [0.0, -0.5]] };
        let options = DoorOptions::default();
        // The rooms are 5 m by 5.2 m. From 1 m before the middle of a wall of 0.2 m, the far edges of the opening, at
        // 1.1 m, limit what is seen through it: it is 1/1.1 as wide as it is far away, up to 5.2 m at 5.72 m, and as
        // wide from there on to the reach of 6 m.
        let seen_through = (5.72_f64.powi(2) - 1.1_f64.powi(2)) / 2.2 + 0.28 * 5.2;
        let expected = 2.0 * (26.0 - seen_through);
        let hidden = hidden_area(&rooms(true), &gateway, &options);
        assert!((hidden - expected).abs() < 1.5, "{hidden} is not about {expected}");
        let between_desks = hidden_area(&rooms(false), &gateway, &options);
        assert!(between_desks < 0.7 * hidden, "{between_desks}");
        let least_hidden = (hidden + between_desks) / 2.0;
        let found =
            |with_wall| doors(&rooms(with_wall), &[gateway], &DoorOptions { least_hidden, ..options });
        assert_eq!((found(true).len(), found(false).len()), (1, 0));
    }
}
