//! Submaps: what was seen along a stretch of the way, in the frame of its middle.

use hssh_metrics::Pose;
use nalgebra::Vector2;

use super::field::Field;
use super::keyframe::Keyframe;
use super::options::ClosingOptions;
use crate::carmen::LaserLog;
use crate::grid::{Cell, LatticeError, Occupancy, OccupancyGrid};
use crate::local_map::{LocalMap, LocalMapOptions};
use crate::matching::{Cloud, SurfacePoint};

/// Side of a cell, in metres.
pub(super) const CELL: f64 = 0.1;

/// Where a submap has fewer walls' cells than this, as on a lawn, it shows more of its surroundings.
const ENOUGH: usize = 150;

/// What was seen along a stretch of the way.
pub(super) struct Submap {
    /// The keyframe in the middle, whose frame is the submap's.
    pub(super) middle: usize,
    /// The keyframes of the stretch.
    pub(super) keyframes: std::ops::Range<usize>,
    /// Metres travelled at the middle.
    pub(super) travelled: f64,
    /// Metres of travel before and after the middle.
    pub(super) stretch: f64,
    /// The middles of walls' cells, about one in 0.2 m.
    pub(super) walls: Vec<Vector2<f64>>,
    /// How well a wall fits where.
    pub(super) field: Field,
}

/// Which keyframes are the middles of submaps: the last one, too, if it is half as far from the one before, for logs end where the robot
/// comes back to.
pub(super) fn middles(keyframes: &[Keyframe], options: &ClosingOptions) -> Vec<usize> {
    let mut middles: Vec<usize> = Vec::new();
    for (index, keyframe) in keyframes.iter().enumerate() {
        let since = middles.last().map(|&last| keyframe.travelled - keyframes[last].travelled);
        if since.is_none_or(|since| since >= options.submap_distance) {
            middles.push(index);
        }
    }
    if let (Some(&middle), Some(last)) = (middles.last(), keyframes.last())
        && last.travelled - keyframes[middle].travelled >= options.submap_distance / 2.0
    {
        middles.push(keyframes.len() - 1);
    }
    middles
}

/// What scans show of their surroundings up to some metres, in the frame of a pose.
fn drawn(
    log: &LaserLog,
    keyframes: &[Keyframe],
    frame: Pose,
    (stretch, reach): (f64, f64),
) -> Result<OccupancyGrid, LatticeError> {
    let side = 2.0 * (stretch + reach) + 2.0;
    let local = LocalMapOptions { side, resolution: CELL, reach, ..LocalMapOptions::default() };
    let mut map = LocalMap::new(Vector2::zeros(), local)?;
    for keyframe in keyframes {
        map.insert(frame.between(keyframe.tracked), &log.scans[keyframe.scan].scan);
    }
    Ok(map.classify())
}

/// The middles of every second cell of walls.
fn walls(grid: &OccupancyGrid) -> Vec<Vector2<f64>> {
    let lattice = grid.lattice();
    let is_wall = |cell: &Cell| grid.get(*cell) == Occupancy::Occupied;
    let every_second = lattice.cells().filter(is_wall).filter(|cell| (cell.column + cell.row) % 2 == 0);
    every_second.map(|cell| lattice.center(cell).into()).collect()
}

impl Submap {
    /// The submap around a keyframe.
    pub(super) fn new(
        log: &LaserLog,
        keyframes: &[Keyframe],
        middle: usize,
        options: &ClosingOptions,
    ) -> Result<Self, LatticeError> {
        let travelled = keyframes[middle].travelled;
        let mut reach = options.reach;
        loop {
            // Who looks ahead sees what lies before the stretch on one pass and what lies behind it on the other: the farther it sees, the
            // longer the stretch has to be for both to have something in common.
            let stretch = options.stretch * reach / options.reach;
            let first = keyframes.partition_point(|other| other.travelled < travelled - stretch);
            let last = keyframes.partition_point(|other| other.travelled <= travelled + stretch);
            let grid = drawn(log, &keyframes[first..last], keyframes[middle].tracked, (stretch, reach))?;
            let walls = walls(&grid);
            if walls.len() >= ENOUGH || reach >= options.farthest_reach {
                let field = Field::new(&grid);
                return Ok(Submap { middle, keyframes: first..last, travelled, stretch, walls, field });
            }
            reach = (2.0 * reach).min(options.farthest_reach);
        }
    }

    /// The surfaces of the stretch in the submap's frame.
    pub(super) fn cloud(&self, keyframes: &[Keyframe]) -> Cloud {
        let mut cloud = Cloud::default();
        for keyframe in &keyframes[self.keyframes.clone()] {
            cloud.insert(self.place(keyframes, keyframe), &keyframe.surfaces, 0.08);
        }
        cloud
    }

    /// The same, as a list.
    pub(super) fn surfaces(&self, keyframes: &[Keyframe]) -> Vec<SurfacePoint> {
        self.cloud(keyframes).points().to_vec()
    }

    fn place(&self, keyframes: &[Keyframe], keyframe: &Keyframe) -> Pose {
        keyframes[self.middle].tracked.between(keyframe.tracked)
    }
}
