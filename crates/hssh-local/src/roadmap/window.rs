//! The cells of one region in a window of their own, as far as a robot fits into them.

use super::options::RoadmapOptions;
use crate::distance::DistanceField;
use crate::grid::Cell;
use crate::region::{RegionMap, RegionNumber};

/// The least and the greatest column and row of the cells of a region.
pub(super) type Bounds = [Cell; 2];

/// The bounds of all regions.
pub(super) fn bounds(map: &RegionMap) -> Vec<Bounds> {
    let nothing = [Cell { column: u32::MAX, row: u32::MAX }, Cell { column: 0, row: 0 }];
    let mut bounds = vec![nothing; map.regions.len()];
    for cell in map.lattice().cells() {
        if let Some(region) = map.region_of(cell) {
            let [low, high] = &mut bounds[region.index()];
            *low = Cell { column: low.column.min(cell.column), row: low.row.min(cell.row) };
            *high = Cell { column: high.column.max(cell.column), row: high.row.max(cell.row) };
        }
    }
    bounds
}

/// The cost of a step straight on and across a corner where there is comfortable room.
const STRAIGHT: f64 = 5.0;
const DIAGONAL: f64 = 7.0;
/// How many times that a step costs at most.
const DEAREST: f64 = 12.0;

/// A window on one region, with a frame of one cell where no robot fits in.
pub(super) struct Window {
    /// The cell at the first position within the frame.
    low: Cell,
    width: usize,
    /// The clearance of each cell that a robot fits into, in metres; 0 of others.
    clearance: Vec<f32>,
    /// What a step costs to each cell that a robot fits into, straight on and across a corner.
    costs: Vec<[u8; 2]>,
    /// Which cells are in the region, and not beyond one of its passages.
    is_own: Vec<bool>,
}

impl Window {
    /// The window on a region: its cells, and those within `beyond` metres of the points where it leads on.
    pub(super) fn new(
        map: &RegionMap,
        region: RegionNumber,
        [low, high]: Bounds,
        field: &DistanceField,
        exits: &[Cell],
        options: &RoadmapOptions,
    ) -> Self {
        let lattice = map.lattice();
        let beyond = (2.0 * options.radius / lattice.resolution()).ceil() as u32 + 1;
        let low = Cell { column: low.column.saturating_sub(beyond), row: low.row.saturating_sub(beyond) };
        let high = Cell {
            column: (high.column + beyond).min(lattice.width() - 1),
            row: (high.row + beyond).min(lattice.height() - 1),
        };
        let (width, height) = ((high.column - low.column) as usize + 3, (high.row - low.row) as usize + 3);
        let len = width * height;
        let (clearance, costs, is_own) = (vec![0.0; len], vec![[0; 2]; len], vec![false; len]);
        let mut window = Window { low, width, clearance, costs, is_own };
        let look = |window: &mut Window, cell: Cell, position: usize| {
            let clearance = field.clearance(cell).min(1e6);
            if clearance >= options.radius {
                let clearance = clearance as f32;
                let dearness = (options.comfort / f64::from(clearance)).clamp(1.0, DEAREST);
                window.costs[position] = [STRAIGHT, DIAGONAL].map(|step| (step * dearness).round() as u8);
                window.clearance[position] = clearance;
            }
        };
        for row in low.row..=high.row {
            for column in low.column..=high.column {
                let cell = Cell { column, row };
                if map.region_of(cell) == Some(region) {
                    let position = window.position(cell);
                    look(&mut window, cell, position);
                    window.is_own[position] = true;
                }
            }
        }
        for exit in exits {
            for row in exit.row.saturating_sub(beyond)..=exit.row + beyond {
                for column in exit.column.saturating_sub(beyond)..=exit.column + beyond {
                    let cell = Cell { column, row };
                    if window.contains(cell) {
                        let position = window.position(cell);
                        look(&mut window, cell, position);
                    }
                }
            }
        }
        window
    }

    fn contains(&self, cell: Cell) -> bool {
        let (column, row) = (cell.column.wrapping_sub(self.low.column), cell.row.wrapping_sub(self.low.row));
        (column as usize) < self.width - 2 && (row as usize) < self.len() / self.width - 2
    }

    /// The position of a cell in the window; it must be in it.
    pub(super) fn position(&self, cell: Cell) -> usize {
        (cell.row - self.low.row + 1) as usize * self.width + (cell.column - self.low.column + 1) as usize
    }

    /// The cell at a position within the frame.
    pub(super) fn cell(&self, position: usize) -> Cell {
        Cell {
            column: self.low.column + (position % self.width) as u32 - 1,
            row: self.low.row + (position / self.width) as u32 - 1,
        }
    }

    /// How many positions there are.
    pub(super) fn len(&self) -> usize {
        self.clearance.len()
    }

    /// The clearance at a position where a robot fits in, else 0.
    pub(super) fn clearance(&self, position: usize) -> f32 {
        self.clearance[position]
    }

    /// The eight positions around one at which a robot fits in; it must be within the frame.
    pub(super) fn around(&self, position: usize) -> impl Iterator<Item = usize> {
        let (below, above) = (position - self.width, position + self.width);
        let around = [below - 1, below, below + 1, position - 1, position + 1, above - 1, above, above + 1];
        around.into_iter().filter(|&near| self.clearance[near] > 0.0)
    }

    /// The same, each with the cost of the step there.
    pub(super) fn steps(&self, position: usize) -> impl Iterator<Item = (usize, u32)> {
        let (below, above) = (position - self.width, position + self.width);
        let straight = [below, position - 1, position + 1, above].map(|near| (near, 0));
        let diagonal = [below - 1, below + 1, above - 1, above + 1].map(|near| (near, 1));
        let steps = straight.into_iter().chain(diagonal);
        steps.map(|(near, kind)| (near, u32::from(self.costs[near][kind]))).filter(|&(_, cost)| cost > 0)
    }

    /// Positions in the region as wide as `least` metres, so many that each such position is within `spacing` cells of one of them or
    /// of one of those given; the widest first.
    pub(super) fn waypoints(&self, given: &[usize], spacing: usize, least: f32) -> Vec<usize> {
        // By position, the last of all that cover it, counted from 1.
        let mut covered = vec![0; self.len()];
        let mut count = 0;
        for &position in given {
            count += 1;
            self.cover(position, spacing, count, &mut covered);
        }
        let mut wide: Vec<usize> =
            (0..self.len()).filter(|&at| self.is_own[at] && self.clearance[at] >= least).collect();
        wide.sort_by(|&a, &b| self.clearance[b].total_cmp(&self.clearance[a]).then(a.cmp(&b)));
        let mut found = Vec::new();
        for position in wide {
            if covered[position] == 0 {
                count += 1;
                self.cover(position, spacing, count, &mut covered);
                found.push(position);
            }
        }
        found
    }

    /// Marks what is within so many steps of a position with a number that nothing is marked with yet.
    fn cover(&self, start: usize, steps: usize, number: u32, covered: &mut [u32]) {
        covered[start] = number;
        let mut rim = vec![start];
        for _ in 0..steps {
            let mut next = Vec::new();
            for position in rim {
                for near in self.around(position) {
                    if std::mem::replace(&mut covered[near], number) != number {
                        next.push(near);
                    }
                }
            }
            rim = next;
        }
    }

    /// The widest position in the region, in the largest connected part, the one nearest to the middle of it where several are.
    pub(super) fn middle(&self, comfort: f64) -> Option<usize> {
        let largest = self.largest_part()?;
        let count = largest.len() as f64;
        let sum = largest
            .iter()
            .map(|&position| self.cell(position))
            .fold([0.0, 0.0], |sum, cell| [sum[0] + f64::from(cell.column), sum[1] + f64::from(cell.row)]);
        let mean = sum.map(|sum| sum / count);
        let off = |position: usize| {
            let cell = self.cell(position);
            (f64::from(cell.column) - mean[0]).hypot(f64::from(cell.row) - mean[1])
        };
        let clearance = |position: usize| f64::from(self.clearance(position)).min(comfort);
        largest.into_iter().max_by(|&a, &b| {
            clearance(a).total_cmp(&clearance(b)).then_with(|| off(b).total_cmp(&off(a))).then(b.cmp(&a))
        })
    }

    /// Of the connected part with the most cells of the region, these.
    fn largest_part(&self) -> Option<Vec<usize>> {
        let mut is_seen = vec![false; self.len()];
        let mut largest: Option<Vec<usize>> = None;
        for start in 0..self.len() {
            if self.clearance[start] == 0.0 || is_seen[start] {
                continue;
            }
            is_seen[start] = true;
            let mut part = vec![start];
            let mut at = 0;
            while at < part.len() {
                for near in self.around(part[at]) {
                    if !std::mem::replace(&mut is_seen[near], true) {
                        part.push(near);
                    }
                }
                at += 1;
            }
            part.retain(|&position| self.is_own[position]);
            if largest.as_ref().is_none_or(|largest| part.len() >= largest.len()) {
                largest = Some(part);
            }
        }
        largest
    }
}
