//! How far the walls of a grid that was drawn along a log are from those of the plan.

use hssh_local::{Cell, Occupancy, OccupancyGrid};
use hssh_metrics::Pose;
use nalgebra::vector;

/// A wall no farther from the plan's is where it should be, in metres.
const NEAR: f64 = 0.05;
/// Farther off than this it does not matter how far, in metres.
const FAR: f64 = 0.3;

/// The walls of a grid against those of the plan.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Walls {
    /// Mean distance of the middles of wall cells from the nearest wall of the plan, metres.
    pub(crate) off: f64,
    /// The part of them within [`NEAR`].
    pub(crate) near: f64,
}

impl Walls {
    /// Compares; `placed` is the frame of the grid in that of the plan. `None` if the grid has no walls.
    pub(crate) fn of(grid: &OccupancyGrid, plan: &OccupancyGrid, placed: Pose) -> Option<Self> {
        let walls = grid.lattice().cells().filter(|&cell| grid.get(cell) == Occupancy::Occupied);
        let off: Vec<f64> = walls
            .map(|cell| {
                let [x, y] = grid.lattice().center(cell);
                let point = placed.translation() + placed.rotation() * vector![x, y];
                distance(plan, [point.x, point.y])
            })
            .collect();
        let count = off.len() as f64;
        let near = off.iter().filter(|&&off| off <= NEAR).count() as f64;
        (!off.is_empty()).then(|| Walls { off: off.iter().sum::<f64>() / count, near: near / count })
    }
}

/// From a point to the nearest occupied cell, which is a square.
fn distance(plan: &OccupancyGrid, [x, y]: [f64; 2]) -> f64 {
    let lattice = plan.lattice();
    let Some(here) = lattice.cell_at([x, y]) else { return FAR };
    let reach = (FAR / lattice.resolution()).ceil() as i32;
    let around = (-reach..=reach).flat_map(|u| (-reach..=reach).map(move |v| (u, v)));
    let cells = around.filter_map(|(columns, rows)| lattice.step(here, columns, rows));
    let half = lattice.resolution() / 2.0;
    let off = |cell: Cell| {
        let [u, v] = lattice.center(cell);
        ((x - u).abs() - half).max(0.0).hypot(((y - v).abs() - half).max(0.0))
    };
    cells.filter(|&cell| plan.get(cell) == Occupancy::Occupied).map(off).fold(FAR, f64::min)
}
