//! Where the robot went: the cells near to its way, without the islands between lanes of one way.

use hssh_metrics::Pose;

use super::options::RouteOptions;
use crate::geodesic::Geodesic;
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};

/// The travelled cells of a building, free, and all others, occupied.
pub(super) fn travelled(building: &OccupancyGrid, poses: &[Pose], options: &RouteOptions) -> OccupancyGrid {
    let lattice = *building.lattice();
    let way = cells_along(&lattice, poses);
    let is_free = |cell: Cell| building.get(cell) != Occupancy::Occupied;
    let near = Geodesic::from_nearest(&lattice, &way, options.lane, is_free);
    let known = |cell: Cell| if near.nearest(cell).is_some() { Occupancy::Free } else { Occupancy::Occupied };
    let mut grid = OccupancyGrid::new(lattice, lattice.cells().map(known).collect())
        .expect("there is one cell for each");
    fill_islands(&mut grid, building, options);
    grid
}

/// The cells that the robot's middle went through.
fn cells_along(lattice: &Lattice, poses: &[Pose]) -> Vec<Cell> {
    let cells: Vec<Cell> = poses.iter().filter_map(|pose| lattice.cell_at([pose.x, pose.y])).collect();
    let mut along: Vec<Cell> = cells.first().copied().into_iter().collect();
    for pair in cells.windows(2) {
        along.extend(lattice.line(pair[0], pair[1]));
    }
    along
}

/// Islands are what is enclosed by travelled cells: those without much in them only part lanes.
fn fill_islands(grid: &mut OccupancyGrid, building: &OccupancyGrid, options: &RouteOptions) {
    let lattice = *grid.lattice();
    let area = lattice.resolution().powi(2);
    let mut is_seen = vec![false; lattice.len()];
    for start in lattice.cells() {
        if is_seen[lattice.index(start)] || grid.get(start) == Occupancy::Free {
            continue;
        }
        is_seen[lattice.index(start)] = true;
        let mut island = vec![start];
        let mut at = 0;
        while at < island.len() {
            for next in lattice.side_neighbors(island[at]) {
                if !is_seen[lattice.index(next)] && grid.get(next) != Occupancy::Free {
                    is_seen[lattice.index(next)] = true;
                    island.push(next);
                }
            }
            at += 1;
        }
        let is_border = |cell: &Cell| {
            cell.column == 0
                || cell.row == 0
                || cell.column + 1 == lattice.width()
                || cell.row + 1 == lattice.height()
        };
        let walls = island.iter().filter(|&&cell| building.get(cell) == Occupancy::Occupied).count();
        let unseen = island.iter().filter(|&&cell| building.get(cell) == Occupancy::Unknown).count();
        let is_small = (island.len() as f64) * area < options.island;
        let is_empty = (walls as f64) * area < options.island_walls && 4 * unseen < island.len();
        if (is_small || is_empty) && !island.iter().any(is_border) {
            island.into_iter().for_each(|cell| grid.set(cell, Occupancy::Free));
        }
    }
}
