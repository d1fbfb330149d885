//! Writes maps as `map_server` reads them, with the gray values of `map_saver`.

use std::path::Path;

use image::codecs::pnm::{PnmEncoder, PnmSubtype, SampleEncoding};
use image::{ExtendedColorType, GrayImage, ImageEncoder, ImageFormat, Luma};

use super::MapError;
use crate::grid::{Cell, Occupancy, OccupancyGrid};

/// Writes a grid as a YAML file and, beside it under the same name, a binary PGM image.
///
/// # Errors
/// If a file cannot be written.
pub fn write_map(grid: &OccupancyGrid, yaml: &Path) -> Result<(), MapError> {
    let image_file = yaml.with_extension("pgm");
    let pixels = gray(grid);
    let (width, height) = pixels.dimensions();
    let mut bytes = Vec::new();
    PnmEncoder::new(&mut bytes)
        .with_subtype(PnmSubtype::Graymap(SampleEncoding::Binary))
        .write_image(pixels.as_raw(), width, height, ExtendedColorType::L8)
        .map_err(MapError::image(&image_file))?;
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
    let mut bytes = std::io::Cursor::new(Vec::new());
    let done = gray(grid).write_to(&mut bytes, ImageFormat::Png);
    done.expect("an image with at least one pixel is written to memory");
    bytes.into_inner()
}

/// The grid in gray, the top row first.
fn gray(grid: &OccupancyGrid) -> GrayImage {
    let height = grid.lattice().height();
    GrayImage::from_fn(grid.lattice().width(), height, |column, row_from_top| {
        Luma([match grid.get(Cell { column, row: height - 1 - row_from_top }) {
            Occupancy::Occupied => 0,
            Occupancy::Unknown => 205,
            Occupancy::Free => 254,
        }])
    })
}
