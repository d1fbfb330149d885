//! Occupancy grids as files: the YAML and image pairs of ROS `map_server`, and plain floor plans.

mod description;
mod error;
mod image;
mod read;
#[cfg(test)]
mod tests;
mod turned;
mod write;

pub use error::MapError;
pub use read::{read_floor_plan, read_map, read_map_with_remarks};
pub use write::{encode_png, write_map, write_png};
