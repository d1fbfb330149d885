//! Writes maps as `map_server` reads them, with the gray values of `map_saver`.

use std::path::Path;

use super::{MapError, image};
use crate::grid::{Cell, Occupancy, OccupancyGrid};

/// Writes a grid as a YAML file and, beside it under the same name, a binary PGM image.
///
/// # Errors
/// If a file cannot be written.
pub fn write_map(grid: &OccupancyGrid, yaml: &Path) -> Result<(), MapError> {
    let image_file = yaml.with_extension("pgm");
    let bytes = image::encode_pgm(grid.lattice().width(), grid.lattice().height(), &gray(grid));
    std::fs::write(&image_file, bytes).map_err(MapError::io("write", &image_file))?;
    let name = image_file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let [x, y] = grid.lattice().origin();
    let text = format!(
        "image: {name:?}\nresolution: {:?}\norigin: [{x:?}, {y:?}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        grid.lattice().resolution(),
    );
    std::fs::write(yaml, text).map_err(MapError::io("write", yaml))
}

/// Writes a grid as a PNG image, in the same gray values.
///
/// # Errors
/// If the file cannot be written.
pub fn write_png(grid: &OccupancyGrid, file: &Path) -> Result<(), MapError> {
    std::fs::write(file, encode_png(grid)).map_err(MapError::io("write", file))
}

/// A grid as the bytes of a PNG image, in the same gray values.
#[must_use]
pub fn encode_png(grid: &OccupancyGrid) -> Vec<u8> {
    image::encode_png(grid.lattice().width(), grid.lattice().height(), &gray(grid))
}

/// The grid in gray, the top row first.
fn gray(grid: &OccupancyGrid) -> Vec<u8> {
    let cells = (0..grid.lattice().height())
        .rev()
        .flat_map(|row| (0..grid.lattice().width()).map(move |column| Cell { column, row }));
    let gray = cells.map(|cell| match grid.get(cell) {
        Occupancy::Occupied => 0,
        Occupancy::Unknown => 205,
        Occupancy::Free => 254,
    });
    gray.collect()
}
