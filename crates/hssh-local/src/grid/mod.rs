//! Occupancy grids: a lattice of square cells, each unknown, free or occupied.

mod lattice;
mod line;
mod occupancy;

pub use lattice::{Cell, Lattice, LatticeError};
pub use line::CellLine;
pub use occupancy::{GridError, Occupancy, OccupancyGrid};
