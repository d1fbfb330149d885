//! Whether the scans move as the odometry does: where the laser looks backward or sideways, or its beams come in the other
//! order, they do not.

use std::f64::consts::{FRAC_PI_2, PI};

use hssh_metrics::Pose;

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};

/// Scans are compared between which the robot went that far, in metres…
const STEPS: std::ops::Range<f64> = 0.3..1.5;
/// …and hardly turned, in radians.
const STRAIGHT: f64 = 0.06;
/// So many scans behind one are tried for such a step.
const WITHIN: usize = 12;
/// More pairs than this say no more.
const MOST_PAIRS: usize = 60;
/// With fewer pairs that tell, nothing is said.
const LEAST_PAIRS: usize = 8;
/// Points that are farther apart than so many metres count as so far apart.
const MOST_APART: f64 = 0.3;
/// A pair tells if the points lie nearer with the best way to face than with the next by so many metres in sum: the
/// walls along a corridor fit whichever way, what stands across it does not.
const CLEAR: f64 = 1.5;
/// Ways to face are doubted if so many of the pairs that tell are for another one.
const DOUBTFUL: f64 = 0.8;
/// Where the laser may look, as seen from the robot: ahead first.
const FACINGS: [f64; 4] = [0.0, PI, FRAC_PI_2, -FRAC_PI_2];

impl RawLog {
    /// Warns if scans move as if the laser looked elsewhere than ahead, with that view and place of it on the robot.
    pub(super) fn check_facing(&self, view: f64, max_range: f64, warnings: &mut Vec<LogWarning>) {
        let step = |one: &RawScan, other: &RawScan| {
            let step = self.trajectory[one.moment].pose.between(self.trajectory[other.moment].pose);
            let is_step = STEPS.contains(&step.translation().norm()) && step.theta.abs() < STRAIGHT;
            is_step.then_some(step)
        };
        let pairs = self.scans.iter().enumerate().filter_map(|(index, one)| {
            let others = self.scans[index + 1..].iter().take(WITHIN);
            others.filter_map(|other| Some((one, other, step(one, other)?))).next_back()
        });
        let pairs: Vec<_> = pairs.collect();
        let chosen = pairs.iter().step_by(pairs.len().div_ceil(MOST_PAIRS).max(1));
        let points = |scan: &RawScan| points(&scan.ranges, view, max_range);
        let told = chosen.filter_map(|(one, other, step)| facing(&points(one), &points(other), *step));
        let mut votes = [0_usize; FACINGS.len()];
        told.for_each(|facing| votes[facing] += 1);
        let all: usize = votes.iter().sum();
        let most = (0..FACINGS.len()).max_by_key(|&facing| votes[facing]).unwrap_or_default();
        if all >= LEAST_PAIRS && most != 0 && votes[most] as f64 >= DOUBTFUL * all as f64 {
            warnings.push(LogWarning::Facing { seen: FACINGS[most] });
        }
    }
}

/// What a laser of that view saw, in its own frame.
fn points(ranges: &[f64], view: f64, max_range: f64) -> Vec<[f64; 2]> {
    let steps = (ranges.len() - ranges.len() % 2).max(1) as f64;
    let beams = ranges.iter().enumerate().filter(|(_, range)| **range > 0.0 && **range < max_range);
    let point = |(beam, range): (usize, &f64)| {
        let (s, c) = (view * (beam as f64 / steps - 0.5)).sin_cos();
        [range * c, range * s]
    };
    beams.map(point).collect()
}

/// Which way the laser looks, if these two scans tell, between which the robot made that step.
fn facing(first: &[[f64; 2]], second: &[[f64; 2]], step: Pose) -> Option<usize> {
    let off = |facing: &f64| {
        let turned = Pose::new(0.0, 0.0, -facing).compose(Pose::new(step.x, step.y, 0.0));
        let step = Pose::new(turned.x, turned.y, step.theta);
        let moved = second.iter().step_by(2).map(|&[x, y]| step.compose(Pose::new(x, y, 0.0)));
        let apart = |at: Pose| {
            let squared = first.iter().map(|[x, y]| (x - at.x).powi(2) + (y - at.y).powi(2));
            squared.fold(MOST_APART * MOST_APART, f64::min).sqrt()
        };
        moved.map(apart).sum::<f64>()
    };
    let off = FACINGS.map(|facing| off(&facing));
    let best = (0..off.len()).min_by(|&a, &b| off[a].total_cmp(&off[b]))?;
    let worst = off.iter().copied().fold(0.0, f64::max);
    // The next best has to be clearly worse, too: along a bare corridor ahead and back look alike.
    let next =
        (0..off.len()).filter(|&facing| facing != best).map(|facing| off[facing]).fold(worst, f64::min);
    (next - off[best] > CLEAR).then_some(best)
}
