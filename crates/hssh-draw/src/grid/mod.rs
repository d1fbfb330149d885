//! Grid maps as pictures: the cells, and over them the medial axis, gateways and stars (section 2.2.2).

mod cells;
mod figure;

pub use figure::{GridPicture, RegionPicture, TOLD_WAY, TRUE_WAY, draw_grid};
