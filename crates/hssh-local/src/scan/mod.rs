//! Laser scans, and those of several lasers as one.

mod around;
mod sweep;

pub use around::scan_around;
pub use sweep::Scan;
