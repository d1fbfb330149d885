//! Wheels that slip: what odometry makes of a motion.

use hssh_metrics::Pose;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// How odometry errs: standard deviations that grow with the root of the way, however it is cut into pieces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Odometer {
    /// Of the distance: metres per root metre.
    pub distance: f64,
    /// Of the heading: radians per root metre.
    pub heading: f64,
    /// Of the heading: radians per root radian turned.
    pub turn: f64,
}

/// Some 2° after 10 m, and as much after a right-angled turn.
impl Default for Odometer {
    fn default() -> Self {
        Odometer { distance: 0.03, heading: 0.01, turn: 0.03 }
    }
}

impl Odometer {
    /// What the wheels report of a motion that followed `twist` (metres, metres, radians).
    pub(super) fn measure(&self, twist: Vector3<f64>, random: &mut ChaCha8Rng) -> Pose {
        let mut error = || -> f64 { StandardNormal.sample(random) };
        let (way, turned) = (twist.x.abs().sqrt(), twist.z.abs().sqrt());
        let distance = twist.x + self.distance * way * error();
        let heading = twist.z + self.heading * way * error() + self.turn * turned * error();
        Pose::exp(Vector3::new(distance, twist.y, heading))
    }
}
