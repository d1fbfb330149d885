//! How the laser of a log is turned against its odometry.

/// By how much the laser is turned to the left against the odometry.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LaserTurn {
    /// Radians.
    pub angle: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

impl LaserTurn {
    /// Whether it is more than a small angle and more than chance.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        /// Radians: half a degree.
        const SMALL: f64 = 0.0087;
        self.angle.abs() > SMALL.max(5.0 * self.sigma)
    }
}
