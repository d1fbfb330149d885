//! Pieces of free space between its constrictions: a watershed of the clearance.
//!
//! Cells are taken from the widest on. A cell that touches nothing yet begins a basin; where two basins meet is the
//! narrowest point between their widest ones. If it is about as wide as the smaller of the two, there is no
//! constriction, and they become one; else they stay apart, and their border runs through the narrow point.

use crate::disjoint_sets::DisjointSets;
use crate::distance::DistanceField;
use crate::grid::Lattice;

/// The label of a cell that belongs to no piece.
pub(super) const NO_PIECE: u32 = u32::MAX;

/// Ranks per cell of distance by which cells are ordered.
const RANKS: f64 = 4.0;

/// From this squared distance on, ranks are calculated for each cell.
const SHORT: u32 = 1 << 12;

/// Which piece each cell is in.
pub(super) struct Pieces {
    /// By cell, in row-major order.
    pub(super) labels: Vec<u32>,
    /// The index of the widest cell of each piece.
    pub(super) widest: Vec<u32>,
}

/// When two basins are one; lengths in cells.
#[derive(Clone, Copy)]
pub(super) struct Joining {
    /// They are if the narrowest point between them is at least this part of the smaller one's clearance.
    pub(super) as_wide: f64,
    /// They are if the smaller one's clearance is less than this: nothing fits in.
    pub(super) least: f64,
}

/// The basins as they grow.
struct Basins {
    sets: DisjointSets,
    widest: Vec<u32>,
    /// The clearance at the widest cell, in cells.
    peak: Vec<f32>,
}

impl Basins {
    fn add(&mut self, cell: u32, peak: f32) -> u32 {
        self.widest.push(cell);
        self.peak.push(peak);
        self.sets.add()
    }

    /// Joins the basins that meet at a cell with this clearance, where they are one; the joined basin, if there is one,
    /// which the cell belongs to, as its parts hang together by it.
    ///
    /// The smaller a basin, the sooner it is one with another: those that are joined are the smallest, in one basin.
    fn meet(&mut self, met: &mut [u32], clearance: f32, joining: Joining) -> Option<u32> {
        met.sort_unstable_by(|&a, &b| {
            self.peak[b as usize].total_cmp(&self.peak[a as usize]).then(a.cmp(&b))
        });
        let mut joined = None;
        for lower in (1..met.len()).rev() {
            let peak = f64::from(self.peak[met[lower] as usize]);
            let is_one = f64::from(clearance) >= joining.as_wide * peak
                || f64::from(clearance) >= peak - 1.0
                || peak < joining.least;
            if is_one {
                // The narrowest of the wider ones: what is most alike.
                self.sets.join(met[lower], met[lower - 1]);
                joined = Some(met[lower - 1]);
            }
        }
        joined
    }
}

/// Floods the cells that have any clearance.
pub(super) fn flood(field: &DistanceField, joining: Joining) -> Pieces {
    let lattice = field.lattice();
    let mut labels = vec![NO_PIECE; lattice.len()];
    let mut basins = Basins { sets: DisjointSets::default(), widest: Vec::new(), peak: Vec::new() };
    for index in widest_first(field) {
        let index = index as usize;
        let distance = f64::from(field.squared_at(index)).sqrt() as f32 - 0.5;
        let mut met: [u32; 8] = [NO_PIECE; 8];
        let mut count = 0;
        for near in around(lattice, index) {
            let label = labels[near];
            if label == NO_PIECE {
                continue;
            }
            let root = basins.sets.representative(label);
            if !met[..count].contains(&root) {
                met[count] = root;
                count += 1;
            }
        }
        labels[index] = match count {
            0 => basins.add(index as u32, distance),
            1 => met[0],
            _ => basins.meet(&mut met[..count], distance, joining).unwrap_or_else(|| {
                let labeled = around(lattice, index).filter(|&near| labels[near] != NO_PIECE);
                let widest = labeled
                    .map(|near| (field.squared_at(near), basins.sets.representative(labels[near])))
                    .max();
                widest.map_or(NO_PIECE, |(_, basin)| basin)
            }),
        };
    }
    numbered(labels, basins, joining)
}

/// Gives the basins that are left numbers without gaps, in the order of their widest cells.
fn numbered(mut labels: Vec<u32>, mut basins: Basins, joining: Joining) -> Pieces {
    let mut numbers = vec![NO_PIECE; basins.sets.len()];
    let mut widest = Vec::new();
    for (label, number) in numbers.iter_mut().enumerate() {
        if basins.sets.representative(label as u32) == label as u32
            && f64::from(basins.peak[label]) >= joining.least
        {
            *number = widest.len() as u32;
            widest.push(basins.widest[label]);
        }
    }
    for label in &mut labels {
        if *label != NO_PIECE {
            *label = numbers[basins.sets.representative(*label) as usize];
        }
    }
    Pieces { labels, widest }
}

/// The cells that have clearance, those with the most first, then in row-major order (a counting sort).
fn widest_first(field: &DistanceField) -> Vec<u32> {
    let cells = || (0..field.lattice().len()).filter(|&index| field.is_free_at(index));
    let rank_of = |squared: u32| (RANKS * f64::from(squared).sqrt()) as usize;
    // Most distances are short, and a table is faster than a root.
    let short: Vec<usize> = (0..SHORT).map(rank_of).collect();
    let rank = |index: usize| {
        let squared = field.squared_at(index);
        short.get(squared as usize).copied().unwrap_or_else(|| rank_of(squared))
    };
    let mut starts: Vec<usize> = Vec::new();
    for index in cells() {
        let rank = rank(index);
        if starts.len() <= rank {
            starts.resize(rank + 1, 0);
        }
        starts[rank] += 1;
    }
    let mut before = 0;
    for count in starts.iter_mut().rev() {
        before += std::mem::replace(count, before);
    }
    let mut ordered = vec![0; before];
    for index in cells() {
        let start = &mut starts[rank(index)];
        ordered[*start] = index as u32;
        *start += 1;
    }
    ordered
}

/// The indices of the eight cells around one, as far as they are on the lattice.
pub(super) fn around(lattice: &Lattice, index: usize) -> impl Iterator<Item = usize> + use<> {
    // Division of shorter numbers takes half the time.
    let (width, at) = (lattice.width(), index as u32);
    let (column, row) = (at % width, at / width);
    let (has_left, has_right) = (column > 0, column + 1 < width);
    let has_above = row + 1 < lattice.height();
    let width = width as usize;
    let mut near = [0; 8];
    let mut count = 0;
    let mut add = |is_there: bool, position: usize| {
        if is_there {
            near[count] = position;
            count += 1;
        }
    };
    if row > 0 {
        add(has_left, index.wrapping_sub(width + 1));
        add(true, index - width);
        add(has_right, index + 1 - width);
    }
    add(has_left, index.wrapping_sub(1));
    add(has_right, index + 1);
    if has_above {
        add(has_left, index + width - 1);
        add(true, index + width);
        add(has_right, index + width + 1);
    }
    near.into_iter().take(count)
}
