//! Topological maps: places, the links between their gateways, and the paths these form (section 2.3).

mod anew;
mod boundaries;
mod growth;
mod path;
mod record;
mod region;
mod sanity;
mod sides;
mod topological_map;

pub use path::Course;
pub use record::Direction;
pub use region::Region;
pub use sides::{BoundaryRelation, PathSides};
pub use topological_map::{PendingGateway, TopologicalMap};
