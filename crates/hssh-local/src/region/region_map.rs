//! The regions of a map: all steps from a grid to them.

use rustc_hash::FxHashSet;

use super::border::{self, Border, Gap, Pair};
use super::flood::{self, Joining, NO_PIECE, Pieces};
use super::ground::Ground;
use super::island::Islands;
use super::kind::{Region, RegionKind, RegionNumber};
use super::merge::{self, Extent, Merged};
use super::options::{KindOptions, RegionOptions};
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
    /// The cells of signs, by their indices.
    signs: FxHashSet<usize>,
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
        let mut gaps: Vec<(Pair, Gap)> = borders.iter().flat_map(gaps).collect();
        let mut labels = pieces.labels;
        let explored = rim::explored(&labels, &region_of, &ground, options.narrowest);
        let mut all: Vec<Region> = extents
            .iter()
            .zip(explored)
            .map(|(&extent, explored)| Region::new(extent, explored, ground.end(), &options.kind))
            .collect();
        let region_of = with_one_outside(region_of, &mut all, &mut gaps, &options.kind);
        let mut is_kept = kept(&pieces.widest, &region_of, &gaps, &all, field, options);
        if all.iter().any(|region| region.kind == RegionKind::Outside) {
            relabel(&mut labels, &region_of);
            let walls = border::walls(&labels, &ground, options.thickest_wall);
            for (is_kept, is_apart) in is_kept.iter_mut().zip(apart(&all, &gaps, walls.into_keys())) {
                *is_kept &= !is_apart;
            }
        }
        let mut numbers = vec![NO_PIECE; extents.len()];
        let mut regions = Vec::new();
        for (piece, region) in all.into_iter().enumerate().filter(|&(piece, _)| is_kept[piece]) {
            numbers[piece] = regions.len() as u32;
            regions.push(region);
        }
        numbers = region_of.iter().map(|&region| numbers[region as usize]).collect();
        relabel(&mut labels, &numbers);
        let gaps: Vec<(Pair, Gap)> =
            gaps.into_iter().filter(|((a, b), _)| is_kept[*a as usize] && is_kept[*b as usize]).collect();
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
        let signs = ground.into_signs();
        Ok(RegionMap { lattice: *grid.lattice(), labels, passages_of, signs, regions, passages })
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

    /// Whether the cell with an index is a sign of a plan, and nothing that stands there: the leaf of a door with its arc.
    #[must_use]
    pub fn is_sign(&self, index: usize) -> bool {
        !self.signs.is_empty() && self.signs.contains(&index)
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

/// The pieces that stand for regions, with those outside that lead to one another as one: nothing parts what lies around a building.
fn with_one_outside(
    mut region_of: Vec<u32>,
    regions: &mut [Region],
    gaps: &mut Vec<(Pair, Gap)>,
    options: &KindOptions,
) -> Vec<u32> {
    let mut outside = DisjointSets::singletons(regions.len());
    // Lines beside a plan part the paper; what ends with it and is wide open to the outside is outside as well.
    let is_open = |gap: &Gap| gap.width >= options.widest_door;
    loop {
        let is_outside = |region: u32| regions[region as usize].kind == RegionKind::Outside;
        let is_beside =
            |region: u32| !is_outside(region) && regions[region as usize].explored < options.beside;
        let opens = gaps.iter().filter(|(_, gap)| is_open(gap)).find_map(|&((a, b), _)| {
            let pairs = [(a, b), (b, a)];
            pairs.into_iter().find(|&(one, other)| is_outside(one) && is_beside(other))
        });
        let Some((_, region)) = opens else { break };
        regions[region as usize].kind = RegionKind::Outside;
    }
    // A door may lead from one yard to another.
    for &((a, b), _) in gaps.iter().filter(|(_, gap)| is_open(gap)) {
        if [a, b].iter().all(|&region| regions[region as usize].kind == RegionKind::Outside) {
            let [a, b] = [a, b].map(|region| outside.representative(region));
            outside.join(a.max(b), a.min(b));
        }
    }
    for region in &mut region_of {
        *region = outside.representative(*region);
    }
    for region in 0..regions.len() {
        let kept = outside.representative(region as u32) as usize;
        if kept != region {
            let gone = regions[region].clone();
            regions[kept].add(&gone);
        }
    }
    for ((a, b), _) in gaps.iter_mut() {
        let [one, other] = [*a, *b].map(|region| outside.representative(region));
        (*a, *b) = (one.min(other), one.max(other));
    }
    gaps.retain(|((a, b), _)| a != b);
    region_of
}

/// Gives each piece another label.
fn relabel(labels: &mut [u32], numbers: &[u32]) {
    for label in labels.iter_mut().filter(|label| **label != NO_PIECE) {
        *label = numbers[*label as usize];
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

/// Which regions have no way out, and no wall in common with others that have one: the boxes of a legend beside a plan.
fn apart(regions: &[Region], gaps: &[(Pair, Gap)], walls: impl Iterator<Item = Pair>) -> Vec<bool> {
    let is_outside = |region: u32| regions[region as usize].kind == RegionKind::Outside;
    let mut buildings = DisjointSets::singletons(regions.len());
    let within = gaps.iter().map(|&(pair, _)| pair).chain(walls);
    for (a, b) in within.filter(|&(a, b)| !is_outside(a) && !is_outside(b)) {
        let [a, b] = [a, b].map(|region| buildings.representative(region));
        buildings.join(a.max(b), a.min(b));
    }
    let mut has_passage = vec![false; regions.len()];
    for region in gaps.iter().flat_map(|&((a, b), _)| [a, b]).filter(|&region| !is_outside(region)) {
        has_passage[buildings.representative(region) as usize] = true;
    }
    let has_any = has_passage.contains(&true);
    let mut is_apart = |region: u32| {
        has_any && !is_outside(region) && !has_passage[buildings.representative(region) as usize]
    };
    (0..regions.len() as u32).map(&mut is_apart).collect()
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
