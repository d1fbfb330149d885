//! The regions of a map: all steps from a grid to them.

use super::border::{self, Border, Gap, Pair};
use super::flood::{self, Joining, NO_PIECE, Pieces};
use super::kind::{Region, RegionNumber};
use super::merge::{self, Extent, Merged};
use super::options::RegionOptions;
use super::outline::{self, Outline};
use super::passage::{self, Passage};
use super::{door, ground};
use crate::grid::{Cell, Lattice, OccupancyGrid};
use crate::place::PlaceGraphError;
use crate::skeleton::{FreeSpace, SkeletonOptions};

/// The regions of a map.
#[derive(Clone, Debug)]
pub struct RegionMap {
    pub(super) lattice: Lattice,
    labels: Vec<u32>,
    /// The passages of each region.
    passages_of: Vec<Vec<u32>>,
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
        let least = options.narrowest / 2.0 / grid.lattice().resolution();
        let pieces = flood::flood(field, Joining { as_wide: options.as_wide, least });
        let extents = extents(&pieces, &free);
        let borders = border::borders(&pieces.labels, field, options.thickest_wall);
        let Merged { region_of, extents, borders } = merge::merged(extents, borders, &options.cut);
        let gaps = |(&pair, border): (&Pair, &'_ Border)| {
            let passable = border.gaps.iter().filter(|gap| gap.width >= options.narrowest).copied();
            passable.map(move |gap| (pair, gap)).collect::<Vec<_>>()
        };
        let gaps: Vec<(Pair, Gap)> = borders.iter().flat_map(gaps).collect();
        let mut leads_on = vec![false; extents.len()];
        for &((a, b), _) in &gaps {
            (leads_on[a as usize], leads_on[b as usize]) = (true, true);
        }
        let mut widest = vec![0.0_f64; extents.len()];
        for (&cell, &region) in pieces.widest.iter().zip(&region_of) {
            widest[region as usize] = widest[region as usize].max(2.0 * field.clearance_at(cell as usize));
        }
        let is_kept = |piece: usize| leads_on[piece] || widest[piece] >= options.kind.narrowest_closed;
        let mut numbers = vec![NO_PIECE; extents.len()];
        let mut regions = Vec::new();
        for piece in (0..extents.len() as u32).filter(|&piece| region_of[piece as usize] == piece) {
            if is_kept(piece as usize) {
                numbers[piece as usize] = regions.len() as u32;
                regions.push(Region::new(extents[piece as usize], &options.kind));
            }
        }
        let mut labels = pieces.labels;
        for label in labels.iter_mut().filter(|label| **label != NO_PIECE) {
            *label = numbers[region_of[*label as usize] as usize];
        }
        let passage = |&((a, b), gap): &(Pair, Gap)| {
            let pair = [a, b].map(|piece| numbers[piece as usize]);
            let gateway = passage::gateway_of(&gap, pair, &labels, field);
            let narrower =
                pair.map(|number| regions[number as usize].width).into_iter().fold(f64::MAX, f64::min);
            let door_probability = door::door_probability(&gateway, narrower, field, &options.door);
            Passage { regions: pair.map(RegionNumber), gateway, door_probability }
        };
        let passages: Vec<Passage> = gaps.iter().map(passage).collect();
        let mut passages_of = vec![Vec::new(); regions.len()];
        for (number, passage) in passages.iter().enumerate() {
            passage.regions.iter().for_each(|region| passages_of[region.index()].push(number as u32));
        }
        Ok(RegionMap { lattice: *grid.lattice(), labels, passages_of, regions, passages })
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

    /// The outlines of all regions, straightened where they move by no more than a cell.
    #[must_use]
    pub fn outlines(&self) -> Vec<Outline> {
        outline::outlines(&self.labels, &self.lattice, self.regions.len(), self.lattice.resolution())
    }

    /// The passages of a region, by their indices.
    pub fn passages_of(&self, region: RegionNumber) -> impl Iterator<Item = u32> {
        self.passages_of[region.index()].iter().copied()
    }

    /// A region.
    #[must_use]
    pub fn region(&self, region: RegionNumber) -> &Region {
        &self.regions[region.index()]
    }
}

/// How large the pieces are and how wide.
fn extents(pieces: &Pieces, free: &FreeSpace) -> Vec<Extent> {
    let cell = free.field().lattice().resolution().powi(2);
    let mut extents = vec![Extent::default(); pieces.widest.len()];
    for (index, &label) in pieces.labels.iter().enumerate() {
        if label != NO_PIECE {
            let extent = &mut extents[label as usize];
            extent.area += cell;
            extent.volume += cell * free.field().clearance_at(index);
        }
    }
    extents
}
