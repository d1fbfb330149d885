//! Evidence for and against obstacles, cell by cell, gathered along the beams of scans.

use hssh_metrics::Pose;
use nalgebra::{Vector2, vector};

use super::options::LocalMapOptions;
use crate::grid::{Cell, Lattice, LatticeError, Occupancy, OccupancyGrid};
use crate::scan::Scan;

/// A square of log-odds, in the frame that the robot's poses are given in.
#[derive(Clone, PartialEq, Debug)]
pub struct LocalMap {
    lattice: Lattice,
    /// In nats, row by row from the bottom; zero is unknown.
    log_odds: Vec<f32>,
    /// The number of the last scan that spoke for or against each cell: a scan has one say per cell.
    last_scan: Vec<u32>,
    scans: u32,
    options: LocalMapOptions,
}

impl LocalMap {
    /// An empty map around a point in metres.
    ///
    /// # Errors
    /// If the options describe no lattice.
    pub fn new(center: Vector2<f64>, options: LocalMapOptions) -> Result<Self, LatticeError> {
        let cells = (options.side / options.resolution).ceil().clamp(0.0, f64::from(u32::MAX)) as u32;
        // Corners of cells are multiples of the resolution, so that scrolling moves whole cells.
        let corner =
            center.map(|c| ((c - options.side / 2.0) / options.resolution).round() * options.resolution);
        let lattice = Lattice::new(cells, cells, options.resolution, [corner.x, corner.y])?;
        let (log_odds, last_scan) = (vec![0.0; lattice.len()], vec![0; lattice.len()]);
        Ok(LocalMap { lattice, log_odds, last_scan, scans: 0, options })
    }

    /// Moves the square so that `center` is in its middle; what leaves the square is forgotten.
    ///
    /// # Errors
    /// If the point is not finite.
    pub fn scroll_to(&mut self, center: Vector2<f64>) -> Result<(), LatticeError> {
        let mut moved = LocalMap::new(center, self.options)?;
        let [from, to] = [self.lattice.origin(), moved.lattice.origin()];
        let shift = |axis: usize| ((to[axis] - from[axis]) / self.options.resolution).round() as i64;
        let (columns, rows) = (shift(0), shift(1));
        if (columns, rows) == (0, 0) {
            return Ok(());
        }
        let side = i64::from(self.lattice.width());
        let kept = (-columns).clamp(0, side)..(side - columns).clamp(0, side);
        if kept.is_empty() {
            *self = moved;
            return Ok(());
        }
        for row in (-rows).clamp(0, side)..(side - rows).clamp(0, side) {
            let target = (row * side + kept.start) as usize;
            let source = ((row + rows) * side + kept.start + columns) as usize;
            let length = (kept.end - kept.start) as usize;
            moved.log_odds[target..target + length].copy_from_slice(&self.log_odds[source..source + length]);
        }
        *self = moved;
        Ok(())
    }

    /// Adds what a scan from a pose says: the cells that beams end in are occupied, and those that beams go
    /// through are free. Obstacles have the first say, for beams graze walls before they hit them.
    pub fn insert(&mut self, pose: Pose, scan: &Scan) {
        let Some(from) = self.lattice.cell_at([pose.x, pose.y]) else { return };
        self.scans += 1;
        let rotation = pose.rotation();
        // Where nothing came back, nothing is known: glass and dark surfaces give no echo either.
        let beams = (0..scan.ranges.len()).filter(|&beam| scan.ranges[beam].is_finite());
        let reach = self.options.reach;
        for beam in beams.clone().filter(|&beam| scan.ranges[beam] < reach) {
            let hit = pose.translation() + rotation * scan.direction(beam) * scan.ranges[beam];
            if let Some(cell) = self.lattice.cell_at([hit.x, hit.y]) {
                self.add(cell, self.options.hit);
            }
        }
        self.spare_surfaces(pose, scan);
        for beam in beams {
            for (direction, range) in sweep(scan, beam, reach, self.lattice.resolution()) {
                let end = pose.translation() + rotation * direction * range;
                for cell in self.lattice.line(from, self.last_inside(from, end)) {
                    self.add(cell, -self.options.miss);
                }
            }
        }
    }

    /// What lies between the hits of two neighboring beams may be one surface: beams that graze it go through cells beside
    /// it, and through its own where it lies at their border, and must not clear them.
    fn spare_surfaces(&mut self, pose: Pose, scan: &Scan) {
        /// Hits farther apart than this, in metres, are on two surfaces.
        const ONE_SURFACE: f64 = 3.0;
        let rotation = pose.rotation();
        let hit = |beam: usize| {
            let range = scan.ranges[beam];
            (range < self.options.reach).then(|| pose.translation() + rotation * scan.direction(beam) * range)
        };
        let mut spared: Vec<Cell> = Vec::new();
        for beam in 1..scan.ranges.len() {
            let (Some(one), Some(other)) = (hit(beam - 1), hit(beam)) else { continue };
            let ends = [one, other].map(|point| self.lattice.cell_at([point.x, point.y]));
            if let ([Some(from), Some(to)], true) = (ends, (one - other).norm() < ONE_SURFACE) {
                for cell in self.lattice.line(from, to) {
                    spared.push(cell);
                    spared.extend(self.lattice.side_neighbors(cell));
                }
            }
        }
        for cell in spared {
            let index = self.lattice.index(cell);
            self.last_scan[index] = self.scans;
        }
    }

    /// Adds that the robot went straight from one pose to another: where its body passed, nothing is.
    pub fn clear_way(&mut self, from: Pose, to: Pose) {
        self.scans += 1;
        let (start, way) = (from.translation(), to.translation() - from.translation());
        let steps = (way.norm() / self.lattice.resolution()).ceil().max(1.0);
        let reach = (self.options.body / self.lattice.resolution()).ceil() as i32;
        for step in 0..=steps as u32 {
            let at = start + way * (f64::from(step) / steps);
            let Some(middle) = self.lattice.cell_at([at.x, at.y]) else { continue };
            for (rows, columns) in (-reach..=reach).flat_map(|rows| (-reach..=reach).map(move |c| (rows, c)))
            {
                if f64::from(rows).hypot(f64::from(columns)) * self.lattice.resolution() <= self.options.body
                    && let Some(cell) = self.lattice.step(middle, columns, rows)
                {
                    self.add(cell, -self.options.certainty);
                }
            }
        }
    }

    /// The last cell of the map on the way from a cell to a point.
    fn last_inside(&self, from: Cell, end: Vector2<f64>) -> Cell {
        if let Some(cell) = self.lattice.cell_at([end.x, end.y]) {
            return cell;
        }
        let [x, y] = self.lattice.center(from);
        let start = vector![x, y];
        let way = end - start;
        let steps = (way.norm() / self.lattice.resolution()).ceil();
        let points = (1..=steps as u32).map(|step| start + way * (f64::from(step) / steps));
        points.map_while(|point| self.lattice.cell_at([point.x, point.y])).last().unwrap_or(from)
    }

    fn add(&mut self, cell: Cell, evidence: f32) {
        let index = self.lattice.index(cell);
        if self.last_scan[index] != self.scans {
            self.last_scan[index] = self.scans;
            let sum = self.log_odds[index] + evidence;
            self.log_odds[index] = sum.clamp(self.options.bounds.0, self.options.bounds.1);
        }
    }

    /// What is known of each cell.
    #[must_use]
    pub fn classify(&self) -> OccupancyGrid {
        let cells = self.log_odds.iter().map(|&log_odds| self.occupancy(log_odds)).collect();
        OccupancyGrid::new(self.lattice, cells).expect("there is one number for each cell of the lattice")
    }

    /// What is known of the cells in a square of `side` metres around a point, with the same cells; `None` if
    /// no cell of the map is in it.
    #[must_use]
    pub fn window(&self, center: Vector2<f64>, side: f64) -> Option<OccupancyGrid> {
        let (lattice, first) = self.lattice.window([center.x, center.y], side)?;
        let known = |cell: Cell| {
            let cell = Cell { column: first.column + cell.column, row: first.row + cell.row };
            self.occupancy(self.log_odds[self.lattice.index(cell)])
        };
        let cells = lattice.cells().map(known).collect();
        Some(OccupancyGrid::new(lattice, cells).expect("there is one cell for each cell of the window"))
    }

    fn occupancy(&self, log_odds: f32) -> Occupancy {
        let (free, occupied) = self.options.thresholds;
        match log_odds {
            evidence if evidence > occupied => Occupancy::Occupied,
            evidence if evidence < free => Occupancy::Free,
            _ => Occupancy::Unknown,
        }
    }
}

/// Directions and ranges that a beam stands for: itself, and so many beams between it and the next one
/// that no cell within `reach` stays between them. They go as far as the shorter of the two does.
fn sweep(
    scan: &Scan,
    beam: usize,
    reach: f64,
    resolution: f64,
) -> impl Iterator<Item = (Vector2<f64>, f64)> + use<> {
    let range = scan.ranges[beam].min(reach);
    let next = scan.ranges.get(beam + 1).filter(|next| next.is_finite()).map(|next| next.min(range));
    let (first, width) = (scan.bearing(beam), scan.bearing(1) - scan.bearing(0));
    let between = next.map_or(0, |next| (next * width / resolution).ceil() as u32).saturating_sub(1);
    let own = std::iter::once((first, range));
    let step = width / f64::from(between + 1);
    let filling = (1..=between).map(move |index| (first + f64::from(index) * step, next.unwrap_or(range)));
    own.chain(filling).map(|(bearing, range)| (vector![bearing.cos(), bearing.sin()], range))
}
