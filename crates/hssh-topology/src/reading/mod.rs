//! Readings: maps that explain an exploration in which perception erred (docs/readings.md).
//!
//! Everything here is stated in that document, number for number. With [`ReadingModel::EXACT`] nothing is left but the recursive
//! step of section 2.3.1.

mod account;
mod chart;
mod matching;
mod model;
mod way;
mod ways;

pub use account::{Account, Underway};
pub use chart::{Chart, ChartEnd, EndRecord, Side};
pub use matching::{Element, Reading, Sight};
pub use model::{ReadingModel, ReadingModelError, Sightings};
pub use way::{Arrival, Hop, Way};
pub use ways::{Anywhere, Whereabouts};
