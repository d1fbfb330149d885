//! By how much odometry turns where the robot goes straight on: wheels of unequal size do so with every metre (Borenstein and Feng, 1996), and
//! how much is learned along the way, where scans show the heading. Where they do not, on a lawn, it is most of what odometry gets wrong.

use hssh_metrics::{Pose, UncertainPose, wrap_angle};

/// How large a bend may be: radians for each metre, standard deviation.
const USUAL: f64 = 0.02;
/// What is off by more than so many standard deviations is something else, as a slip, and counts less.
const SURPRISE: f64 = 2.0;
/// Of what is known of a step's heading in the end, the scans have to show so much.
const SHOWN: f64 = 0.5;

/// The bend of some odometry, as far as it is known: the one state of a Kalman filter over the steps.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Bend {
    /// Radians for each metre by which the robot turns to the left and the odometry does not tell it.
    mean: f64,
    variance: f64,
}

impl Default for Bend {
    /// Nothing is known yet.
    fn default() -> Self {
        Bend { mean: 0.0, variance: USUAL * USUAL }
    }
}

impl Bend {
    /// A motion that odometry tells, straightened.
    pub(super) fn straightened(&self, told: &UncertainPose) -> UncertainPose {
        let way = told.mean.translation();
        let turn = self.mean * way.norm();
        // It grows along the way, of which it turns the chord by half.
        let way = Pose::new(0.0, 0.0, turn / 2.0).rotation() * way;
        UncertainPose {
            mean: Pose::new(way.x, way.y, told.mean.theta + turn),
            covariance: told.covariance.rotated(turn / 2.0),
        }
    }

    /// Learns from a step that odometry tells, and of which `known` is what scans make of it who believed it to be `believed`.
    pub(super) fn learn(&mut self, told: &UncertainPose, believed: &UncertainPose, known: &UncertainPose) {
        let heading = |motion: &UncertainPose| motion.covariance.matrix()[(2, 2)];
        let (before, after) = (heading(believed), heading(known));
        // What the scans show without what was believed before.
        let shown = (1.0 / after - 1.0 / before) * after;
        if shown < SHOWN {
            return;
        }
        let seen = believed.mean.theta + wrap_angle(known.mean.theta - believed.mean.theta) / shown;
        let off = wrap_angle(seen - self.straightened(told).mean.theta);
        let noise = before + after / shown;
        let length = told.mean.translation().norm();
        let expected = length * length * self.variance + noise;
        let surprise = (off.abs() / (SURPRISE * expected.sqrt())).max(1.0);
        let gain = self.variance * length / (length * length * self.variance + noise * surprise * surprise);
        self.mean += gain * off;
        self.variance *= 1.0 - gain * length;
    }
}

#[cfg(test)]
mod tests {
    use hssh_metrics::Covariance;

    use super::*;

    /// A step of 0.5 m straight on, of which odometry tells that it turns, and how well the heading is known.
    fn step(turn: f64, heading: f64) -> UncertainPose {
        let covariance = Covariance::from_standard_deviations(0.05, 0.05, heading).unwrap();
        UncertainPose { mean: Pose::new(0.5, 0.0, turn), covariance }
    }

    /// After so many steps of which odometry tells that each turns by a hundredth of a radian.
    fn learned(steps: usize, known: f64) -> Bend {
        let mut bend = Bend::default();
        for _ in 0..steps {
            let told = step(0.01, 0.04);
            bend.learn(&told, &told, &step(0.0, known));
        }
        bend
    }

    #[test]
    fn what_odometry_gets_wrong_with_every_metre_is_learned() {
        let bend = learned(400, 0.002);
        assert!((bend.mean + 0.02).abs() < 0.002, "{bend:?}");
        assert!(bend.straightened(&step(0.01, 0.04)).mean.theta.abs() < 0.001);
    }

    #[test]
    fn where_scans_show_no_heading_nothing_is_learned() {
        assert_eq!(learned(400, 0.039), Bend::default());
    }

    #[test]
    fn one_slip_is_no_bend() {
        let (mut bend, before) = (learned(100, 0.002), learned(100, 0.002));
        let told = step(0.5, 0.04);
        bend.learn(&told, &told, &step(0.0, 0.002));
        assert!((bend.mean - before.mean).abs() < 0.002, "{before:?} {bend:?}");
    }

    /// Who goes 1 m and turns by a tenth of a radian all along goes along a circle of 10 m.
    #[test]
    fn a_straightened_way_is_as_long_and_ends_where_its_circle_does() {
        let bend = Bend { mean: 0.1, variance: 1e-6 };
        let covariance = Covariance::from_standard_deviations(0.1, 0.1, 0.1).unwrap();
        let told = UncertainPose { mean: Pose::new(1.0, 0.0, 0.0), covariance };
        let Pose { x, y, theta } = bend.straightened(&told).mean;
        assert!((x - 0.1_f64.sin() / 0.1).abs() < 1e-3 && (y - (1.0 - 0.1_f64.cos()) / 0.1).abs() < 1e-3);
        assert!((theta - 0.1).abs() < 1e-12);
    }
}
