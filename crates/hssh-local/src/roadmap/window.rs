//! The cells of one region in a window of their own, as far as a robot fits into them.

use super::numbered::Numbered;
use super::options::RoadmapOptions;
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice};
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

/// A window on one region: the cells that a robot fits into, each at a position, in the order of rows and columns.
pub(super) struct Window<'a> {
    field: &'a DistanceField,
    frame: Frame,
    fitting: Numbered,
    /// What a step costs to each position, straight on and across a corner.
    costs: Vec<[u8; 2]>,
    /// Which positions are in the region, and not beyond one of its passages.
    is_own: Vec<bool>,
}

/// The clearance of a cell in metres, a large number where nothing limits it.
fn clearance(cell: Cell, field: &DistanceField) -> f32 {
    field.clearance(cell).min(1e6) as f32
}

/// The rectangle of a window, and around it one more cell on each side, where no robot fits in.
struct Frame {
    low: Cell,
    high: Cell,
    /// Cells in a row.
    width: usize,
}

impl Frame {
    /// Around what is between two cells, and so many cells more, as far as they are on the lattice.
    fn around([low, high]: Bounds, beyond: u32, lattice: &Lattice) -> Self {
        let low = Cell { column: low.column.saturating_sub(beyond), row: low.row.saturating_sub(beyond) };
        let high = Cell {
            column: (high.column + beyond).min(lattice.width() - 1),
            row: (high.row + beyond).min(lattice.height() - 1),
        };
        Frame { low, high, width: (high.column - low.column) as usize + 3 }
    }

    /// How many cells there are.
    fn len(&self) -> usize {
        self.width * ((self.high.row - self.low.row) as usize + 3)
    }

    /// The cells of the rectangle.
    fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let (low, high) = (self.low, self.high);
        (low.row..=high.row)
            .flat_map(move |row| (low.column..=high.column).map(move |column| Cell { column, row }))
    }

    fn contains(&self, cell: Cell) -> bool {
        (self.low.column..=self.high.column).contains(&cell.column)
            && (self.low.row..=self.high.row).contains(&cell.row)
    }

    /// The index of a cell of the rectangle.
    fn index(&self, cell: Cell) -> usize {
        (cell.row - self.low.row + 1) as usize * self.width + (cell.column - self.low.column + 1) as usize
    }

    /// The cell of the rectangle with an index.
    fn cell(&self, index: usize) -> Cell {
        Cell {
            column: self.low.column + (index % self.width) as u32 - 1,
            row: self.low.row + (index / self.width) as u32 - 1,
        }
    }
}

impl<'a> Window<'a> {
    /// The window on a region: its cells, and those within `beyond` metres of the points where it leads on.
    pub(super) fn new(
        map: &RegionMap,
        region: RegionNumber,
        bounds: Bounds,
        field: &'a DistanceField,
        exits: &[Cell],
        options: &RoadmapOptions,
    ) -> Self {
        let lattice = map.lattice();
        let beyond = (2.0 * options.radius / lattice.resolution()).ceil() as u32 + 1;
        let frame = Frame::around(bounds, beyond, lattice);
        let fits = |cell: &Cell| field.clearance(*cell) >= options.radius;
        let is_own = |cell: Cell| map.region_of(cell) == Some(region);
        let fitting = Numbered::new(frame.width, frame.len(), |insert| {
            let own = frame.cells().filter(|&cell| is_own(cell));
            let near = exits.iter().flat_map(|&exit| Frame::around([exit; 2], beyond, lattice).cells());
            let near = near.filter(|&cell| frame.contains(cell));
            own.chain(near).filter(fits).for_each(|cell| insert(frame.index(cell)));
        });
        let cells = || fitting.members().map(|index| frame.cell(index));
        let costs = |cell: Cell| {
            let dearness = (options.comfort / f64::from(clearance(cell, field))).clamp(1.0, DEAREST);
            [STRAIGHT, DIAGONAL].map(|step| (step * dearness).round() as u8)
        };
        let (costs, is_own) = (cells().map(costs).collect(), cells().map(is_own).collect());
        Window { field, frame, fitting, costs, is_own }
    }

    /// The position of a cell of the region, or near to where it leads on, that a robot fits into.
    pub(super) fn position(&self, cell: Cell) -> Option<usize> {
        if self.frame.contains(cell) { self.fitting.number(self.frame.index(cell)) } else { None }
    }

    /// The cell at a position.
    pub(super) fn cell(&self, position: usize) -> Cell {
        self.frame.cell(self.fitting.member(position))
    }

    /// The clearance at a position, in metres.
    fn clearance(&self, position: usize) -> f32 {
        clearance(self.cell(position), self.field)
    }

    /// How many positions there are.
    pub(super) fn len(&self) -> usize {
        self.fitting.len()
    }

    /// The positions around one, row by row.
    pub(super) fn around(&self, position: usize) -> impl Iterator<Item = usize> + use<> {
        self.fitting.around(position)
    }

    /// The same, each with the cost of the step there; first those straight on.
    pub(super) fn steps(&self, position: usize) -> impl Iterator<Item = (usize, u32)> {
        self.fitting.beside(position).map(|(near, kind)| (near, u32::from(self.costs[near][kind])))
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
        let wide = (0..self.len()).filter(|&at| self.is_own[at]).map(|at| (self.clearance(at), at as u32));
        let mut wide: Vec<(f32, u32)> = wide.filter(|&(clearance, _)| clearance >= least).collect();
        wide.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut found = Vec::new();
        for position in wide.into_iter().map(|(_, position)| position as usize) {
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
        let cell = |position: u32| {
            let cell = self.cell(position as usize);
            [f64::from(cell.column), f64::from(cell.row)]
        };
        let sum = largest
            .iter()
            .map(|&position| cell(position))
            .fold([0.0, 0.0], |sum, cell| [sum[0] + cell[0], sum[1] + cell[1]]);
        let mean = sum.map(|sum| sum / count);
        let clearance = |position: u32| f64::from(self.clearance(position as usize)).min(comfort);
        let widest = largest.iter().map(|&position| clearance(position)).fold(0.0, f64::max);
        let off = |position: u32| {
            let [column, row] = cell(position);
            (column - mean[0]).powi(2) + (row - mean[1]).powi(2)
        };
        let widest = largest.into_iter().filter(|&position| clearance(position) >= widest);
        let nearest = widest
            .map(|position| (off(position), position))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        nearest.map(|(_, position)| position as usize)
    }

    /// Of the connected part with the most cells of the region, these.
    fn largest_part(&self) -> Option<Vec<u32>> {
        let mut is_seen = vec![false; self.len()];
        let mut largest: Option<Vec<u32>> = None;
        for start in 0..self.len() {
            if is_seen[start] {
                continue;
            }
            is_seen[start] = true;
            let mut part = vec![start as u32];
            let mut at = 0;
            while at < part.len() {
                for near in self.around(part[at] as usize) {
                    if !std::mem::replace(&mut is_seen[near], true) {
                        part.push(near as u32);
                    }
                }
                at += 1;
            }
            part.retain(|&position| self.is_own[position as usize]);
            if largest.as_ref().is_none_or(|largest| part.len() >= largest.len()) {
                largest = Some(part);
            }
        }
        largest
    }
}
