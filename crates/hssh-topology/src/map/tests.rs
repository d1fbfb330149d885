//! Maps against recounting from scratch.
