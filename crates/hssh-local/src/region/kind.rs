//! A region: its number, its kind and its size.

use super::merge::Extent;
use super::options::KindOptions;

/// A region of a map: an index into its list of regions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct RegionNumber(pub u32);

impl RegionNumber {
    /// The region as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a region looks like.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum RegionKind {
    /// As long as it is wide, more or less.
    Room,
    /// Much longer than it is wide.
    Corridor,
    /// A large room.
    Hall,
    /// Between two rooms, and hardly larger than the wall is thick.
    Doorway,
}

/// A part of free space.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// What it looks like.
    pub kind: RegionKind,
    /// Square metres, furniture that stands free included.
    pub area: f64,
    /// How wide it is, in metres: four times the mean clearance, which of a long corridor is its width.
    pub width: f64,
}

impl Region {
    pub(super) fn new(extent: Extent, options: &KindOptions) -> Self {
        let (area, width) = (extent.area, extent.width());
        let is_long = area >= options.elongation * width * width;
        let kind = if area <= options.doorway {
            RegionKind::Doorway
        } else if is_long && width <= options.widest_corridor {
            RegionKind::Corridor
        } else if area >= options.hall {
            RegionKind::Hall
        } else {
            RegionKind::Room
        };
        Region { kind, area, width }
    }
}
