//! Whether the odometry turns to the side to which its heading turns: where y is mirrored, or headings count clockwise, it does not.

use super::error::LogWarning;
use super::raw::{Moment, RawLog};

/// Steps count that are at least this part of the usual one.
const LEAST_PART: f64 = 0.5;
/// With fewer steps nothing is said.
const LEAST_STEPS: usize = 30;
/// The way that is driven goes with the mirrored heading if it agrees with it this much, from none to all…
const AGREES: f64 = 0.8;
/// …and with the heading as it stands by so much less.
const CLEAR: f64 = 0.4;

impl RawLog {
    /// Warns if the robot drives where its heading, mirrored, points, and not where it points as it stands. A robot that drives aside or
    /// backward is none of these: it does so whichever way it is turned.
    pub(crate) fn check_handed(&self, warnings: &mut Vec<LogWarning>) {
        let usual = self.usual_step();
        let mut sums = [[0.0; 2]; 2];
        let mut steps = 0;
        for pair in self.trajectory.windows(2) {
            let [one, other]: [&Moment; 2] = [&pair[0], &pair[1]];
            let step = other.pose.translation() - one.pose.translation();
            if step.norm() < LEAST_PART * usual || usual == 0.0 {
                continue;
            }
            let turn = one.pose.between(other.pose).theta;
            let (way, heading) = (step.y.atan2(step.x), one.pose.theta + 0.5 * turn);
            for (sum, angle) in sums.iter_mut().zip([way - heading, way + heading]) {
                let (sin, cos) = f64::sin_cos(angle);
                *sum = [sum[0] + cos, sum[1] + sin];
            }
            steps += 1;
        }
        let [straight, mirrored] = sums.map(|[cos, sin]: [f64; 2]| cos.hypot(sin) / f64::from(steps.max(1)));
        if steps as usize >= LEAST_STEPS && mirrored > AGREES && mirrored - straight > CLEAR {
            warnings.push(LogWarning::OtherHanded);
        }
    }
}
