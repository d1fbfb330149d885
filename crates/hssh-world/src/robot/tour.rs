//! Tours: a robot that somebody leads along a line through a grid map, and keeps a log.

use std::collections::BTreeSet;

use hssh_local::{OccupancyGrid, Roadmap};
use hssh_metrics::{Pose, wrap_angle};
use nalgebra::{Vector3, vector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::carmen;
use super::options::RobotOptions;
use super::record::Moment;

/// Seconds from one scan to the next.
const PERIOD: f64 = 0.5;

/// What a robot logged that was led along a line.
#[derive(Clone, PartialEq, Debug)]
pub struct Tour {
    /// The log, one scan each.
    pub moments: Vec<Moment>,
    /// From this range on nothing came back, in metres.
    pub max_range: f64,
}

impl Tour {
    /// Leads a robot along a line of corners, in metres: at each it turns on the spot. Everything that is not free is seen as
    /// an obstacle, clutter included. The same arguments give the same tour.
    #[must_use]
    pub fn along(line: &[[f64; 2]], grid: &OccupancyGrid, options: &RobotOptions, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut tour = Tour { moments: Vec::new(), max_range: options.laser.max_range };
        let Some(&[x, y]) = line.first() else { return tour };
        let mut odometry = Pose::IDENTITY;
        let mut pose = Pose::new(x, y, 0.0);
        tour.look(grid, pose, odometry, options, &mut random);
        for &[x, y] in &line[1..] {
            let ahead = vector![x - pose.x, y - pose.y];
            let turn = wrap_angle(ahead.y.atan2(ahead.x) - pose.theta);
            let turning = (turn, options.scan_turn, Vector3::z());
            let driving = (ahead.norm(), options.scan_distance, Vector3::x());
            for (amount, step, direction) in [turning, driving] {
                let steps = (amount.abs() / step).ceil();
                for _ in 0..steps as u32 {
                    let twist = direction * (amount / steps);
                    pose = pose.compose(Pose::exp(twist));
                    odometry = odometry.compose(options.odometer.measure(twist, &mut random));
                    tour.look(grid, pose, odometry, options, &mut random);
                }
            }
        }
        tour
    }

    fn look(
        &mut self,
        grid: &OccupancyGrid,
        pose: Pose,
        odometry: Pose,
        options: &RobotOptions,
        random: &mut ChaCha8Rng,
    ) {
        let sweep = options.laser.sweep(grid, pose, random);
        let scan = Some(options.laser.front(&sweep).ranges);
        let time = PERIOD * (self.moments.len() + 1) as f64;
        self.moments.push(Moment { time, pose, odometry, scan });
    }

    /// The log as text, as [`Drive::to_carmen`](super::Drive::to_carmen) has it.
    #[must_use]
    pub fn to_carmen(&self) -> String {
        carmen::text(&self.moments, self.max_range)
    }
}

/// A line along all ways of a roadmap that are needed to come to all places that can be reached from the first one, and back:
/// depth first, each way there and back.
#[must_use]
pub fn round_trip(roadmap: &Roadmap) -> Vec<[f64; 2]> {
    let Some(first) = roadmap.places.first() else { return Vec::new() };
    let mut is_known = BTreeSet::from([first.node]);
    let mut line = vec![roadmap.node(first.node).position];
    // The ways from the first node to the current one, each with the line that leads back.
    let mut back: Vec<(usize, Vec<[f64; 2]>)> = Vec::new();
    let mut here = first.node;
    loop {
        let leads_on = |way: &usize| {
            let [from, to] = roadmap.ways[*way].ends;
            (from == here && !is_known.contains(&to)) || (to == here && !is_known.contains(&from))
        };
        if let Some(way) = (0..roadmap.ways.len()).find(leads_on) {
            let [from, to] = roadmap.ways[way].ends;
            let mut there = roadmap.ways[way].line.clone();
            if to == here {
                there.reverse();
            }
            here = if from == here { to } else { from };
            is_known.insert(here);
            line.extend(&there[1..]);
            there.reverse();
            back.push((way, there));
        } else if let Some((way, there)) = back.pop() {
            let [from, to] = roadmap.ways[way].ends;
            here = if from == here { to } else { from };
            line.extend(&there[1..]);
        } else {
            return line;
        }
    }
}

#[cfg(test)]
mod tests {
    use hssh_local::{RegionMap, RegionOptions, RoadmapOptions};

    use super::*;
    use crate::{floor_plan, grid};

    #[test]
    fn a_tour_comes_to_every_place_and_back_as_its_log_tells() {
        let plan = floor_plan(&grid(2, 2, 8.0).unwrap(), 2.0, 0.1).unwrap();
        let map = RegionMap::new(&plan, &RegionOptions::default()).unwrap();
        let roadmap = Roadmap::new(&plan, &map, &RoadmapOptions::default());
        let line = round_trip(&roadmap);
        assert_eq!(line.first(), line.last());
        let passes = |[x, y]: [f64; 2]| {
            line.windows(2).any(|pair| pair.iter().any(|&[a, b]| (a - x).hypot(b - y) < 1e-9))
        };
        assert!(roadmap.places.len() > 1 && roadmap.places.iter().all(|place| passes(place.center)));
        let options = RobotOptions::default();
        let tour = Tour::along(&line, &plan, &options.with_noise(0.0), 1);
        let start = tour.moments[0].pose;
        for moment in &tour.moments {
            let told = start.compose(moment.odometry);
            assert!((told.translation() - moment.pose.translation()).norm() < 1e-6, "{moment:?}");
        }
        assert_eq!(tour, Tour::along(&line, &plan, &options.with_noise(0.0), 1));
        let length: f64 =
            line.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum();
        assert!(tour.moments.len() as f64 >= length / options.scan_distance);
    }
}
