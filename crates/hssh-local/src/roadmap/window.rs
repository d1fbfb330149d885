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

/// A window on one region.
pub(super) struct Window {
    low: Cell,
    width: usize,
    height: usize,
    /// The clearance of each cell that a robot fits into, in metres; 0 of others.
    clearance: Vec<f32>,
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
        let (width, height) = ((high.column - low.column) as usize + 1, (high.row - low.row) as usize + 1);
        let (clearance, is_own) = (vec![0.0; width * height], vec![false; width * height]);
        let mut window = Window { low, width, height, clearance, is_own };
        let fits = |cell: Cell| {
            let clearance = field.clearance(cell).min(1e6);
            if clearance >= options.radius { clearance as f32 } else { 0.0 }
        };
        for row in low.row..=high.row {
            for column in low.column..=high.column {
                let cell = Cell { column, row };
                if map.region_of(cell) == Some(region) {
                    let position = window.position(cell);
                    window.clearance[position] = fits(cell);
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
                        window.clearance[position] = fits(cell);
                    }
                }
            }
        }
        window
    }

    fn contains(&self, cell: Cell) -> bool {
        let (column, row) = (cell.column.wrapping_sub(self.low.column), cell.row.wrapping_sub(self.low.row));
        (column as usize) < self.width && (row as usize) < self.height
    }

    /// The position of a cell in the window; it must be in it.
    pub(super) fn position(&self, cell: Cell) -> usize {
        (cell.row - self.low.row) as usize * self.width + (cell.column - self.low.column) as usize
    }

    /// The cell at a position.
    pub(super) fn cell(&self, position: usize) -> Cell {
        Cell {
            column: self.low.column + (position % self.width) as u32,
            row: self.low.row + (position / self.width) as u32,
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

    /// The eight positions around one at which a robot fits in, and whether each is across a corner.
    pub(super) fn around(&self, position: usize) -> impl Iterator<Item = (usize, bool)> {
        let (column, row) = (position % self.width, position / self.width);
        let steps = (-1..=1_isize).flat_map(|rows| (-1..=1_isize).map(move |columns| (columns, rows)));
        steps.filter_map(move |(columns, rows)| {
            let near_column = column.checked_add_signed(columns).filter(|&near| near < self.width)?;
            let near_row = row.checked_add_signed(rows).filter(|&near| near < self.height)?;
            let near = near_row * self.width + near_column;
            ((columns, rows) != (0, 0) && self.clearance[near] > 0.0)
                .then_some((near, columns != 0 && rows != 0))
        })
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
                for (near, _) in self.around(position) {
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
        let mut parts = self.parts();
        parts.iter_mut().for_each(|part| part.retain(|&position| self.is_own[position]));
        let largest = parts.into_iter().max_by_key(Vec::len)?;
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

    /// The connected parts.
    fn parts(&self) -> Vec<Vec<usize>> {
        let mut is_seen = vec![false; self.len()];
        let mut parts = Vec::new();
        for start in 0..self.len() {
            if self.clearance[start] == 0.0 || is_seen[start] {
                continue;
            }
            is_seen[start] = true;
            let mut part = vec![start];
            let mut at = 0;
            while at < part.len() {
                for (near, _) in self.around(part[at]) {
                    if !std::mem::replace(&mut is_seen[near], true) {
                        part.push(near);
                    }
                }
                at += 1;
            }
            parts.push(part);
        }
        parts
    }
}
