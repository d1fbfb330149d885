//! Regions: free space parted into rooms, corridors and halls, with the passages between them (section 2.1.3).
//!
//! What is drawn or was seen is first [settled](ground): the gray rims of walls are walls, and what stands free and is
//! small is furniture. Then free space is [flooded](flood) into pieces that are parted by every constriction, and the
//! pieces are [merged](merge) again where a cut is not worth it, by one measure of [all that lies between](border).

mod border;
mod flood;
mod ground;
mod merge;
mod options;
mod passage;

use flood::{Joining, NO_PIECE, Pieces};
use merge::Extent;

use crate::grid::{Cell, Lattice, OccupancyGrid};
use crate::place::PlaceGraphError;
use crate::skeleton::{FreeSpace, SkeletonOptions};

pub use options::{CutOptions, KindOptions, RegionOptions};
pub use passage::Passage;

/// A region of a map: an index into [`RegionMap::regions`].
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

/// The regions of a map.
#[derive(Clone, Debug)]
pub struct RegionMap {
    lattice: Lattice,
    labels: Vec<u32>,
    /// The regions.
    pub regions: Vec<Region>,
    /// Where they lead to one another.
    pub passages: Vec<Passage>,
}

impl RegionMap {
    /// Finds the regions of a map.
    ///
    /// # Errors
    /// If nothing of the grid is known or free, or nothing is wide enough.
    pub fn new(grid: &OccupancyGrid, options: &RegionOptions) -> Result<Self, PlaceGraphError> {
        let ground = ground::settled(grid, options.rim);
        let clearing = SkeletonOptions {
            unknown: options.unknown,
            clutter: options.furniture,
            narrowest_passage: options.narrowest,
            ..SkeletonOptions::default()
        };
        let free = FreeSpace::new(&ground, &clearing);
        if free.is_empty() {
            return Err(PlaceGraphError::of(grid, &free, options.narrowest));
        }
        let field = free.field();
        let lattice = *grid.lattice();
        let joining =
            Joining { as_wide: options.as_wide, least: options.narrowest / 2.0 / lattice.resolution() };
        let Pieces { mut labels, widest } = flood::flood(field, joining);
        let extents = extents(&labels, &free, widest.len());
        let borders = border::borders(&labels, field, options.thickest_wall);
        let (regions, borders) = merge::merged(extents, borders, &options.cut);
        for label in labels.iter_mut().filter(|label| **label != NO_PIECE) {
            *label = regions[*label as usize];
        }
        let extents = self::extents(&labels, &free, widest.len());
        let mut peaks = vec![0.0_f64; widest.len()];
        for (piece, &cell) in widest.iter().enumerate() {
            let peak = &mut peaks[regions[piece] as usize];
            *peak = peak.max(field.clearance_at(cell as usize));
        }
        let mut is_open = vec![false; widest.len()];
        let gaps =
            || borders.iter().flat_map(|(&(a, b), border)| border.gaps.iter().map(move |gap| ([a, b], gap)));
        let passable = |gap: &border::Gap| gap.width >= options.narrowest;
        for ([a, b], _) in gaps().filter(|(_, gap)| passable(gap)) {
            (is_open[a as usize], is_open[b as usize]) = (true, true);
        }
        let mut numbers = vec![NO_PIECE; widest.len()];
        let mut kept = Vec::new();
        for piece in 0..widest.len() {
            let is_one = regions[piece] == piece as u32
                && (is_open[piece] || 2.0 * peaks[piece] >= options.kind.narrowest_closed);
            if is_one {
                numbers[piece] = kept.len() as u32;
                kept.push(Region::new(extents[piece], &options.kind));
            }
        }
        for label in labels.iter_mut().filter(|label| **label != NO_PIECE) {
            *label = numbers[*label as usize];
        }
        let passages = gaps()
            .filter(|(_, gap)| passable(gap))
            .map(|(pair, gap)| {
                passage::passage(gap, pair.map(|piece| numbers[piece as usize]), &labels, field)
            })
            .collect();
        Ok(RegionMap { lattice, labels, regions: kept, passages })
    }

    /// Where the cells are.
    #[must_use]
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The region of a cell, if it is in any.
    #[must_use]
    pub fn region_of(&self, cell: Cell) -> Option<RegionNumber> {
        let label = self.labels[self.lattice.index(cell)];
        (label != NO_PIECE).then_some(RegionNumber(label))
    }

    /// The region at a point in metres, if it is in any.
    #[must_use]
    pub fn region_at(&self, point: [f64; 2]) -> Option<RegionNumber> {
        self.region_of(self.lattice.cell_at(point)?)
    }

    /// A region.
    #[must_use]
    pub fn region(&self, region: RegionNumber) -> &Region {
        &self.regions[region.index()]
    }
}

impl Region {
    fn new(extent: Extent, options: &KindOptions) -> Self {
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

/// How large the pieces are and how wide.
fn extents(labels: &[u32], free: &FreeSpace, pieces: usize) -> Vec<Extent> {
    let cell = free.field().lattice().resolution().powi(2);
    let mut extents = vec![Extent::default(); pieces];
    for (index, &label) in labels.iter().enumerate() {
        if label != NO_PIECE {
            let extent = &mut extents[label as usize];
            extent.area += cell;
            extent.volume += cell * free.field().clearance_at(index);
        }
    }
    extents
}
