//! What a log becomes as files: a trajectory, and the grid of a building.

use std::path::{Path, PathBuf};

use hssh::export::tum_trajectory;
use hssh_local::{OccupancyGrid, encode_png, write_map};
use hssh_metrics::Pose;

use super::{say_written, write_bytes, write_file};
use crate::failure::Failure;

/// Writes when scans were taken and where in TUM form, one line each.
pub(crate) fn write_tum(file: &Path, trajectory: &[(f64, Pose)]) -> Result<(), Failure> {
    write_file(file, &to_tum(trajectory))
}

/// When scans were taken and where, in TUM form; empty without scans.
pub(crate) fn to_tum(trajectory: &[(f64, Pose)]) -> String {
    let poses: Vec<[f64; 4]> =
        trajectory.iter().map(|(time, pose)| [*time, pose.x, pose.y, pose.theta]).collect();
    tum_trajectory(&poses).unwrap_or_default()
}

/// Writes a grid map: for ROS `map_server` if the file ends so, else as PNG.
pub(crate) fn write_grid(file: &Path, grid: &OccupancyGrid) -> Result<(), Failure> {
    if is_yaml(file) {
        write_map(grid, file)?;
        say_written(file);
        Ok(())
    } else {
        write_bytes(file, &encode_png(grid))
    }
}

/// The image that is written beside the YAML file of a grid.
pub(crate) fn grid_image(grid: Option<&Path>) -> Option<PathBuf> {
    grid.filter(|grid| is_yaml(grid)).map(|grid| grid.with_extension("pgm"))
}

fn is_yaml(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending == "yaml" || ending == "yml")
}
