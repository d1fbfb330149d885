//! Reads maps: a YAML file with its image, or an image alone.

use std::path::Path;

use super::MapError;
use super::description::{Description, UNKNOWN_GRAY};
use super::image::Encoded;
use super::turned::turned;
use crate::grid::{Cell, Lattice, LatticeError, Occupancy, OccupancyGrid};

/// Reads a map of ROS `map_server`: a YAML file and the image it names, PGM (P2, P5), PNG, BMP, JPEG, TIFF or WebP. An image
/// that the origin turns comes back as cells along the axes of the map's frame.
///
/// # Errors
/// If a file cannot be read, a field is missing or of the wrong type, or the image
/// is damaged or too large.
pub fn read_map(yaml: &Path) -> Result<OccupancyGrid, MapError> {
    read_map_with_remarks(yaml).map(|(grid, _)| grid)
}

/// The same, with what is read otherwise than the YAML file says.
///
/// # Errors
/// As [`read_map`].
pub fn read_map_with_remarks(yaml: &Path) -> Result<(OccupancyGrid, Vec<String>), MapError> {
    let text = std::fs::read(yaml).map_err(MapError::io("read", yaml))?;
    let description = Description::parse(yaml, &text)?;
    let image = yaml.parent().unwrap_or(Path::new("")).join(&description.image);
    let bytes = std::fs::read(&image).map_err(|source| MapError::NoImage {
        yaml: yaml.to_owned(),
        image: image.clone(),
        source,
    })?;
    let grid = grid(&image, &bytes, &description).map_err(|error| match error {
        MapError::Lattice {
            source: source @ (LatticeError::Resolution(_) | LatticeError::Origin(_)),
            ..
        } => MapError::Lattice { file: yaml.to_owned(), source },
        other => other,
    })?;
    let mut remarks = Vec::new();
    if grid.1 {
        remarks.push(format!(
            "{}: gray {UNKNOWN_GRAY}, which map_saver writes for the unknown, would be free by `free_thresh`; it was \
             read as unknown: write `free_thresh: 0.196`",
            yaml.display()
        ));
    }
    Ok((grid.0, remarks))
}

/// Reads a floor plan without a YAML file, dark walls on a light floor, in cells of `resolution` metres;
/// its lower left corner is the origin.
///
/// # Errors
/// If the file cannot be read, is no such image, or is too large.
pub fn read_floor_plan(image: &Path, resolution: f64) -> Result<OccupancyGrid, MapError> {
    let bytes = std::fs::read(image).map_err(MapError::io("read", image))?;
    grid(image, &bytes, &Description::of_floor_plan(image, resolution)).map(|(grid, _)| grid)
}

/// The grid, and whether the mark of the unknown was read as unknown although it would be free.
fn grid(file: &Path, bytes: &[u8], description: &Description) -> Result<(OccupancyGrid, bool), MapError> {
    let image = Encoded::open(bytes).map_err(MapError::image(file))?;
    let (width, height) = image.size();
    let [x, y, _] = description.origin;
    let lattice =
        Lattice::new(width, height, description.resolution, [x, y]).map_err(MapError::lattice(file))?;
    let pixels = image.pixels().map_err(MapError::image(file))?;
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Unknown);
    let has_marks = description.frees_the_unknown() && marks_the_unknown(&pixels);
    for (row, pixels) in (0..height).rev().zip(pixels.chunks(width as usize)) {
        for (column, &[gray, opacity]) in (0..).zip(pixels) {
            if !(has_marks && gray == UNKNOWN_GRAY) {
                grid.set(Cell { column, row }, description.occupancy(gray, opacity == 0));
            }
        }
    }
    let [_, _, yaw] = description.origin;
    if yaw != 0.0 {
        grid = turned(&grid, yaw).map_err(MapError::lattice(file))?;
    }
    Ok((grid, has_marks))
}

/// Whether an image has nothing but the three grays that `map_saver` writes, white as good as almost white: then the one in
/// the middle means the unknown.
fn marks_the_unknown(pixels: &[[u8; 2]]) -> bool {
    let mut seen = [false; 256];
    for &[gray, _] in pixels {
        seen[usize::from(gray)] = true;
    }
    let is_mark = |gray: usize| gray == 0 || gray == usize::from(UNKNOWN_GRAY) || gray >= 254;
    seen[usize::from(UNKNOWN_GRAY)]
        && (254..=255).any(|gray| seen[gray])
        && (0..256).all(|gray| !seen[gray] || is_mark(gray))
}
