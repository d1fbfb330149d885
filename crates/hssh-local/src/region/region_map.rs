//! The regions of a map: all steps from a grid to them.

use super::border::{self, Border, Gap, Pair};
use super::flood::{self, Joining, NO_PIECE, Pieces};
use super::ground::Ground;
use super::island::Islands;
use super::kind::{Region, RegionKind, RegionNumber};
use super::merge::{self, Extent, Merged};
use super::options::RegionOptions;
use super::outline::{self, Outline};
use super::passage::{self, Passage};
use super::{door, rim};
use crate::disjoint_sets::DisjointSets;
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice, OccupancyGrid};
use crate::place::PlaceGraphError;

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
        let ground = Ground::new(grid, options);
        let field = ground.field();
        let least = options.narrowest / 2.0 / grid.lattice().resolution();
        if !is_any_as_wide(field, options.narrowest / 2.0) {
            return Err(PlaceGraphError::of(grid, field, options.narrowest));
        }
        let pieces = flood::flood(field, Joining { as_wide: options.as_wide, least });
        let extents = extents(&pieces, field);
        let mut islands = Islands::new(&ground, options);
        let borders = border::borders(&pieces.labels, &ground, &mut islands, options);
        let Merged { region_of, extents, borders } = merge::merged(extents, borders, &options.cut);
        let gaps = |(&pair, border): (&Pair, &'_ Border)| {
            let passable = border.gaps.iter().filter(|gap| gap.width >= options.narrowest).copied();
            passable.map(move |gap| (pair, gap)).collect::<Vec<_>>()
        };
        let gaps: Vec<(Pair, Gap)> = borders.iter().flat_map(gaps).collect();
        let mut labels = pieces.labels;
        let explored = rim::explored(&labels, &region_of, &ground, options.narrowest);
        let all: Vec<Region> = extents
            .iter()
            .zip(explored)
            .map(|(&extent, explored)| Region::new(extent, explored, ground.end(), &options.kind))
            .collect();
        let is_kept = kept(&pieces.widest, &region_of, &gaps, &all, field, options);
        let mut numbers = vec![NO_PIECE; extents.len()];
        let mut regions = Vec::new();
        for (piece, region) in all.into_iter().enumerate().filter(|&(piece, _)| is_kept[piece]) {
            numbers[piece] = regions.len() as u32;
            regions.push(region);
        }
        for label in labels.iter_mut().filter(|label| **label != NO_PIECE) {
            *label = numbers[region_of[*label as usize] as usize];
        }
        let gaps: Vec<(Pair, Gap)> = gaps.into_iter().filter(|((a, _), _)| is_kept[*a as usize]).collect();
        let mut passage = |&((a, b), gap): &(Pair, Gap)| {
            let pair = [a, b].map(|piece| numbers[piece as usize]);
            let gateway = passage::gateway_of(&gap, pair, &labels, field);
            let narrower =
                pair.map(|number| regions[number as usize].width).into_iter().fold(f64::MAX, f64::min);
            let door_probability =
                door::door_probability(&gateway, narrower, &ground, &mut islands, &options.door);
            Passage { regions: pair.map(RegionNumber), gateway, door_probability }
        };
        let passages: Vec<Passage> = gaps.iter().map(&mut passage).collect();
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

/// Whether a robot of a radius in metres fits in anywhere, where there are obstacles.
fn is_any_as_wide(field: &DistanceField, radius: f64) -> bool {
    (0..field.lattice().len()).any(|index| field.is_free_at(index) && field.clearance_at(index) >= radius)
}

/// Of the pieces that stand for a region, which are regions: they lead on, or are wide enough to be more than the inside of
/// a thing; and they are no paper around a building.
fn kept(
    widest: &[u32],
    region_of: &[u32],
    gaps: &[(Pair, Gap)],
    regions: &[Region],
    field: &DistanceField,
    options: &RegionOptions,
) -> Vec<bool> {
    let mut is_kept = vec![false; region_of.len()];
    for &((a, b), _) in gaps {
        (is_kept[a as usize], is_kept[b as usize]) = (true, true);
    }
    for (&cell, &region) in widest.iter().zip(region_of) {
        is_kept[region as usize] |= 2.0 * field.clearance_at(cell as usize) >= options.kind.narrowest_closed;
    }
    for (is_kept, is_paper) in is_kept.iter_mut().zip(paper(regions, gaps)) {
        *is_kept &= !is_paper;
    }
    is_kept
}

/// Which regions are outside with all that they lead to, beside a building that has passages inside.
fn paper(regions: &[Region], gaps: &[(Pair, Gap)]) -> Vec<bool> {
    let mut building = DisjointSets::singletons(regions.len());
    for &((a, b), _) in gaps {
        let [a, b] = [a, b].map(|region| building.representative(region));
        building.join(a.max(b), a.min(b));
    }
    let mut has_inside = vec![false; regions.len()];
    for (number, region) in (0..).zip(regions) {
        has_inside[building.representative(number) as usize] |= region.kind != RegionKind::Outside;
    }
    let is_inside =
        |region: u32, building: &mut DisjointSets| has_inside[building.representative(region) as usize];
    let has_passages = gaps.iter().any(|&((a, _), _)| is_inside(a, &mut building));
    (0..regions.len() as u32).map(|region| has_passages && !is_inside(region, &mut building)).collect()
}

/// How large the pieces are and how wide.
fn extents(pieces: &Pieces, field: &DistanceField) -> Vec<Extent> {
    let cell = field.lattice().resolution().powi(2);
    let mut extents = vec![Extent::default(); pieces.widest.len()];
    for (index, &label) in pieces.labels.iter().enumerate() {
        if label != NO_PIECE {
            let extent = &mut extents[label as usize];
            extent.area += cell;
            extent.volume += cell * field.clearance_at(index);
        }
    }
    extents
}
