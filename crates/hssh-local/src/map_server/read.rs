//! Reads maps: a YAML file with its image, or an image alone.

use std::path::Path;

use super::MapError;
use super::description::Description;
use super::image::Encoded;
use crate::grid::{Cell, Lattice, OccupancyGrid};

/// Reads a map of ROS `map_server`: a YAML file and the PGM (P2, P5) or PNG image it names.
///
/// # Errors
/// If a file cannot be read, a field is missing or of the wrong type, the map is turned, or the image
/// is damaged or too large.
pub fn read_map(yaml: &Path) -> Result<OccupancyGrid, MapError> {
    let text = std::fs::read_to_string(yaml).map_err(MapError::io("read", yaml))?;
    let description = Description::parse(yaml, &text)?;
    let image = yaml.parent().unwrap_or(Path::new("")).join(&description.image);
    let bytes = std::fs::read(&image).map_err(|source| MapError::NoImage {
        yaml: yaml.to_owned(),
        image: image.clone(),
        source,
    })?;
    grid(&image, &bytes, &description)
}

/// Reads a floor plan without a YAML file, dark walls on a light floor, in cells of `resolution` metres;
/// its lower left corner is the origin.
///
/// # Errors
/// If the file cannot be read, is no PGM or PNG image, or is too large.
pub fn read_floor_plan(image: &Path, resolution: f64) -> Result<OccupancyGrid, MapError> {
    let bytes = std::fs::read(image).map_err(MapError::io("read", image))?;
    grid(image, &bytes, &Description::of_floor_plan(image, resolution))
}

fn grid(file: &Path, bytes: &[u8], description: &Description) -> Result<OccupancyGrid, MapError> {
    let image = Encoded::open(bytes).map_err(MapError::image(file))?;
    let (width, height) = image.size();
    let [x, y, _] = description.origin;
    let lattice =
        Lattice::new(width, height, description.resolution, [x, y]).map_err(MapError::lattice(file))?;
    let pixels = image.pixels().map_err(MapError::image(file))?;
    let mut grid = OccupancyGrid::filled(lattice, crate::grid::Occupancy::Unknown);
    for (row, pixels) in (0..height).rev().zip(pixels.chunks(width as usize)) {
        for (column, &[gray, opacity]) in (0..).zip(pixels) {
            grid.set(Cell { column, row }, description.occupancy(gray, opacity == 0));
        }
    }
    Ok(grid)
}
