//! What is still to come: how many of the visits ahead need new places unless the layout bends.
//!
//! Two visits that odometry keeps apart are one place only if the travels between them bend. The certificate's format says
//! how much that costs at least; the part of it that is a promise is tried here, pair by pair, on the single loop.

use nalgebra::{Matrix3, Vector3};

use crate::frames::turn;
use crate::pose::{Pose, wrap};
use crate::route::Route;

/// Of the bend that the linear model promises, the share that is counted.
const COUNTED: f64 = 0.1;
/// Of the bend of a loop of at most so many travels, laid out by itself, the share that is counted if it is more than that.
const LOOP_COUNTED: f64 = 0.9;
const LONGEST_LOOP: usize = 100;
/// No promise is counted where the turn is known to no better than this, in radians.
const VAGUE_TURN: f64 = 0.3;

/// The bends at which the future is looked at: 0.5 · 1.25^k, and everything.
pub(crate) fn thresholds() -> Vec<f64> {
    (0..40).map(|k| 0.5 * 1.25_f64.powi(k)).chain([f64::INFINITY]).collect()
}

/// Which visits can be one place for which bend.
pub(crate) struct Outlook {
    /// By later and earlier visit: the bend that sameness costs at least; infinite if their stars differ.
    prices: Vec<Vec<f64>>,
    thresholds: Vec<f64>,
    /// By threshold and visit, once asked for.
    needed: Vec<Vec<Option<usize>>>,
    /// How many promises the loops did not keep and were lowered.
    pub(crate) lowered: usize,
}

impl Outlook {
    /// Looks at all pairs of visits; without odometry only their stars keep visits apart.
    pub(crate) fn new(route: &Route, bearings: &[Vec<f64>], measured: bool) -> Outlook {
        let thresholds = if measured { thresholds() } else { vec![f64::INFINITY] };
        let visits = route.visits.len();
        let mut outlook = Outlook {
            prices: (0..visits).map(|later| vec![f64::INFINITY; later]).collect(),
            needed: vec![vec![None; visits]; thresholds.len()],
            thresholds,
            lowered: 0,
        };
        for earlier in 0..visits {
            let mut way = Way::default();
            for later in earlier + 1..visits {
                if measured {
                    way.extend(route, later - 1);
                }
                let (seen, kept) = (route.visits[later], route.visits[earlier]);
                for rotation in route.isomorphisms(seen, kept) {
                    let turn = turn(&bearings[seen], &bearings[kept], rotation);
                    let price = if measured { outlook.price(&way, turn) } else { 0.0 };
                    let least = &mut outlook.prices[later][earlier];
                    *least = least.min(price);
                }
            }
        }
        outlook
    }

    /// The share of the promise that counts, or that of the loop's bend if it is short and that is more; what the loop truly bends by if that is less.
    fn price(&mut self, way: &Way, turn: f64) -> f64 {
        let promised = way.counted_promise(turn);
        if promised <= 0.0 {
            return 0.0;
        }
        let kept = way.least_bend(turn);
        self.lowered += usize::from(kept < promised);
        let of_loop = if way.travels.len() <= LONGEST_LOOP { LOOP_COUNTED * kept } else { 0.0 };
        promised.max(of_loop).min(kept)
    }

    /// The thresholds with the one before each.
    pub(crate) fn intervals(&self) -> impl Iterator<Item = (usize, f64, f64)> + '_ {
        let before = std::iter::once(0.0).chain(self.thresholds.iter().copied());
        before.zip(&self.thresholds).enumerate().map(|(k, (before, &threshold))| (k, before, threshold))
    }

    /// N(k, d): how many visits after visit `explained` need places of their own if χ²/2 stays within threshold `k`.
    pub(crate) fn new_places(&mut self, k: usize, explained: usize) -> usize {
        if let Some(count) = self.needed[k][explained] {
            return count;
        }
        let threshold = self.thresholds[k];
        let mut known: Vec<usize> = (0..=explained).collect();
        let mut count = 0;
        for visit in explained + 1..self.prices.len() {
            let prices = &self.prices[visit];
            // Stars that differ are never one place, whatever the bend.
            if known.iter().all(|&other| prices[other] > threshold || prices[other].is_infinite()) {
                count += 1;
                known.push(visit);
            }
        }
        self.needed[k][explained] = Some(count);
        count
    }
}

/// The way from one visit to a later one by odometry alone.
#[derive(Default)]
struct Way {
    travels: Vec<(Pose, Matrix3<f64>, Matrix3<f64>)>,
    mean: Option<Pose>,
    covariance: Matrix3<f64>,
}

impl Way {
    fn extend(&mut self, route: &Route, travel: usize) {
        let motion = route.legs[travel].motion.as_ref();
        let motion = motion.expect("odometry is only made use of if every travel has it");
        let information = motion.covariance.try_inverse().expect("a covariance is positive definite");
        let mean = self.mean.unwrap_or(Pose::ORIGIN);
        let [by_mean, by_motion] = mean.compose_derivatives(motion.pose);
        self.covariance = by_mean * self.covariance * by_mean.transpose()
            + by_motion * motion.covariance * by_motion.transpose();
        self.mean = Some(mean.compose(motion.pose));
        self.travels.push((motion.pose, motion.covariance, information));
    }

    /// The least bend, to first order and in part, if the way comes back to where it began, turned by `turn`.
    fn counted_promise(&self, turn: f64) -> f64 {
        if self.covariance[(2, 2)] > VAGUE_TURN * VAGUE_TURN {
            return 0.0;
        }
        let mean = self.mean.unwrap_or(Pose::ORIGIN);
        let miss = Vector3::new(mean.x, mean.y, wrap(mean.theta - turn));
        let bend =
            self.covariance.cholesky().map_or(0.0, |decomposed| 0.5 * miss.dot(&decomposed.solve(&miss)));
        COUNTED * bend
    }

    /// χ²/2 of a layout of this one loop, descended to: an upper bound of the least, since the loop is closed exactly.
    ///
    /// Each step bends the travels as little as the linearized condition allows that the loop closes.
    fn least_bend(&self, turn: f64) -> f64 {
        const MOST_STEPS: usize = 40;
        let target = Pose::new(0.0, 0.0, turn);
        let mut parts: Vec<Pose> = self.travels.iter().map(|(tau, ..)| *tau).collect();
        let mut least = self.closed_bend(&parts, target);
        for _ in 0..MOST_STEPS {
            let mut corners = vec![Pose::ORIGIN];
            for part in &parts {
                corners.push(corners[corners.len() - 1].compose(*part));
            }
            let end = corners[parts.len()];
            let mut miss = end.minus(target);
            let mut stiffness = Matrix3::zeros();
            let mut effects = Vec::with_capacity(parts.len());
            for ((part, (tau, covariance, _)), corner) in
                parts.iter().zip(&self.travels).zip(corners.windows(2))
            {
                let effect = corner[1].compose_derivatives(corner[1].sees(end))[0]
                    * corner[0].compose_derivatives(*part)[1];
                let back = Vector3::new(tau.x - part.x, tau.y - part.y, tau.theta - part.theta);
                miss += effect * back;
                stiffness += effect * covariance * effect.transpose();
                effects.push(effect);
            }
            let Some(decomposed) = stiffness.cholesky() else { break };
            let force = decomposed.solve(&miss);
            for ((part, (tau, covariance, _)), effect) in parts.iter_mut().zip(&self.travels).zip(&effects) {
                let bent = covariance * effect.transpose() * force;
                *part = Pose::new(tau.x - bent.x, tau.y - bent.y, tau.theta - bent.z);
            }
            let now = self.closed_bend(&parts, target);
            let settled = (now - least).abs() <= 1e-9 * (1.0 + least);
            least = least.min(now);
            if settled {
                break;
            }
        }
        least
    }

    /// χ²/2 if the last travel closes the loop, wherever the others lead.
    fn closed_bend(&self, parts: &[Pose], target: Pose) -> f64 {
        let mut corner = Pose::ORIGIN;
        let mut bend = 0.0;
        for (index, (part, (tau, _, information))) in parts.iter().zip(&self.travels).enumerate() {
            let part = if index + 1 == parts.len() { corner.sees(target) } else { *part };
            let error = part.minus(*tau);
            bend += 0.5 * error.dot(&(information * error));
            corner = corner.compose(part);
        }
        bend
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::{Factor, descend};

    /// The loop as a pose graph has the same least bend as the loop as a chain with a condition.
    #[test]
    fn a_loop_bends_as_its_pose_graph_does() {
        let covariance = Matrix3::new(0.04, 0.01, 0.001, 0.01, 0.09, 0.0, 0.001, 0.0, 0.002);
        let information = covariance.try_inverse().unwrap();
        let taus: Vec<Pose> = (0..5)
            .map(|k| Pose::new(6.0 + 0.4 * f64::from(k), 0.2 - 0.1 * f64::from(k), 1.3 + 0.02 * f64::from(k)))
            .collect();
        let turn = 0.2;
        let way = Way {
            travels: taus.iter().map(|&tau| (tau, covariance, information)).collect(),
            mean: None,
            covariance,
        };
        // The last travel leads to the first place, whose frame the last visit sees turned.
        let factors: Vec<Factor> = taus
            .iter()
            .enumerate()
            .map(|(from, &tau)| {
                let last = from == 4;
                let tau = if last { tau.compose(Pose::new(0.0, 0.0, -turn)) } else { tau };
                Factor { from, to: (from + 1) % 5, tau, covariance, information }
            })
            .collect();
        let mut poses = vec![Pose::ORIGIN];
        for tau in &taus[..4] {
            poses.push(poses[poses.len() - 1].compose(*tau));
        }
        let graph = descend(poses, &factors).bend;
        assert!((way.least_bend(turn) - graph).abs() < 1e-6 * graph, "{} {graph}", way.least_bend(turn));
    }
}
