//! What parts free space into regions, and what the regions are.

use serde::{Deserialize, Serialize};

use crate::skeleton::UnknownSpace;

/// How regions are found; lengths in metres, areas in square metres.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RegionOptions {
    /// What unknown cells are. Default: walls.
    pub unknown: UnknownSpace,
    /// Unknown space thinner than this, between what is known, is the edge of a wall. Default: 0.3 m.
    pub rim: f64,
    /// What stands free and is no longer and no wider than this is furniture: it parts no rooms. Default: 0.9 m.
    pub furniture: f64,
    /// Obstacles no farther apart than this are one thing. If it is furniture in a row that is longer, it is a wall that was
    /// seen in pieces. Default: 0.2 m.
    pub apart: f64,
    /// A thing is as good as the walls of the building if it is at least as long or wide as this. Default: 4 m.
    pub island: f64,
    /// Gaps narrower than this join nothing. Default: 0.6 m.
    pub narrowest: f64,
    /// Space that is at least this part as wide as the narrower of the two spaces it lies between is no constriction.
    /// Default: 0.9.
    pub as_wide: f64,
    /// Two pieces share a wall where it is no thicker than this. Default: 0.5 m.
    pub thickest_wall: f64,
    /// What a cut costs and is worth.
    pub cut: CutOptions,
    /// What leaves of doors that stand open look like.
    pub leaf: LeafOptions,
    /// What makes a passage a door.
    pub door: DoorwayOptions,
    /// What kinds of regions there are.
    pub kind: KindOptions,
}

/// When two pieces of free space are two regions: the odds for it are a product of powers of what is measured.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CutOptions {
    /// The logarithm of the odds of an opening without walls beside it, as wide as the space it opens to.
    /// Default: −0.05.
    pub base: f64,
    /// The power of the part of the border that is wall. Default: 2.4.
    pub walled: f64,
    /// The power of how much narrower the opening is than the space on its narrower side. Default: 1.0.
    pub narrow: f64,
    /// Openings count as wider by this: as far as walls are drawn rough, what is narrower there is no constriction.
    /// Default: 0.05 m.
    pub rough: f64,
    /// The power by which the area of the smaller piece counts if it is smaller than [`room`](Self::room): niches
    /// and gaps between furniture are no rooms. Default: 0.35.
    pub small: f64,
    /// The area from which on a piece is as good as a room. Default: 4.7 m².
    pub room: f64,
    /// The power by which the width of the narrower piece counts if it is narrower than
    /// [`room_width`](Self::room_width). Default: 1.2.
    pub slender: f64,
    /// The width from which on a piece is as good as a room. Default: 1.6 m, four times the mean clearance.
    pub room_width: f64,
    /// The power by which the size of the things counts that the opening lies between, the smaller of both, if it is
    /// less than [`island`](RegionOptions::island): what stands free in a room does not part it. Default: 0.75.
    pub free_standing: f64,
}

/// What leaves look like that stand open.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LeafOptions {
    /// They are no shorter than this. Default: 0.55 m.
    pub shortest: f64,
    /// They are no longer than this. Default: 1.3 m.
    pub longest: f64,
    /// The opening is wider or narrower than the leaves that close it by no more than this part of it, and by no more than
    /// one and a half cells more. Default: 0.12.
    pub fits: f64,
    /// They hang no farther from the wall than this. Default: 0.2 m.
    pub apart: f64,
}

/// How probably a passage has a door: the logarithm of the odds is a sum of what is measured, each times a weight.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DoorwayOptions {
    /// What nothing else says. Default: −2.5.
    pub base: f64,
    /// The weight of how narrow the narrower of the two regions is, if it is narrower than
    /// [`room_width`](Self::room_width): there are no doors between desks. Default: 11.
    pub room: f64,
    /// A region that is as wide as this may be a room. Default: 1.5 m, four times the mean clearance.
    pub room_width: f64,
    /// The weight of how much of the line beyond the better end is wall. Default: 5.5.
    pub wall: f64,
    /// The line is followed as far as this. Default: 1.5 m.
    pub beside: f64,
    /// The wall may be off the line by this. Default: 0.1 m.
    pub tolerance: f64,
    /// The weight of how small the smaller of the things is that it lies between, if it is smaller than
    /// [`island`](RegionOptions::island): a leaf hangs in a wall of the building. Default: 3.2.
    pub free_standing: f64,
    /// The weight of each metre that the passage is wider than [`widest_leaf`](Self::widest_leaf). Default: 16.
    pub excess: f64,
    /// The widest leaf that is usual. Default: 0.95 m.
    pub widest_leaf: f64,
    /// The weight of leaves that stand open in it. Default: 1.
    pub leaf: f64,
    /// They hang no farther from the ends of the passage than this. Default: 0.35 m.
    pub hinge: f64,
    /// They are together longer or shorter than the passage is wide by no more than this part of it. Default: 0.25.
    pub leaf_fits: f64,
}

/// What tells the kinds of regions apart.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct KindOptions {
    /// A doorway is no larger than this. Default: 2 m².
    pub doorway: f64,
    /// A corridor is this many times as long as it is wide, at least. Default: 4.
    pub elongation: f64,
    /// A corridor is no wider than this. Default: 4 m.
    pub widest_corridor: f64,
    /// A hall is as large as this, at least. Default: 80 m².
    pub hall: f64,
    /// A region without any way out is one if it is as wide as this: what is narrower is the inside of a thing.
    /// Default: 1.2 m.
    pub narrowest_closed: f64,
    /// Of less than this part of the rim seen, nothing is told. Default: 0.6.
    pub explored: f64,
    /// Where less than this part of the rim is wall, and the map ends at the rest, it is outside. Default: 0.5.
    pub inside: f64,
    /// ... and so it is of less than this part, where it is open to the outside. Default: 0.9.
    pub beside: f64,
    /// It is open to the outside where it is no narrower than this. Default: 1.3 m.
    pub widest_door: f64,
}

impl Default for RegionOptions {
    fn default() -> Self {
        RegionOptions {
            unknown: UnknownSpace::Wall,
            rim: 0.3,
            furniture: 0.9,
            apart: 0.2,
            island: 4.0,
            narrowest: 0.6,
            as_wide: 0.9,
            thickest_wall: 0.5,
            cut: CutOptions::default(),
            leaf: LeafOptions::default(),
            door: DoorwayOptions::default(),
            kind: KindOptions::default(),
        }
    }
}

impl Default for CutOptions {
    fn default() -> Self {
        CutOptions {
            base: -0.05,
            walled: 2.4,
            narrow: 1.0,
            rough: 0.05,
            small: 0.35,
            room: 4.7,
            slender: 1.2,
            room_width: 1.6,
            free_standing: 0.75,
        }
    }
}

impl Default for LeafOptions {
    fn default() -> Self {
        LeafOptions { shortest: 0.55, longest: 1.3, fits: 0.12, apart: 0.2 }
    }
}

impl Default for DoorwayOptions {
    fn default() -> Self {
        DoorwayOptions {
            base: -2.5,
            room: 11.0,
            room_width: 1.5,
            wall: 5.5,
            beside: 1.5,
            tolerance: 0.1,
            free_standing: 3.2,
            excess: 16.0,
            widest_leaf: 0.95,
            leaf: 1.0,
            hinge: 0.35,
            leaf_fits: 0.25,
        }
    }
}

impl Default for KindOptions {
    fn default() -> Self {
        KindOptions {
            doorway: 2.0,
            elongation: 4.0,
            widest_corridor: 4.0,
            hall: 80.0,
            narrowest_closed: 1.2,
            explored: 0.6,
            inside: 0.5,
            beside: 0.9,
            widest_door: 1.3,
        }
    }
}
