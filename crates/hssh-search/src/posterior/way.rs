//! The way between two visits by odometry alone, lengthened travel by travel: all pairs of visits have one, so that it
//! is numbers and no matrices.

use hssh_metrics::{Covariance, Pose};
use nalgebra::{Matrix3, matrix};

use crate::measured::MeasuredTravel;

/// The largest condition number of a covariance beyond which double precision does not tell two visits apart.
const WORST_CONDITION: f64 = 1e14;

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
    /// A single travel.
    pub(super) fn of(travel: &MeasuredTravel) -> Self {
        let c = travel.covariance.matrix();
        Way { mean: travel.pose, xx: c.m11, xy: c.m12, xt: c.m13, yy: c.m22, yt: c.m23, turn_variance: c.m33 }
    }

    /// One travel more, with the covariance to first order, the errors being independent; `None` if double precision
    /// does not bear the result.
    pub(super) fn then(&self, step: &Way) -> Option<Way> {
        let Way { mean, xx, xy, xt, yy, yt, turn_variance: tt } = *self;
        let (s, c) = mean.theta.sin_cos();
        let (x, y) = (c * step.mean.x - s * step.mean.y, s * step.mean.x + c * step.mean.y);
        // J C Jᵀ with J = [1 0 −y; 0 1 x; 0 0 1], and R C Rᵀ.
        let longer = Way {
            mean: Pose::new(mean.x + x, mean.y + y, mean.theta + step.mean.theta),
            xx: xx - 2.0 * y * xt + y * y * tt + c * c * step.xx - 2.0 * c * s * step.xy + s * s * step.yy,
            xy: xy + x * xt - y * yt - x * y * tt + c * s * (step.xx - step.yy) + (c * c - s * s) * step.xy,
            yy: yy + 2.0 * x * yt + x * x * tt + s * s * step.xx + 2.0 * c * s * step.xy + c * c * step.yy,
            xt: xt - y * tt + c * step.xt - s * step.yt,
            yt: yt + x * tt + s * step.xt + c * step.yt,
            turn_variance: tt + step.turn_variance,
        };
        longer.is_sound().then_some(longer)
    }

    /// Whether the covariance is positive definite and can be inverted.
    fn is_sound(&self) -> bool {
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

    /// Whether χ²/2 of a way that ends where it began is certainly more than this, whatever the turn.
    pub(super) fn certainly_exceeds(&self, half_chi2: f64) -> bool {
        let Pose { x, y, .. } = self.mean;
        0.5 * (x * x + y * y) > (1.0 + 1e-6) * half_chi2 * (self.xx + self.yy)
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
            way = way.then(&Way::of(&travel(index))).unwrap();
            compound = compound.compose(&uncertain(index)).unwrap();
            let expected = compound.covariance.matrix();
            assert!((way.covariance() - expected).amax() <= 1e-12 * expected.amax(), "{index}");
            let off = way.mean.between(compound.mean);
            assert!(off.translation().norm() < 1e-9 && off.theta.abs() < 1e-12);
            let least = way.least_half_chi2([0.3, -1.0].into_iter());
            assert!(!way.certainly_exceeds(least), "{index}");
            assert!(way.half_chi2_of_position() <= least * (1.0 + 1e-9), "{index}");
        }
    }

    /// The lever arm of a long corridor leaves nothing that double precision can invert.
    #[test]
    fn what_cannot_be_inverted_is_no_way() {
        let covariance = Covariance::from_standard_deviations(1e-4, 1e-4, 1e-2).unwrap();
        let step = Way::of(&MeasuredTravel { pose: Pose::new(1e6, 0.0, 0.0), covariance });
        assert!(step.then(&step).is_none());
    }
}
