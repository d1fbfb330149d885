//! How well two points of the way are known to one another: along the shortest way between them by track and closures.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use hssh_metrics::{Covariance, Pose, UncertainPose, UncertaintyError};

/// One step from a point of the way to another.
#[derive(Clone)]
struct Step {
    to: usize,
    /// Metres.
    length: f64,
    motion: UncertainPose,
}

/// Points of the way, and what leads from one to the next.
#[derive(Clone)]
pub(crate) struct Ways {
    steps: Vec<Vec<Step>>,
}

/// What is known of a point from another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    /// How long the way there is, in metres.
    pub(crate) length: f64,
    /// Standard deviation of where it is, in the worst direction: metres.
    pub(crate) across: f64,
}

impl Known {
    /// Nothing.
    const NOT: Known = Known { length: f64::INFINITY, across: f64::INFINITY };

    /// What a way of some length with a covariance leaves to know.
    pub(crate) fn of(length: f64, covariance: &Covariance) -> Self {
        let worst = covariance.matrix().fixed_view::<2, 2>(0, 0).symmetric_eigenvalues().max();
        Known { length, across: worst.max(0.0).sqrt() }
    }
}

impl Ways {
    /// So many points without a way between them.
    pub(crate) fn new(points: usize) -> Self {
        Ways { steps: vec![Vec::new(); points] }
    }

    /// A step that can be gone in both directions, `length` metres long.
    ///
    /// # Errors
    /// If the motion is too uncertain to be turned round.
    pub(crate) fn add(
        &mut self,
        [from, to]: [usize; 2],
        length: f64,
        motion: UncertainPose,
    ) -> Result<(), UncertaintyError> {
        let back = motion.inverse()?;
        self.steps[from].push(Step { to, length, motion });
        self.steps[to].push(Step { to: from, length, motion: back });
        Ok(())
    }

    /// What is known of every point from one of them, which are believed to be at some poses.
    pub(crate) fn from(&self, start: usize, pose: impl Fn(usize) -> Pose) -> Vec<Known> {
        let mut known = vec![Known::NOT; self.steps.len()];
        let mut reached: Vec<Option<UncertainPose>> = vec![None; self.steps.len()];
        let mut lengths = vec![f64::INFINITY; self.steps.len()];
        let mut open = BinaryHeap::new();
        lengths[start] = 0.0;
        known[start] = Known { length: 0.0, across: 0.0 };
        open.push((Reverse(0_u64), start));
        while let Some((Reverse(micrometres), point)) = open.pop() {
            if micrometres as f64 / 1e6 > lengths[point] + 1e-5 {
                continue;
            }
            for step in &self.steps[point] {
                let length = lengths[point] + step.length;
                if length >= lengths[step.to] {
                    continue;
                }
                let mean = pose(point).between(pose(step.to));
                let onward = UncertainPose { mean, covariance: step.motion.covariance };
                let whole = match (point == start, &reached[point]) {
                    (true, _) => Some(onward),
                    (false, Some(way)) => {
                        let way = UncertainPose { mean: pose(start).between(pose(point)), ..*way };
                        way.compose(&onward).ok()
                    }
                    (false, None) => None,
                };
                lengths[step.to] = length;
                known[step.to] = whole.map_or(Known::NOT, |whole| Known::of(length, &whole.covariance));
                reached[step.to] = whole;
                open.push((Reverse((length * 1e6) as u64), step.to));
            }
        }
        known
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A heading that is off by 0.01 after each of ten steps of a metre: what is 10 m ahead is off by the root of
    /// Σ (0.01 k)² aside, and a link that knows better counts instead.
    #[test]
    fn what_is_known_is_what_the_way_leaves() {
        let sigmas =
            |across: f64, around: f64| Covariance::from_standard_deviations(across, across, around).unwrap();
        let step = UncertainPose { mean: Pose::new(1.0, 0.0, 0.0), covariance: sigmas(1e-4, 0.01) };
        let mut ways = Ways::new(12);
        for point in 0..10 {
            ways.add([point, point + 1], 1.0, step).unwrap();
        }
        let pose = |point: usize| Pose::new(point as f64, 0.0, 0.0);
        let known = ways.from(0, pose);
        let aside = (0..10).map(|k| (0.01 * f64::from(k)).powi(2)).sum::<f64>().sqrt();
        assert!((known[10].across - aside).abs() < 1e-4, "{known:?}");
        assert!((known[10].length - 10.0).abs() < 1e-9);
        assert!(known[11].across.is_infinite(), "no way leads there");
        let link = UncertainPose { mean: pose(10), covariance: sigmas(0.02, 0.001) };
        ways.add([0, 10], 1.0, link).unwrap();
        let known = ways.from(0, pose);
        assert!((known[10].across - 0.02).abs() < 1e-6 && known[9].across < 0.03, "{known:?}");
    }
}
