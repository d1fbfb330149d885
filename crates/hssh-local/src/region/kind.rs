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
    /// Bounded by the end of the map more than by walls: what lies around a building, or the paper that it is drawn on.
    Outside,
    /// Much of its rim was never seen, so that it is not known what it is.
    Unexplored,
}

impl RegionKind {
    /// The kind in a word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            RegionKind::Room => "room",
            RegionKind::Corridor => "corridor",
            RegionKind::Hall => "hall",
            RegionKind::Doorway => "doorway",
            RegionKind::Outside => "outside",
            RegionKind::Unexplored => "unexplored",
        }
    }
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
    /// The part of its rim that is wall. The rest was never looked at, if unknown space is
    /// [`UnknownSpace::Unexplored`](crate::skeleton::UnknownSpace::Unexplored), or the map ends there.
    pub explored: f64,
}

/// What the rim of a region is where it is no wall.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum End {
    /// Nobody looked there.
    Unseen,
    /// The map ends there.
    OfMap,
}

impl Region {
    /// A region of that size, of the rim of which a part is wall; `ends` is what the rest is.
    pub(super) fn new(extent: Extent, explored: f64, ends: End, options: &KindOptions) -> Self {
        let (area, width) = (extent.area, extent.width());
        let is_long = area >= options.elongation * width * width;
        let kind = if ends == End::Unseen && explored < options.explored {
            RegionKind::Unexplored
        } else if ends == End::OfMap && explored < options.inside {
            RegionKind::Outside
        } else if area <= options.doorway {
            RegionKind::Doorway
        } else if is_long && width <= options.widest_corridor {
            RegionKind::Corridor
        } else if area >= options.hall {
            RegionKind::Hall
        } else {
            RegionKind::Room
        };
        Region { kind, area, width, explored }
    }

    /// Takes in another region of its kind.
    pub(super) fn add(&mut self, other: &Region) {
        let area = self.area + other.area;
        let mean = |own: f64, others: f64| (own * self.area + others * other.area) / area;
        (self.width, self.explored) = (mean(self.width, other.width), mean(self.explored, other.explored));
        self.area = area;
    }
}
