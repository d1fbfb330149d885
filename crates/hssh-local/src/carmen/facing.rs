//! Whether the scans move as the odometry does: where the laser looks backward or sideways, they do not.
//!
//! Along a straight step the second scan lies on the first one if it is moved by the step, seen from the laser. If the laser
//! is turned on the robot, it lies there only if the step is turned as well. All steps of a log are asked together: along a bare corridor
//! ahead and back look alike, and the few that pass a crossing or near an end decide.

use std::f64::consts::{PI, TAU};

use hssh_metrics::{Pose, wrap_angle};

use super::error::LogWarning;
use super::raw::RawLog;

/// Scans are compared between which the robot went that far, in metres…
const STEPS: std::ops::Range<f64> = 0.5..1.5;
/// …and hardly turned, in radians.
const STRAIGHT: f64 = 0.06;
/// So many scans behind one are tried for such a step.
const WITHIN: usize = 12;
/// More steps than this say no more.
const MOST_STEPS: usize = 120;
/// With fewer steps, nothing is said.
const LEAST_STEPS: usize = 8;
/// Points that are farther apart than so many metres count as so far apart.
const MOST_APART: f64 = 0.3;
/// No more points of a scan are compared.
const MOST_POINTS: usize = 181;
/// Ways to face that are tried, evenly around.
const FACINGS: usize = 36;
/// All that is tried: the last is no step at all, which fits best along bare walls.
const TRIALS: usize = FACINGS + 1;
const STILL: usize = FACINGS;
const AHEAD: usize = 0;
const BACK: usize = FACINGS / 2;
/// A laser that looks elsewhere by less than this is not doubted, in radians: so much wheels slip, or somebody mounts it.
const NEGLIGIBLE: f64 = 0.2;
/// One way to face fits better than another if it does by so many standard errors of the mean over all steps…
const CLEAR: f64 = 5.0;
/// …and another than straight ahead has to leave no more than this part of what straight ahead leaves.
const BETTER: f64 = 0.9;

/// Where the laser was found to look.
pub(super) struct Faced {
    /// By how much the trajectory was turned with it.
    pub(super) turn: Pose,
    /// Whether there are straight steps, and ahead and back look alike along all of them.
    pub(super) is_unclear: bool,
}

impl RawLog {
    /// Turns the trajectory with the laser if scans clearly move as if it looked elsewhere than is taken for granted, as if it was mounted
    /// backward, and they clearly do so no more then. If that does not help, or somebody said how the laser sits, it is only warned of.
    /// `geometry` is how each scan looks: view and turn in radians.
    pub(super) fn face(
        &mut self,
        geometry: impl Fn(usize) -> (f64, f64),
        max_range: f64,
        is_given: bool,
        warnings: &mut Vec<LogWarning>,
    ) -> Faced {
        let as_it_is = |is_unclear: bool| Faced { turn: Pose::IDENTITY, is_unclear };
        let seen = match self.facing(&geometry, max_range) {
            Facing::Ahead => return as_it_is(false),
            Facing::Unknown => return as_it_is(true),
            Facing::Elsewhere(seen) => seen,
        };
        let turn = Pose::new(0.0, 0.0, seen);
        let mut turned = self.clone();
        turned.trajectory.iter_mut().for_each(|moment| moment.pose = moment.pose.compose(turn));
        let is_reckoned = !is_given && matches!(turned.facing(&geometry, max_range), Facing::Ahead);
        warnings.push(LogWarning::Facing { seen, is_reckoned });
        if !is_reckoned {
            return as_it_is(false);
        }
        *self = turned;
        Faced { turn, is_unclear: false }
    }

    fn facing(&self, geometry: impl Fn(usize) -> (f64, f64), max_range: f64) -> Facing {
        let steps = self.straight_steps();
        let chosen = steps.iter().step_by(steps.len().div_ceil(MOST_STEPS).max(1));
        let apart: Vec<[f64; TRIALS]> = chosen
            .filter_map(|&(one, other, step)| {
                let [one, other] =
                    [one, other].map(|scan| Sight::new(&self.scans[scan].ranges, geometry(scan), max_range));
                one.apart_by_facing(&other, step)
            })
            .collect();
        if apart.len() < LEAST_STEPS { Facing::Ahead } else { facing(&apart) }
    }

    /// Scans between which the robot went straight on, and the step between them, none of which overlap.
    fn straight_steps(&self) -> Vec<(usize, usize, Pose)> {
        let mut steps = Vec::new();
        let mut index = 0;
        while let Some(one) = self.scans.get(index) {
            let others = self.scans.iter().enumerate().skip(index + 1).take(WITHIN);
            let mut straight = others.filter_map(|(behind, other)| {
                let step = self.trajectory[one.moment].pose.between(self.trajectory[other.moment].pose);
                let is_step = STEPS.contains(&step.translation().norm()) && step.theta.abs() < STRAIGHT;
                is_step.then_some((behind, step))
            });
            index = match straight.next() {
                Some((behind, step)) => {
                    steps.push((index, behind, step));
                    behind
                }
                None => index + 1,
            };
        }
        steps
    }
}

/// What a laser of some view saw, in a frame that is turned as the robot is.
struct Sight {
    points: Vec<[f64; 2]>,
    half_view: f64,
    turn: f64,
}

impl Sight {
    fn new(ranges: &[f64], (view, turn): (f64, f64), max_range: f64) -> Self {
        let steps = (ranges.len() - ranges.len() % 2).max(1) as f64;
        let beams = ranges.iter().enumerate().step_by(ranges.len().div_ceil(MOST_POINTS).max(1));
        let came_back = beams.filter(|(_, range)| **range > 0.0 && **range < max_range);
        let point = |(beam, range): (usize, &f64)| {
            let (s, c) = (view * (beam as f64 / steps - 0.5) + turn).sin_cos();
            [range * c, range * s]
        };
        Sight { points: came_back.map(point).collect(), half_view: 0.5 * view, turn }
    }

    /// How far the points of these two are apart on average if the laser made that step, for each trial.
    fn apart_by_facing(&self, other: &Sight, step: Pose) -> Option<[f64; TRIALS]> {
        let mut apart = [0.0; TRIALS];
        for (trial, apart) in apart.iter_mut().enumerate() {
            let (facing, scale) = (angle(trial), if trial == STILL { 0.0 } else { 1.0 });
            let turned = Pose::new(0.0, 0.0, -facing).compose(Pose::new(scale * step.x, scale * step.y, 0.0));
            let step = Pose::new(turned.x, turned.y, step.theta);
            let (there, back) = (self.apart(other, step)?, other.apart(self, step.inverse())?);
            *apart = 0.5 * (there + back);
        }
        Some(apart)
    }

    /// How far the points of another sight are from those of this one on average, without those that this one could not
    /// see: a laser that looks ahead sees the walls beside it for the last time, and would always fit ahead.
    fn apart(&self, other: &Sight, step: Pose) -> Option<f64> {
        let moved = other.points.iter().map(|&[x, y]| step.compose(Pose::new(x, y, 0.0)));
        let seen = moved.filter(|at| wrap_angle(at.y.atan2(at.x) - self.turn).abs() <= self.half_view);
        let nearest = seen.map(|at| {
            let squared = self.points.iter().map(|[x, y]| (x - at.x).powi(2) + (y - at.y).powi(2));
            squared.fold(MOST_APART * MOST_APART, f64::min).sqrt()
        });
        let (count, sum) = nearest.fold((0_usize, 0.0), |(count, sum), apart| (count + 1, sum + apart));
        (count > 0).then(|| sum / count as f64)
    }
}

/// Radians from straight ahead, counterclockwise.
fn angle(trial: usize) -> f64 {
    let angle = if trial == STILL { 0.0 } else { TAU * trial as f64 / FACINGS as f64 };
    if angle > PI { angle - TAU } else { angle }
}

/// Which way the laser looks, as the steps tell.
enum Facing {
    Ahead,
    /// Radians from straight ahead, counterclockwise.
    Elsewhere(f64),
    /// Ahead and back look alike.
    Unknown,
}

fn facing(apart: &[[f64; TRIALS]]) -> Facing {
    let mean = |facing: usize| apart.iter().map(|step| step[facing]).sum::<f64>() / apart.len() as f64;
    let is_better = |trial: usize| is_nearer(apart, trial, AHEAD) && mean(trial) < BETTER * mean(AHEAD);
    let facing = (0..FACINGS).min_by(|&a, &b| mean(a).total_cmp(&mean(b))).unwrap_or(AHEAD);
    if is_better(facing) && angle(facing).abs() > NEGLIGIBLE {
        Facing::Elsewhere(angle(facing))
    } else if is_nearer(apart, BACK, AHEAD) {
        // Bare walls fit ahead and back; what little there is besides says back.
        Facing::Elsewhere(PI)
    } else if is_better(STILL) && mean(STILL) < mean(facing) {
        Facing::Unknown
    } else if is_nearer(apart, AHEAD, BACK) {
        Facing::Ahead
    } else {
        Facing::Unknown
    }
}

/// Whether the points lie nearer with one way to face than with another, step by step and beyond chance.
fn is_nearer(apart: &[[f64; TRIALS]], one: usize, other: usize) -> bool {
    let count = apart.len() as f64;
    let nearer = || apart.iter().map(|step| step[other] - step[one]);
    let average = nearer().sum::<f64>() / count;
    let squares: f64 = nearer().map(|nearer| (nearer - average).powi(2)).sum();
    average > CLEAR * (squares / (count - 1.0) / count).sqrt()
}
