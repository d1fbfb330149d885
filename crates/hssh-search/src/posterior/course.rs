//! Where odometry alone says that visits are: the way from any visit to any later one.

use hssh_metrics::Pose;

use crate::measured::MeasuredTravel;
use crate::posterior::runs::Runs;
use crate::posterior::way::Way;

/// The ways between all visits by odometry alone. It grows by travels, and a way is composed of as few stretches as have been
/// composed before: the logarithm of its length.
#[derive(Clone, Debug)]
pub(super) struct Course {
    stretches: Runs<Way>,
    /// Where each visit is in the frame of the first one.
    poses: Vec<Pose>,
    /// By visit: the travels before it.
    moments: Vec<Moments>,
}

/// Sums over travels of what they add to the covariance of a position P that comes after them, given as (−y, x), in the frame of the first visit:
/// K + L Pᵀ + P Lᵀ + t P Pᵀ.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    k: [f64; 3],
    l: [f64; 2],
    t: f64,
}

/// What rounding may do to the sums, in parts of their largest terms.
const ROUNDING: f64 = 1e-13;

impl Moments {
    /// One travel more: its errors move what comes after by R e, and turn it about its end.
    fn then(self, step: &Way, from: Pose, to: Pose) -> Self {
        let [xx, xy, yy] = step.turned(from.theta).position();
        let [x, y] = step.turned(from.theta).with_turn();
        let (t, u) = (step.turn_variance, [-to.y, to.x]);
        let k = [
            xx - 2.0 * x * u[0] + t * u[0] * u[0],
            xy - x * u[1] - y * u[0] + t * u[0] * u[1],
            yy - 2.0 * y * u[1] + t * u[1] * u[1],
        ];
        Moments {
            k: [0, 1, 2].map(|index| self.k[index] + k[index]),
            l: [self.l[0] + x - t * u[0], self.l[1] + y - t * u[1]],
            t: self.t + t,
        }
    }

    /// What the travels add up to at a position: xx, xy, yy.
    fn at(&self, Pose { x, y, .. }: Pose) -> [f64; 3] {
        let (Moments { k, l, t }, [p, q]) = (self, [-y, x]);
        [
            k[0] + 2.0 * l[0] * p + t * p * p,
            k[1] + l[0] * q + l[1] * p + t * p * q,
            k[2] + 2.0 * l[1] * q + t * q * q,
        ]
    }

    /// The largest terms of that.
    fn size(&self, Pose { x, y, .. }: Pose) -> f64 {
        let (Moments { k, l, t }, far) = (self, x.hypot(y));
        k[0].abs() + k[2].abs() + 2.0 * l[0].hypot(l[1]) * far + t * far * far
    }
}

impl Course {
    /// Before the first travel.
    pub(super) fn new() -> Self {
        Course { stretches: Runs::new(), poses: vec![Pose::IDENTITY], moments: vec![Moments::default()] }
    }

    /// One travel more.
    pub(super) fn push(&mut self, travel: &MeasuredTravel) {
        let (step, from) = (Way::of(travel), self.poses[self.poses.len() - 1]);
        let to = from.compose(travel.pose);
        self.stretches.push(step, |first, second| first.then(&second));
        self.moments.push(self.moments[self.moments.len() - 1].then(&step, from, to));
        self.poses.push(to);
    }

    /// Where a visit is in the frame of the first one.
    pub(super) fn pose(&self, visit: usize) -> Pose {
        self.poses[visit]
    }

    /// The way from one visit to a later one.
    pub(super) fn way(&self, from: usize, to: usize) -> Way {
        let way = self.stretches.total(from, to, |first, second| first.then(&second));
        way.expect("the later visit comes after so many travels")
    }

    /// The way from one visit to a later one in the axes of the first visit of all, as sums tell it at once. Rounding makes the covariance of its position
    /// larger rather than smaller.
    pub(super) fn about(&self, from: usize, to: usize) -> Way {
        let (there, here) = (self.poses[from], self.poses[to]);
        let (before, all) = (&self.moments[from], &self.moments[to]);
        let [xx, xy, yy] = [0, 1, 2].map(|index| all.at(here)[index] - before.at(here)[index]);
        let margin = ROUNDING * (all.size(here) + before.size(here));
        let t = all.t - before.t;
        let [xt, yt] = [all.l[0] - before.l[0] - t * here.y, all.l[1] - before.l[1] + t * here.x];
        let mean = Pose::new(here.x - there.x, here.y - there.y, here.theta - there.theta);
        Way::new(mean, [xx + margin, xy, yy + margin], [xt, yt], t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hssh_metrics::Covariance;
    use nalgebra::{Matrix3, matrix};

    /// What sums tell is what the composed way tells.
    #[test]
    fn sums_and_ways_agree() {
        let mut course = Course::new();
        for index in 0..60_u32 {
            let at = f64::from(index);
            let root: Matrix3<f64> =
                matrix![0.1 + 0.01 * at, 0.0, 0.0; 0.02, 0.2, 0.0; 0.003 * (at - 20.0), 0.01, 0.05];
            let covariance = Covariance::new(root * root.transpose()).unwrap();
            let pose = Pose::new(3.0 + at, 0.5 * at.sin(), 0.7 * at.cos());
            course.push(&MeasuredTravel { pose, covariance });
        }
        for (from, to) in [(0, 1), (0, 60), (7, 33), (31, 32), (58, 60)] {
            let numbers =
                |way: Way| [way.position().as_slice(), &way.with_turn(), &[way.turn_variance]].concat();
            let way = numbers(course.way(from, to).turned(course.pose(from).theta));
            let about = course.about(from, to);
            for (about, way) in numbers(about).iter().zip(&way) {
                assert!(
                    (about - way).abs() < 1e-6 * (way.abs() + 1.0),
                    "{from} to {to}: {about} is not {way}"
                );
            }
            let turns = || [0.3, -1.0, about.mean.theta].into_iter();
            let least = course.way(from, to).least_half_chi2(turns());
            assert!(!about.certainly_exceeds(turns(), least), "{from} to {to}");
            // Where much is summed up, the margin is larger than what is known of a short way.
            let is_short = to < 35;
            assert!(!is_short || about.certainly_exceeds(turns(), 0.9 * least), "{from} to {to}");
        }
    }
}
