//! One trial: a ground, a laser, wheels and people, all of it by one number; and its log.

use std::error::Error;
use std::fmt::Write;

use hssh_local::LaserLog;
use hssh_metrics::Pose;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::grounds::{Ground, KINDS};
use super::motion::{Wheels, odometry, poses};
use super::surroundings::Disc;

/// Beams of a scan.
const BEAMS: usize = 181;
/// Of a range, standard deviation in metres.
const NOISE: f64 = 0.02;
/// Metres from scan to scan: ten a second, and keyframes.
const STEPS: [f64; 3] = [0.1, 0.4, 0.7];
/// How far a laser sees, in metres.
const REACHES: [f64; 3] = [30.0, 8.0, 50.0];
/// Metres of way between people who come towards the robot.
const PEOPLE: [f64; 3] = [f64::INFINITY, 15.0, 5.0];
const WHEELS: [(&str, Wheels); 4] = [
    ("good", Wheels { bend: 0.0003, turn: 0.002, noise: (0.01, 0.003), slip: f64::INFINITY }),
    ("fair", Wheels { bend: 0.002, turn: 0.01, noise: (0.03, 0.02), slip: f64::INFINITY }),
    ("bad", Wheels { bend: -0.01, turn: 0.04, noise: (0.08, 0.05), slip: f64::INFINITY }),
    ("slip", Wheels { bend: 0.001, turn: 0.01, noise: (0.03, 0.015), slip: 40.0 }),
];

/// A trial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    pub(super) number: usize,
    pub(super) kind: usize,
    pub(super) step: f64,
    pub(super) reach: f64,
    people: f64,
    wheels: usize,
}

impl Trial {
    /// The trial of that number: kinds take turns, and with each round something else comes together.
    pub(super) fn new(number: usize) -> Self {
        let (kind, round) = (number % KINDS.len(), number / KINDS.len());
        Trial {
            number,
            kind,
            step: STEPS[(round + kind) % STEPS.len()],
            reach: REACHES[(round / 3 + round + kind) % REACHES.len()],
            people: PEOPLE[(round / 2 + 2 * kind) % PEOPLE.len()],
            wheels: (round + kind / 2) % WHEELS.len(),
        }
    }

    pub(super) fn name(&self) -> &'static str {
        KINDS[self.kind].0
    }

    pub(super) fn describe(&self) -> String {
        let Trial { number, step, reach, people, .. } = self;
        let people =
            if people.is_finite() { format!("people every {people} m") } else { "nobody".to_owned() };
        let wheels = WHEELS[self.wheels].0;
        format!(
            "trial {number}: {}, a scan every {step} m, laser of {reach} m, {people}, {wheels} wheels",
            self.name()
        )
    }

    /// The log as CARMEN text: first the true pose of a scan, then what the wheels say.
    pub(super) fn to_carmen(self) -> String {
        let mut random = ChaCha8Rng::seed_from_u64(self.number as u64);
        let ground = (KINDS[self.kind].1)(&mut random);
        let truth = poses(&ground.way, self.step);
        let believed = odometry(&truth, &WHEELS[self.wheels].1, &mut random);
        let people = self.people_along(&truth, &mut random);
        let mut text = format!("PARAM robot_front_laser_max {:.2} nohost 0\n", self.reach);
        for (index, (pose, raw)) in truth.iter().zip(&believed).enumerate() {
            let time = 0.2 * index as f64;
            write!(text, "FLASER {BEAMS}").expect("a string takes everything");
            for range in self.scan(&ground, *pose, &people[index], &mut random) {
                write!(text, " {range:.2}").expect("a string takes everything");
            }
            for pose in [pose, raw] {
                write!(text, " {:.5} {:.5} {:.6}", pose.x, pose.y, pose.theta)
                    .expect("a string takes everything");
            }
            writeln!(text, " {time:.2} nohost {time:.2}").expect("a string takes everything");
        }
        text
    }

    pub(super) fn log(self) -> Result<LaserLog, Box<dyn Error>> {
        Ok(LaserLog::read(self.to_carmen().as_bytes())?)
    }

    fn scan(&self, ground: &Ground, pose: Pose, people: &[Disc], random: &mut ChaCha8Rng) -> Vec<f64> {
        let bearings: Vec<f64> =
            (0..BEAMS).map(|beam| std::f64::consts::PI * (beam as f64 / (BEAMS - 1) as f64 - 0.5)).collect();
        let exact = ground.surroundings.ranges(pose, &bearings, self.reach, people);
        let noisy = exact.into_iter().map(|range| {
            let error: f64 = StandardNormal.sample(random);
            let is_lost = random.random::<f64>() < ground.dropouts;
            if is_lost { self.reach } else { (range + NOISE * error).clamp(0.01, self.reach) }
        });
        noisy.collect()
    }

    /// Where people are at each pose: they come towards the robot and pass it, on either side.
    fn people_along(&self, truth: &[Pose], random: &mut ChaCha8Rng) -> Vec<Vec<Disc>> {
        const FROM: f64 = 7.0;
        const FASTER: f64 = 2.0;
        let mut coming: Vec<(Pose, f64, f64)> = Vec::new();
        let mut travelled = 0.0;
        let mut before = truth.first().copied().unwrap_or_default();
        let at = |&pose: &Pose| {
            let way = before.between(pose).translation().norm();
            (travelled, before) = (travelled + way, pose);
            if random.random::<f64>() < way / self.people {
                let aside = if random.random() { 1.0 } else { -1.0 } * random.random_range(0.6..0.9);
                coming.push((pose, travelled, aside));
            }
            coming.retain(|(_, since, _)| travelled - since < FROM);
            let person = |&(met, since, aside): &(Pose, f64, f64)| {
                let ahead = Pose::new(FROM - FASTER * (travelled - since), aside, 0.0);
                let at = met.compose(ahead);
                Disc { middle: [at.x, at.y], radius: 0.2 }
            };
            let clear = |disc: &Disc| (disc.middle[0] - pose.x).hypot(disc.middle[1] - pose.y) > 0.4;
            coming.iter().map(person).filter(clear).collect()
        };
        truth.iter().map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trial_is_the_same_again_and_another_one_is_not() {
        let trial = Trial::new(5);
        assert!(trial.to_carmen() == trial.to_carmen());
        assert!(trial.to_carmen() != Trial::new(5 + KINDS.len()).to_carmen());
        assert!(trial.log().unwrap().scans.len() > 100);
    }

    #[test]
    fn people_pass_the_robot() {
        let truth: Vec<Pose> = (0..100).map(|x| Pose::new(f64::from(x) * 0.4, 0.0, 0.0)).collect();
        let trial = Trial { people: 5.0, ..Trial::new(0) };
        let people = trial.people_along(&truth, &mut ChaCha8Rng::seed_from_u64(1));
        let ahead =
            |(pose, discs): (&Pose, &Vec<Disc>)| discs.iter().any(|disc| disc.middle[0] > pose.x + 1.0);
        assert!(truth.iter().zip(&people).filter(|pair| ahead(*pair)).count() > 10);
    }
}
