//! Maps of explorations in which perception erred (docs/readings.md): the same engine, with accounts for hypotheses.

mod by_reading;
mod corrected;
mod geometry;
mod packed;
mod reader;
mod state;

pub use corrected::{Corrected, Correction};
pub use reader::{ReadAnswer, ReadMap, Reader};
pub use state::Passage;
