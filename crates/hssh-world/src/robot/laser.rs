//! A laser range finder among the cells of a grid.

use std::f64::consts::TAU;

use hssh_local::{Cell, Occupancy, OccupancyGrid, Scan};
use hssh_metrics::Pose;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A planar laser in the middle of the robot, half a turn wide straight ahead.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Laser {
    /// Beams of a scan; with an even number the last one of the half turn is left out.
    pub beams: usize,
    /// Metres from which on nothing comes back.
    pub max_range: f64,
    /// Of a range, standard deviation in metres.
    pub noise: f64,
    /// How likely it is that a beam does not come back.
    pub dropouts: f64,
}

/// A SICK laser of the 2000s.
impl Default for Laser {
    fn default() -> Self {
        Laser { beams: 181, max_range: 30.0, noise: 0.02, dropouts: 0.01 }
    }
}

impl Laser {
    /// Ranges all around in the laser's steps, counterclockwise from straight ahead; infinite where nothing
    /// came back. What is not free is in the way, and so is the border of the grid.
    pub(super) fn sweep(&self, grid: &OccupancyGrid, from: Pose, random: &mut ChaCha8Rng) -> Vec<f64> {
        let count = 2 * self.steps();
        let bearing = |index: usize| from.theta + TAU * index as f64 / count as f64;
        let ranges =
            (0..count).map(|index| distance_along(grid, [from.x, from.y], bearing(index), self.max_range));
        let exact: Vec<f64> = ranges.collect();
        let noisy = exact.into_iter().map(|range| {
            let error: f64 = StandardNormal.sample(random);
            let is_lost = random.random::<f64>() < self.dropouts;
            let measured = range + self.noise * error;
            if is_lost || measured >= self.max_range { f64::INFINITY } else { measured.max(0.01) }
        });
        noisy.collect()
    }

    /// The scan that is part of a sweep: its front half, from right to left.
    pub(super) fn front(&self, sweep: &[f64]) -> Scan {
        self.half(sweep, sweep.len() - self.steps() / 2)
    }

    /// The other half, as if the robot looked the other way.
    pub(super) fn back(&self, sweep: &[f64]) -> Scan {
        self.half(sweep, self.steps() / 2)
    }

    fn half(&self, sweep: &[f64], first: usize) -> Scan {
        Scan::of_half_turn((0..self.beams).map(|beam| sweep[(first + beam) % sweep.len()]).collect())
    }

    /// Steps from beam to beam in half a turn.
    fn steps(&self) -> usize {
        (self.beams - self.beams % 2).max(2)
    }
}

/// Metres along a ray to the first cell that is not free or to the border; infinite beyond `reach`.
fn distance_along(grid: &OccupancyGrid, from: [f64; 2], bearing: f64, reach: f64) -> f64 {
    let lattice = grid.lattice();
    let Some(start) = lattice.cell_at(from) else { return 0.0 };
    let (sin, cos) = bearing.sin_cos();
    let (direction, at) = ([cos, sin], lattice.continuous(from));
    let mut cell = [i64::from(start.column), i64::from(start.row)];
    // In cells along the ray: to the next border in each direction, and from one border to the next.
    let between = direction.map(|part| 1.0 / part.abs());
    let mut next = [0, 1].map(|axis| {
        let inside = at[axis] - at[axis].floor();
        (if direction[axis] > 0.0 { 1.0 - inside } else { inside }) * between[axis]
    });
    let reach = reach / lattice.resolution();
    let mut gone = 0.0;
    while gone < reach {
        let is_free = |[column, row]: [i64; 2]| {
            let cell = Cell { column: u32::try_from(column).ok()?, row: u32::try_from(row).ok()? };
            let is_inside = cell.column < lattice.width() && cell.row < lattice.height();
            (is_inside && grid.get(cell) == Occupancy::Free).then_some(())
        };
        if is_free(cell).is_none() {
            return gone * lattice.resolution();
        }
        let axis = usize::from(next[1] < next[0]);
        gone = next[axis];
        next[axis] += between[axis];
        cell[axis] += if direction[axis] > 0.0 { 1 } else { -1 };
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;
    use hssh_local::Lattice;
    use rand::SeedableRng;

    /// A room of 8 m by 6 m whose middle is the origin.
    fn room() -> OccupancyGrid {
        let lattice = Lattice::new(90, 70, 0.1, [-4.5, -3.5]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
        for cell in lattice.cells() {
            let [x, y] = lattice.center(cell);
            if x.abs() < 4.0 && y.abs() < 3.0 {
                grid.set(cell, Occupancy::Free);
            }
        }
        grid
    }

    #[test]
    fn exact_ranges_are_those_of_the_room() {
        let laser = Laser { noise: 0.0, dropouts: 0.0, ..Laser::default() };
        for pose in [Pose::new(0.0, 0.0, 0.0), Pose::new(1.23, -0.77, 0.4), Pose::new(-3.1, 2.2, -2.9)] {
            let sweep = laser.sweep(&room(), pose, &mut ChaCha8Rng::seed_from_u64(0));
            assert_eq!(sweep.len(), 360);
            for (degree, range) in sweep.iter().enumerate() {
                let (sin, cos) = (pose.theta + (degree as f64).to_radians()).sin_cos();
                let to = |at: f64, half: f64, part: f64| (half * part.signum() - at) / part;
                let expected = to(pose.x, 4.0, cos).min(to(pose.y, 3.0, sin));
                assert!((range - expected).abs() < 1e-6, "{degree}: {range} is not {expected}");
            }
        }
    }

    #[test]
    fn a_scan_is_the_front_of_a_sweep() {
        for beams in [180, 181, 361] {
            let laser = Laser { beams, noise: 0.0, dropouts: 0.0, ..Laser::default() };
            let sweep = laser.sweep(&room(), Pose::new(0.0, 0.0, 0.0), &mut ChaCha8Rng::seed_from_u64(0));
            let scan = laser.front(&sweep);
            for (_, [[x, y]]) in scan.hits(50.0).map(|(beam, point)| (beam, point.data.0)) {
                assert!((x - 4.0).abs() < 1e-6 || (y.abs() - 3.0).abs() < 1e-6, "({x}, {y}) is on no wall");
            }
            // From the middle of the room it looks the same behind.
            let back = laser.back(&sweep);
            assert!(scan.ranges.iter().zip(&back.ranges).all(|(front, back)| (front - back).abs() < 1e-6));
        }
    }

    #[test]
    fn errors_are_as_large_as_they_say() {
        let laser = Laser { noise: 0.05, dropouts: 0.2, ..Laser::default() };
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let exact = Laser { noise: 0.0, dropouts: 0.0, ..laser }.sweep(&room(), Pose::IDENTITY, &mut random);
        let (mut squares, mut came_back) = (0.0, 0.0);
        for _ in 0..50 {
            let sweep = laser.sweep(&room(), Pose::IDENTITY, &mut random);
            for (range, exact) in sweep.iter().zip(&exact).filter(|(range, _)| range.is_finite()) {
                squares += (range - exact).powi(2);
                came_back += 1.0;
            }
        }
        assert!((came_back / (50.0 * 360.0) - 0.8_f64).abs() < 0.02);
        assert!(((squares / came_back).sqrt() - 0.05_f64).abs() < 0.002);
    }
}
