//! Which cuts are kept: pieces become regions by joining, step by step, the two that are most surely one.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::border::{Border, Pair};
use super::options::CutOptions;

/// How large a set of cells is and how wide.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Extent {
    /// Square metres.
    pub(super) area: f64,
    /// The sum of the clearances of its cells, each times its area, in cubic metres.
    pub(super) volume: f64,
}

impl Extent {
    /// How wide it is: four times the mean clearance, which of a long corridor is its width.
    pub(super) fn width(&self) -> f64 {
        4.0 * self.volume / self.area
    }

    fn add(&mut self, other: Extent) {
        self.area += other.area;
        self.volume += other.volume;
    }
}

/// The logarithm of the odds that a border parts two regions.
pub(super) fn cut_odds(border: &Border, sides: [Extent; 2], options: &CutOptions) -> f64 {
    let [a, b] = sides;
    let open = border.open();
    let open_part = open / (open + border.wall);
    let width = a.width().min(b.width());
    let narrowness = (border.widest(width) + options.rough) / width;
    let smallness = (a.area.min(b.area) / options.room).min(1.0);
    let slenderness = (width / options.room_width).min(1.0);
    options.base - options.walled * open_part.ln() - options.narrow * narrowness.ln()
        + options.small * smallness.ln()
        + options.slender * slenderness.ln()
        + options.free_standing * border.between().ln()
}

/// A border that may go, as it was when it was weighed.
struct Candidate {
    odds: f64,
    pair: Pair,
    ages: [u32; 2],
}

/// The pieces as they join.
struct Merger<'a> {
    options: &'a CutOptions,
    extents: Vec<Extent>,
    /// What borders each piece that is left.
    borders: Vec<BTreeMap<u32, Border>>,
    /// How often each piece has grown.
    ages: Vec<u32>,
    candidates: BinaryHeap<Candidate>,
}

/// What is left of pieces.
pub(super) struct Merged {
    /// For each piece the one that stands for its region.
    pub(super) region_of: Vec<u32>,
    /// For each piece that stands for a region how large that is.
    pub(super) extents: Vec<Extent>,
    /// What lies between regions.
    pub(super) borders: BTreeMap<Pair, Border>,
}

/// Joins pieces as long as there is a border that is no cut by the odds, the least cut first.
pub(super) fn merged(extents: Vec<Extent>, borders: BTreeMap<Pair, Border>, options: &CutOptions) -> Merged {
    let count = extents.len();
    let mut merger = Merger {
        options,
        extents,
        borders: vec![BTreeMap::new(); count],
        ages: vec![0; count],
        candidates: BinaryHeap::new(),
    };
    for ((a, b), border) in borders {
        merger.borders[a as usize].insert(b, border.clone());
        merger.borders[b as usize].insert(a, border);
    }
    (0..count as u32).for_each(|piece| merger.weigh(piece, |other| other > piece));
    let mut region_of: Vec<u32> = (0..count as u32).collect();
    while let Some(Candidate { pair: (kept, gone), ages, odds }) = merger.candidates.pop() {
        if odds > 0.0 {
            break;
        }
        if ages == [kept, gone].map(|piece| merger.ages[piece as usize]) {
            merger.join(kept, gone);
            region_of[gone as usize] = kept;
        }
    }
    // A piece only ever goes to one with a lower number.
    for piece in 0..count {
        region_of[piece] = region_of[region_of[piece] as usize];
    }
    let left = merger.borders.into_iter().enumerate().flat_map(|(a, neighbors)| {
        neighbors.into_iter().map(move |(b, border)| ((a as u32, b), border)).filter(|((a, b), _)| a < b)
    });
    Merged { region_of, extents: merger.extents, borders: left.collect() }
}

impl Merger<'_> {
    /// Makes candidates of the borders of a piece with those neighbors that are asked for.
    fn weigh(&mut self, piece: u32, is_asked: impl Fn(u32) -> bool) {
        for (&other, border) in &self.borders[piece as usize] {
            if border.gaps.is_empty() || !is_asked(other) {
                continue;
            }
            let pair = (piece.min(other), piece.max(other));
            let ends = [pair.0 as usize, pair.1 as usize];
            let odds = cut_odds(border, ends.map(|end| self.extents[end]), self.options);
            self.candidates.push(Candidate { odds, pair, ages: ends.map(|end| self.ages[end]) });
        }
    }

    fn join(&mut self, kept: u32, gone: u32) {
        let gained = self.extents[gone as usize];
        self.extents[kept as usize].add(gained);
        // No age that a candidate has: nothing joins it any more.
        self.ages[gone as usize] = u32::MAX;
        self.ages[kept as usize] += 1;
        for (other, border) in std::mem::take(&mut self.borders[gone as usize]) {
            self.borders[other as usize].remove(&gone);
            if other != kept {
                self.borders[kept as usize].entry(other).or_default().extend(border.clone());
                self.borders[other as usize].entry(kept).or_default().extend(border);
            }
        }
        self.weigh(kept, |_| true);
    }
}

impl Ord for Candidate {
    /// The least odds are the greatest, for that is what the heap gives first; then the lowest numbers.
    fn cmp(&self, other: &Self) -> Ordering {
        other.odds.total_cmp(&self.odds).then(other.pair.cmp(&self.pair)).then(other.ages.cmp(&self.ages))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}
