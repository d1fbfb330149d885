//! Places along the way: where a neighborhood has other ways out than on and back (section 2.2).
//!
//! A *way out* is a stretch of free space as wide as a robot that leads some metres away from the
//! neighborhood: a corridor, but not a door's room, a niche or a lobby, which end before. Ways out are
//! found by the distance that a robot would have to travel, so that neither clutter nor the shape of a
//! place matters; where their axes meet is the place. Where only one way leads out, and walls are seen all around, the
//! place is a dead end.

mod axis;
mod center;
mod dead_end;
mod geodesic;
mod options;
mod sighting;
mod ways;

pub use options::PlaceOptions;
pub use sighting::{Sighting, sight};
pub use ways::WayOut;
