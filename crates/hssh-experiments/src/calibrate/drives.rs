//! Simulated drives: each number is one floor, one level of noise, one seed and one strategy.

use std::error::Error;

use hssh_local::LaserLog;
use hssh_world::floor_plan;
use hssh_world::robot::{Drive, RobotOptions, Strategy, drive};

use super::chain::Outcome;
use super::floors::{Ground, ground, names};

/// How large the robot's errors are, in parts of their usual size.
pub(super) const NOISES: [f64; 5] = [0.5, 1.0, 1.5, 2.0, 3.0];
/// Metres per cell of the floor plans.
const RESOLUTION: f64 = 0.1;
/// How many travels a drive has at most.
const TRAVELS: usize = 25;

/// A drive to be made.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub(super) number: usize,
    pub(super) floor: String,
    pub(super) noise: f64,
    strategy: Strategy,
}

/// What became of it.
pub(super) struct Driven {
    pub(super) task: Task,
    pub(super) outcome: Outcome,
}

impl Task {
    /// The drive of that number: one for each floor, then one for each floor at the next level of noise, and so on. The
    /// two strategies take turns among floors, levels, and rounds of all levels.
    pub(super) fn new(number: usize) -> Self {
        let floors = names();
        let (floor, level) = (number % floors.len(), number / floors.len());
        let (noise, round) = (level % NOISES.len(), level / NOISES.len());
        let is_covering = (floor + noise + round).is_multiple_of(2);
        let strategy = if is_covering { Strategy::Cover } else { Strategy::Wander };
        Task { number, floor: floors[floor].clone(), noise: NOISES[noise], strategy }
    }

    /// Lets the robot drive, from another place each time.
    pub(super) fn drive(&self) -> Result<Drive, Box<dyn Error>> {
        let seed = self.number as u64;
        let Ground { world, width, .. } = ground(&self.floor, seed)?;
        let grid = floor_plan(&world, width, RESOLUTION)?;
        let start = world.places()[self.number * 7 % world.places().len()].position;
        let options = RobotOptions { travels: TRAVELS, ..RobotOptions::default() }.with_noise(self.noise);
        Ok(drive(&grid, Some([start.x, start.y]), self.strategy.clone(), &options, seed)?)
    }

    /// Drives, surveys and maps.
    pub(super) fn run(self) -> Driven {
        let log = self.drive().and_then(|drive| Ok(LaserLog::read(drive.to_carmen().as_bytes())?));
        let outcome = match log {
            Ok(log) => Outcome::of(log),
            Err(error) => Outcome { problem: Some(error.to_string()), ..Outcome::default() },
        };
        Driven { task: self, outcome }
    }

    /// What the drive is, in words.
    pub(super) fn describe(&self) -> String {
        let Task { number, floor, noise, strategy } = self;
        let strategy = if *strategy == Strategy::Cover { "covering" } else { "wandering" };
        format!("drive {number}: {floor}, noise {noise}, {strategy}, seed {number}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_go_through_floors_noises_and_strategies() {
        let floors = names().len();
        let (first, next, noisier) = (Task::new(0), Task::new(1), Task::new(floors));
        assert!(first.floor != next.floor && first.strategy != next.strategy);
        assert_eq!((first.noise, &first.floor), (NOISES[0], &noisier.floor));
        assert_eq!(noisier.noise, NOISES[1]);
        let other = Task::new(floors * NOISES.len());
        assert_eq!((other.noise, other.floor), (first.noise, first.floor));
        assert_ne!(other.strategy, first.strategy);
    }
}
