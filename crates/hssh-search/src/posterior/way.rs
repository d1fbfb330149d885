//! The way between two visits by odometry alone, composed of shorter ones: very many are, so that it is numbers and no
//! matrices.

use hssh_metrics::{Covariance, Pose, wrap_angle};
use nalgebra::{Matrix3, matrix};

use crate::measured::MeasuredTravel;

/// The largest condition number of a covariance beyond which double precision does not tell two visits apart.
const WORST_CONDITION: f64 = 1e14;

/// The determinant of a covariance, in parts of the square of its diagonal's largest entry, from which on its inverse is good for a bound.
pub(super) const LEAST_DETERMINANT: f64 = 1e-9;

/// By how much a bound has to exceed what it is compared with, so that rounding cannot matter.
pub(super) const MARGIN: f64 = 1.01;

/// Where one visit is in the frame of an earlier one, and how well that is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) mean: Pose,
    xx: f64,
    xy: f64,
    xt: f64,
    yy: f64,
    yt: f64,
    /// The variance of the turn: rad².
    pub(super) turn_variance: f64,
}

impl Way {
    /// A way with the covariance of its position, xx, xy and yy, that of the position with the turn, and the variance of the turn.
    pub(super) fn new(mean: Pose, [xx, xy, yy]: [f64; 3], [xt, yt]: [f64; 2], turn_variance: f64) -> Self {
        Way { mean, xx, xy, xt, yy, yt, turn_variance }
    }

    /// A single travel.
    pub(super) fn of(travel: &MeasuredTravel) -> Self {
        let c = travel.covariance.matrix();
        Way { mean: travel.pose, xx: c.m11, xy: c.m12, xt: c.m13, yy: c.m22, yt: c.m23, turn_variance: c.m33 }
    }

    /// This way and then another one, with the covariance to first order, the errors being independent.
    pub(super) fn then(&self, next: &Way) -> Way {
        let Way { mean, xx, xy, xt, yy, yt, turn_variance: tt } = *self;
        let (s, c) = mean.theta.sin_cos();
        let (x, y) = (c * next.mean.x - s * next.mean.y, s * next.mean.x + c * next.mean.y);
        let next_turned = next.turned(mean.theta);
        // J C Jᵀ with J = [1 0 −y; 0 1 x; 0 0 1], and R C Rᵀ.
        Way {
            mean: Pose::new(mean.x + x, mean.y + y, mean.theta + next.mean.theta),
            xx: xx - 2.0 * y * xt + y * y * tt + next_turned.xx,
            xy: xy + x * xt - y * yt - x * y * tt + next_turned.xy,
            yy: yy + 2.0 * x * yt + x * x * tt + next_turned.yy,
            xt: xt - y * tt + next_turned.xt,
            yt: yt + x * tt + next_turned.yt,
            turn_variance: tt + next.turn_variance,
        }
    }

    /// The same way, its covariance along the axes of a frame in which the present one is turned by that angle. Its mean stays as it is.
    pub(super) fn turned(&self, theta: f64) -> Way {
        let Way { xx, xy, xt, yy, yt, .. } = *self;
        let (s, c) = theta.sin_cos();
        Way {
            xx: c * c * xx - 2.0 * c * s * xy + s * s * yy,
            xy: c * s * (xx - yy) + (c * c - s * s) * xy,
            yy: s * s * xx + 2.0 * c * s * xy + c * c * yy,
            xt: c * xt - s * yt,
            yt: s * xt + c * yt,
            ..*self
        }
    }

    /// Whether the covariance is positive definite and can be inverted: whether double precision tells the two visits apart.
    pub(super) fn is_sound(&self) -> bool {
        let Way { xx, xy, xt, yy, yt, turn_variance: tt, .. } = *self;
        // The covariance of the position where the turn is known, and from it the diagonal of the inverse.
        let (a, b, d) = (xx - xt * xt / tt, xy - xt * yt / tt, yy - yt * yt / tt);
        let determinant = a * d - b * b;
        if !(tt > 0.0 && a > 0.0 && determinant > 0.0) {
            return false;
        }
        let of_turn = (1.0 + (d * xt * xt - 2.0 * b * xt * yt + a * yt * yt) / (determinant * tt)) / tt;
        let largest = xx.max(yy).max(tt) * (a / determinant).max(d / determinant).max(of_turn);
        largest <= WORST_CONDITION
    }

    /// The covariance of the position: xx, xy, yy.
    pub(super) fn position(&self) -> [f64; 3] {
        [self.xx, self.xy, self.yy]
    }

    /// The covariances of the position with the turn.
    pub(super) fn with_turn(&self) -> [f64; 2] {
        [self.xt, self.yt]
    }

    /// χ²/2 of a way that ends where it began, in a frame turned by `turn`, in which every angle of `turns` is one; the
    /// least.
    pub(super) fn least_half_chi2(&self, turns: impl Iterator<Item = f64>) -> f64 {
        let Ok(covariance) = Covariance::new(self.covariance()) else { return 0.0 };
        let information = covariance.information();
        let half_chi2 = |turn: f64| {
            let off = self.mean.compose(Pose::new(0.0, 0.0, -turn));
            let off = nalgebra::vector![off.x, off.y, off.theta];
            0.5 * off.dot(&(information.matrix() * off))
        };
        turns.map(half_chi2).fold(f64::INFINITY, f64::min)
    }

    /// Whether χ²/2 of a way that ends where it began is certainly more than this, in a frame turned by any angle of `turns`. Less is computed than for the
    /// value.
    pub(super) fn certainly_exceeds(&self, mut turns: impl Iterator<Item = f64>, half_chi2: f64) -> bool {
        let Way { mean, xx, xy, xt, yy, yt, turn_variance: tt } = *self;
        // The covariance of the position where the turn is known.
        let (a, b, d) = (xx - xt * xt / tt, xy - xt * yt / tt, yy - yt * yt / tt);
        let (determinant, largest) = (a * d - b * b, a.max(d));
        if determinant.is_nan() || determinant <= LEAST_DETERMINANT * largest * largest {
            return false;
        }
        turns.all(|turn| {
            let off = wrap_angle(mean.theta - turn);
            let (x, y) = (mean.x - xt / tt * off, mean.y - yt / tt * off);
            let chi2 = off * off / tt + (d * x * x - 2.0 * b * x * y + a * y * y) / determinant;
            0.5 * chi2 > MARGIN * half_chi2
        })
    }

    /// χ²/2 of a way that ends where it began, in whatever frame: the least over all turns.
    pub(super) fn half_chi2_of_position(&self) -> f64 {
        let Way { mean: Pose { x, y, .. }, xx, xy, yy, .. } = *self;
        let determinant = xx * yy - xy * xy;
        if determinant > 0.0 { 0.5 * (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant } else { 0.0 }
    }

    fn covariance(&self) -> Matrix3<f64> {
        let Way { xx, xy, xt, yy, yt, turn_variance: tt, .. } = *self;
        matrix![xx, xy, xt; xy, yy, yt; xt, yt, tt]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hssh_metrics::UncertainPose;

    /// The same as compounding with matrices.
    #[test]
    fn ways_are_compounds() {
        let travel = |index: u32| {
            let at = f64::from(index);
            let root = matrix![0.1 + 0.01 * at, 0.0, 0.0; 0.02, 0.2, 0.0; 0.003 * at, 0.01, 0.05];
            let pose = Pose::new(3.0 + at, 0.5 * at.sin(), 0.7 * at.cos());
            MeasuredTravel { pose, covariance: Covariance::new(root * root.transpose()).unwrap() }
        };
        let uncertain = |index| {
            let MeasuredTravel { pose, covariance } = travel(index);
            UncertainPose { mean: pose, covariance }
        };
        let (mut way, mut compound) = (Way::of(&travel(0)), uncertain(0));
        for index in 1..30 {
            way = way.then(&Way::of(&travel(index)));
            assert!(way.is_sound());
            compound = compound.compose(&uncertain(index)).unwrap();
            let expected = compound.covariance.matrix();
            assert!((way.covariance() - expected).amax() <= 1e-12 * expected.amax(), "{index}");
            let off = way.mean.between(compound.mean);
            assert!(off.translation().norm() < 1e-9 && off.theta.abs() < 1e-12);
            let turns = || [0.3, -1.0].into_iter();
            let least = way.least_half_chi2(turns());
            assert!(!way.certainly_exceeds(turns(), least) && way.certainly_exceeds(turns(), 0.98 * least));
            assert!(way.half_chi2_of_position() <= least * (1.0 + 1e-9), "{index}");
        }
    }

    /// The lever arm of a long corridor leaves nothing that double precision can invert.
    #[test]
    fn what_cannot_be_inverted_is_no_way() {
        let covariance = Covariance::from_standard_deviations(1e-4, 1e-4, 1e-2).unwrap();
        let step = Way::of(&MeasuredTravel { pose: Pose::new(1e6, 0.0, 0.0), covariance });
        assert!(step.is_sound() && !step.then(&step).is_sound());
    }
}
