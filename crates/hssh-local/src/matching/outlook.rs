//! What a scan could see: within its view, and not behind what its beams hit.

use hssh_metrics::Pose;
use nalgebra::Vector2;

use crate::scan::Scan;

/// What lies no farther behind a hit than this was in sight, in metres.
const BEHIND: f64 = 0.45;

/// A scan, and where it was taken.
pub(super) struct Outlook {
    pose: Pose,
    scan: Scan,
}

impl Outlook {
    pub(super) fn new(pose: Pose, scan: Scan) -> Self {
        Outlook { pose, scan }
    }

    pub(super) fn pose(&self) -> Pose {
        self.pose
    }

    /// Whether something at a point would have been seen. Where nothing came back, it is not known how far the laser saw.
    pub(super) fn saw(&self, at: Vector2<f64>) -> bool {
        let way = at - self.pose.translation();
        let Some(beam) = self.scan.beam_towards(way.y.atan2(way.x) - self.pose.theta) else { return false };
        let beside = beam.saturating_sub(1)..(beam + 2).min(self.scan.ranges.len());
        let ranges = self.scan.ranges[beside].iter().filter(|range| range.is_finite());
        way.norm() <= ranges.copied().fold(0.0, f64::max) + BEHIND
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A laser at (1, 2) that looks to the left, along y, at a wall 3 m ahead, with nothing behind and no echo from the last quarter.
    #[test]
    fn what_is_behind_walls_or_behind_the_laser_is_out_of_sight() {
        let range = |beam: u32| match beam {
            0..=135 => 3.0 / f64::from(beam).to_radians().sin().max(0.1),
            _ => f64::INFINITY,
        };
        let scan = Scan::of_half_turn((0..181).map(range).collect());
        let outlook = Outlook::new(Pose::new(1.0, 2.0, std::f64::consts::FRAC_PI_2), scan);
        let saw = |x: f64, y: f64| outlook.saw(Vector2::new(x, y));
        assert!(saw(1.0, 4.5) && saw(1.0, 5.3) && saw(3.0, 3.0));
        assert!(!saw(1.0, 6.0) && !saw(1.0, 1.0) && !saw(-2.0, 3.0));
    }
}
