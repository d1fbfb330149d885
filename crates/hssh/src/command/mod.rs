//! The commands of the program, one per module.

pub(crate) mod check;
pub(crate) mod explain;
pub(crate) mod explore;
pub(crate) mod graph;
pub(crate) mod map;
pub(crate) mod simulate;
mod stages;
pub(crate) mod stars;
