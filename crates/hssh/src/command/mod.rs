//! The commands of the program, one per module.

pub(crate) mod check;
pub(crate) mod explain;
pub(crate) mod map;
