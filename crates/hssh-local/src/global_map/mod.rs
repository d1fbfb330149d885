//! The global metrical map: local knowledge put together in one frame once the topological map says which
//! visits were to the same place (section 2.1.4).

mod compare;
mod draw;
mod frames;
mod stay;

pub use compare::mean_wall_distance;
pub use draw::{building_map, global_map, global_poses};
pub use frames::visit_frames;
pub use stay::{Stay, stays};
