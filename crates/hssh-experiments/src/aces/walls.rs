//! The direction of the walls in a laser scan, up to quarter turns.

use std::f64::consts::FRAC_PI_2;

use hssh_local::Scan;

/// Beams this far apart make a chord: long enough not to follow the noise of single ranges.
const CHORD: usize = 3;
/// Chords longer than this, in metres, span a gap and not a wall.
const LONGEST_CHORD: f64 = 1.5;
/// Ranges from here on, in metres, are too sparse to show a wall.
const LONGEST_RANGE: f64 = 20.0;
/// How sharply chords must agree, in radians.
const AGREEMENT: f64 = 1.5 * std::f64::consts::PI / 180.0;
/// How many directions of a quarter turn are tried.
const TRIALS: usize = 900;

/// The direction in the robot's frame, in (−π/4, π/4], to which or across which most of the seen
/// surface runs; `None` if the scan shows no surface.
///
/// Every chord between near beams votes for its direction modulo π/2 with its length. The answer is
/// the mean of the chords near the direction with the most votes, a smooth (Gaussian) count.
pub(super) fn direction(scan: &Scan) -> Option<f64> {
    let chords = chords(scan);
    let votes = |direction: f64| -> f64 {
        chords
            .iter()
            .map(|chord| chord.length * (-0.5 * (chord.off(direction) / AGREEMENT).powi(2)).exp())
            .sum()
    };
    let trials = (0..TRIALS).map(|trial| trial as f64 * FRAC_PI_2 / TRIALS as f64);
    let best = trials.max_by(|&a, &b| votes(a).total_cmp(&votes(b)))?;
    let near = chords.iter().filter(|chord| chord.off(best).abs() <= 2.0 * AGREEMENT);
    let (moment, length) = near.fold((0.0, 0.0), |(moment, length), chord| {
        (moment + chord.length * chord.off(best), length + chord.length)
    });
    (length > 0.0).then(|| modulo_quarter_turn(best + moment / length))
}

struct Chord {
    direction: f64,
    length: f64,
}

impl Chord {
    /// How far the chord is turned against a direction, in (−π/4, π/4].
    fn off(&self, direction: f64) -> f64 {
        modulo_quarter_turn(self.direction - direction)
    }
}

fn chords(scan: &Scan) -> Vec<Chord> {
    let point = |beam: usize| {
        let (sin, cos) = scan.bearing(beam).sin_cos();
        (scan.ranges[beam] * cos, scan.ranges[beam] * sin)
    };
    (CHORD..scan.ranges.len())
        .filter(|&last| scan.ranges[last - CHORD..=last].iter().all(|&range| range < LONGEST_RANGE))
        .map(|last| {
            let ((x, y), (to_x, to_y)) = (point(last - CHORD), point(last));
            Chord { direction: (to_y - y).atan2(to_x - x), length: (to_x - x).hypot(to_y - y) }
        })
        .filter(|chord| chord.length < LONGEST_CHORD)
        .collect()
}

fn modulo_quarter_turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(FRAC_PI_2);
    if turned > FRAC_PI_2 / 2.0 { turned - FRAC_PI_2 } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a robot off the centre of a room of 8 m × 6 m sees that has turned by `heading`.
    fn scan_of_a_room(heading: f64) -> Scan {
        let mut scan = Scan::of_half_turn(vec![0.0; 180]);
        for beam in 0..scan.ranges.len() {
            let (sin, cos) = (heading + scan.bearing(beam)).sin_cos();
            let to_wall = |to: f64, speed: f64| if speed == 0.0 { f64::INFINITY } else { to / speed };
            let x = to_wall(if cos > 0.0 { 5.0 } else { -3.0 }, cos);
            let y = to_wall(if sin > 0.0 { 2.0 } else { -4.0 }, sin);
            scan.ranges[beam] = x.min(y);
        }
        scan
    }

    #[test]
    fn a_turned_robot_sees_the_walls_turned_back() {
        for degrees in [-170.0, -91.0, -45.5, -10.0, 0.0, 3.0, 30.0, 44.0, 100.0] {
            let heading = f64::to_radians(degrees);
            let seen = direction(&scan_of_a_room(heading)).unwrap();
            assert!(modulo_quarter_turn(seen + heading).abs() < 0.2_f64.to_radians(), "{degrees}: {seen}");
        }
    }

    #[test]
    fn open_space_has_no_walls() {
        let mut scan = scan_of_a_room(0.0);
        scan.ranges.fill(50.0);
        assert_eq!(direction(&scan), None);
    }
}
