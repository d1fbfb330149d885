//! The place around a point: ways out are free space that leads on.
//!
//! A *way out* is a stretch of free space as wide as a robot that leads some metres away from the
//! neighborhood: a corridor, but not a door's room, a niche or a lobby, which end before. Ways out are
//! found by the distance that a robot would have to travel, so that neither clutter nor the shape of a
//! place matters; where their axes meet is the place. Where only one way leads out, and walls are seen all around, the
//! place is a dead end.

mod axis;
mod center;
mod dead_end;
mod sight;
mod ways;

pub use sight::{Sighting, sight};
