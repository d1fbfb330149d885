//! What a model of odometry errors is: a rule that turns a true travel into a measured one.

use hssh_causal::Odometry;
use rand_chacha::ChaCha8Rng;

use crate::geometry::Point;

/// How odometry errs on one travel, independently of all others. [`DriftModel`](crate::DriftModel) follows the wheels
/// along the way, [`PolarNoise`](crate::PolarNoise) is the thesis's.
pub trait OdometryNoise {
    /// Checks that every covariance will be positive definite.
    ///
    /// # Errors
    /// With the first field that makes this impossible.
    fn check(&self) -> Result<(), DriftError>;

    /// The measured pose of the last point of `way` as seen from its first, with its covariance; both frames are
    /// aligned with the world. The robot turned by `turn` radians (not negative) before it left.
    fn measure(&self, turn: f64, way: &[Point], random: &mut ChaCha8Rng) -> Odometry;
}

/// Why numbers are no model of noise.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("the noise model's `{field}` is {value}, it must be {range} and finite")]
pub struct DriftError {
    /// The field.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}
