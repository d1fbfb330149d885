//! Laser scans: one sweep of ranges in the robot's frame.

use nalgebra::{Vector2, vector};

/// One sweep of a planar laser, from where the laser sits, in a frame that is turned as the robot is.
#[derive(Clone, PartialEq, Debug)]
pub struct Scan {
    /// Metres along each beam, from right to left; infinite where nothing came back.
    pub ranges: Vec<f64>,
    /// How wide it looks: radians, at most a full turn.
    pub view: f64,
    /// Where the middle of its view is: radians, counterclockwise from straight ahead.
    pub turn: f64,
}

impl Scan {
    /// A sweep from −90° to 90°.
    #[must_use]
    pub fn of_half_turn(ranges: Vec<f64>) -> Self {
        Scan { ranges, view: std::f64::consts::PI, turn: 0.0 }
    }

    /// The direction of a beam in radians, counterclockwise from straight ahead; not wrapped.
    ///
    /// An even number of beams is the sensor's view without its last beam: 180 beams of half a turn are one degree
    /// apart, and so are 181.
    #[must_use]
    pub fn bearing(&self, beam: usize) -> f64 {
        let steps = self.ranges.len() - self.ranges.len() % 2;
        self.view * (beam as f64 / steps.max(1) as f64 - 0.5) + self.turn
    }

    /// The unit vector along a beam, in the robot's frame.
    #[must_use]
    pub fn direction(&self, beam: usize) -> Vector2<f64> {
        let (sin, cos) = self.bearing(beam).sin_cos();
        vector![cos, sin]
    }

    /// The beam that leads nearest to a direction in radians, counterclockwise from straight ahead, if the laser looks there.
    #[must_use]
    pub fn beam_towards(&self, bearing: f64) -> Option<usize> {
        let steps = self.ranges.len() - self.ranges.len() % 2;
        let step = self.view / steps.max(1) as f64;
        let beyond_first = (bearing - self.bearing(0) + 0.5 * step).rem_euclid(std::f64::consts::TAU);
        let beam = (beyond_first / step) as usize;
        (beam < self.ranges.len()).then_some(beam)
    }

    /// The beams that came back from within `reach` metres, with the points they hit in the robot's frame.
    pub fn hits(&self, reach: f64) -> impl Iterator<Item = (usize, Vector2<f64>)> + '_ {
        self.ranges
            .iter()
            .enumerate()
            .filter(move |&(_, &range)| range < reach)
            .map(|(beam, &range)| (beam, self.direction(beam) * range))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beams_span_half_a_turn() {
        let bearing =
            |beams: usize, beam: usize| Scan::of_half_turn(vec![1.0; beams]).bearing(beam).to_degrees();
        for (beams, last) in [(180, 89.0), (181, 90.0), (360, 89.5), (361, 90.0)] {
            assert!((bearing(beams, 0) + 90.0).abs() < 1e-12);
            assert!((bearing(beams, beams - 1) - last).abs() < 1e-12, "{beams}");
            assert!(bearing(beams, beams / 2).abs() < 1e-12);
        }
    }

    /// Of any laser, each beam leads to itself, and beside the first and the last one there is none, unless it looks all around.
    #[test]
    fn beams_are_found_by_where_they_lead() {
        for (beams, view, turn) in
            [(180, 180.0, 0.0), (361, 180.0, 180.0), (1081, 270.0, -40.0), (360, 360.0, 90.0)]
        {
            let scan = Scan {
                view: f64::to_radians(view),
                turn: f64::to_radians(turn),
                ..Scan::of_half_turn(vec![1.0; beams])
            };
            for beam in 0..beams {
                for off in [-0.4, 0.0, 0.4].map(|part| part * scan.view / beams as f64) {
                    assert_eq!(scan.beam_towards(scan.bearing(beam) + off), Some(beam));
                }
            }
            let beside = scan.beam_towards(scan.bearing(0) - 1.2 * scan.view / beams as f64);
            assert_eq!(beside, (view == 360.0).then_some(beams - 1));
        }
    }

    #[test]
    fn a_laser_may_look_to_the_side() {
        let ahead = Scan::of_half_turn(vec![1.0; 181]);
        let left = Scan { turn: std::f64::consts::FRAC_PI_2, ..ahead };
        assert!(left.bearing(0).abs() < 1e-12 && (left.direction(90) - vector![0.0, 1.0]).norm() < 1e-12);
    }

    #[test]
    fn hits_leave_out_what_did_not_come_back() {
        let scan = Scan::of_half_turn(vec![2.0, f64::INFINITY, 9.0, 3.0]);
        let hits: Vec<_> = scan.hits(5.0).collect();
        assert_eq!(hits.iter().map(|hit| hit.0).collect::<Vec<_>>(), [0, 3]);
        assert!((hits[0].1 - vector![0.0, -2.0]).norm() < 1e-12);
    }
}
