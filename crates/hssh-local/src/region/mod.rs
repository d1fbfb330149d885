//! Regions: free space parted into rooms, corridors and halls, with the passages between them (section 2.1.3).
//!
//! What is drawn or was seen is first [settled](ground): the gray rims of walls are walls, and what stands free and is
//! small is furniture. Then free space is [flooded](flood) into pieces that are parted by every constriction, and the
//! pieces are [merged](merge) again where a cut is not worth it, by one measure of [all that lies between](border).

mod arc;
mod bits;
mod border;
mod door;
#[cfg(test)]
mod drawing_tests;
mod flood;
mod frame;
mod ground;
mod hollow;
mod island;
mod kind;
mod leaf;
mod lettering;
mod merge;
mod options;
mod outline;
mod passage;
mod picture;
mod raster;
mod region_map;
mod rim;
mod sign;
mod sweep;
#[cfg(test)]
mod tests;
mod thing;

pub use ground::without_rims;
pub use kind::{Region, RegionKind, RegionNumber};
pub use options::{CutOptions, DoorwayOptions, KindOptions, LeafOptions, RegionOptions};
pub use outline::Outline;
pub use passage::Passage;
pub use region_map::RegionMap;
