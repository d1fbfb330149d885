//! Grids as images that a page carries along.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use hssh_local::{Cell, Lattice, Occupancy, OccupancyGrid, encode_png};
use hssh_metrics::Pose;

use super::data::PageImage;

impl PageImage {
    /// A grid in its own frame, as far as anything is known of it.
    pub(super) fn of(grid: &OccupancyGrid) -> Self {
        Self::seen_from(known(grid).as_ref().unwrap_or(grid), Pose::IDENTITY)
    }

    /// A grid in the frame of something that is in it.
    pub(super) fn seen_from(grid: &OccupancyGrid, frame: Pose) -> Self {
        let lattice = grid.lattice();
        let [x, y] = lattice.origin();
        let side = |cells: u32| rounded(f64::from(cells) * lattice.resolution());
        PageImage {
            png: STANDARD.encode(encode_png(grid)),
            x: rounded(x - frame.x),
            y: rounded(y - frame.y),
            width: side(lattice.width()),
            height: side(lattice.height()),
            turn: rounded(-frame.theta),
        }
    }
}

/// The part of a grid that holds all that is known; nothing if that is nothing.
fn known(grid: &OccupancyGrid) -> Option<OccupancyGrid> {
    let lattice = grid.lattice();
    let is_known = |&cell: &Cell| grid.get(cell) != Occupancy::Unknown;
    let columns = || lattice.cells().filter(is_known).map(|cell| cell.column);
    let rows = || lattice.cells().filter(is_known).map(|cell| cell.row);
    let (left, right) = (columns().min()?, columns().max()?);
    let (low, high) = (rows().min()?, rows().max()?);
    let [x, y] = lattice.origin();
    let side = lattice.resolution();
    let origin = [x + f64::from(left) * side, y + f64::from(low) * side];
    let part = Lattice::new(right - left + 1, high - low + 1, side, origin).ok()?;
    let cells =
        part.cells().map(|Cell { column, row }| grid.get(Cell { column: column + left, row: row + low }));
    OccupancyGrid::new(part, cells.collect()).ok()
}

/// To the millimetre, or the milliradian: a page shows no more.
pub(super) fn rounded(number: f64) -> f64 {
    // Adding 0 makes a 0 of −0.
    (number * 1000.0).round() / 1000.0 + 0.0
}
