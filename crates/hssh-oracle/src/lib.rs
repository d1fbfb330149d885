//! A naive reference mapper, for tests only: it shares no code with the mapper it checks.
//!
//! It is written to be obviously right rather than fast. A [`Map`] is a list of places and a list
//! of links, copied for every successor, and every property of it is recomputed from its definition
//! whenever it is asked for. Of the mapper's own crates it uses nothing but the plain data: an
//! exploration, and the list of ends that a star is.

mod axiom;
mod embedding;
mod enumeration;
mod facts;
mod map;
mod path;
mod reading;
mod star;
mod step;

pub use axiom::{Axiom, Rules};
pub use embedding::RotationSystem;
pub use enumeration::{Enumeration, Expansion, FinalMap, Level, enumerate};
pub use facts::{Facts, Value};
pub use map::{End, Map};
pub use path::Path;
pub use reading::{ReadHypothesis, ReadingModel, enumerate_readings};
pub use step::{Node, Step};
