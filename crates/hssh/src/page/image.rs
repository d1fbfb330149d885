//! Grids as images that a page carries along.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use hssh_local::{OccupancyGrid, encode_png};
use hssh_metrics::Pose;

use super::data::PageImage;

impl PageImage {
    /// A grid in its own frame.
    pub(super) fn of(grid: &OccupancyGrid) -> Self {
        Self::seen_from(grid, Pose::IDENTITY)
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

/// To the millimetre, or the milliradian: a page shows no more.
pub(super) fn rounded(number: f64) -> f64 {
    // Adding 0 makes a 0 of −0.
    (number * 1000.0).round() / 1000.0 + 0.0
}
