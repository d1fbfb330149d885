//! Measurements that are possible and yet hardly meant: degrees where radians belong, deviations longer than the travel.

use std::f64::consts::TAU;
use std::fmt;

use crate::{Exploration, Odometry};

/// A heading that is known no better than this many radians is as good as not measured.
const VAGUE_HEADING: f64 = 0.5;
/// A travel may always be known no better than this many metres.
const SHORT: f64 = 1.0;
/// The measured turn may differ from a multiple of a quarter turn by so much, read as degrees, to look like one.
const RIGHT_ANGLE: f64 = 12.0;

/// Something in the odometry of a travel that is worth asking about.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Doubt {
    /// The travel, counted from 0.
    pub travel: usize,
    /// What is asked.
    pub question: Question,
}

/// What is asked about a measurement.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Question {
    /// A turn beyond a full circle: radians as written, and whether it would be about a right angle in degrees.
    Turn(f64, bool),
    /// A heading that is known so badly that its variance may be in degrees: its standard deviation as written.
    Heading(f64),
    /// A position that is known no better than within more than the length of the travel: deviation and length.
    Position(f64, f64),
}

impl Exploration {
    /// What is worth asking about, in the order of the travels: at most one question each.
    #[must_use]
    pub fn doubts(&self) -> Vec<Doubt> {
        let asked = |(travel, odometry): (usize, Option<&Odometry>)| {
            Some(Doubt { travel, question: question(odometry?)? })
        };
        self.travels().iter().map(|travel| travel.odometry.as_ref()).enumerate().filter_map(asked).collect()
    }
}

fn question(odometry: &Odometry) -> Option<Question> {
    let Odometry { x, y, theta, covariance } = odometry;
    let heading = covariance[2][2].sqrt();
    let position = covariance[0][0].max(covariance[1][1]).sqrt();
    let length = x.hypot(*y);
    if theta.abs() > TAU {
        let off = theta.abs().rem_euclid(90.0);
        return Some(Question::Turn(*theta, off.min(90.0 - off) < RIGHT_ANGLE));
    }
    if heading > VAGUE_HEADING {
        return Some(Question::Heading(heading));
    }
    (position > length.max(SHORT)).then_some(Question::Position(position, length))
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "travel {}: ", self.travel + 1)?;
        match self.question {
            Question::Turn(theta, is_right_angle) => {
                let hint = if is_right_angle { ", which would be about a right angle" } else { "" };
                write!(f, "theta is {theta}, more than a full circle in radians: are these degrees{hint}?")
            }
            Question::Heading(deviation) => write!(
                f,
                "the heading is known no better than by {deviation:.1} rad: is its variance in square degrees? hssh takes \
                 square radians"
            ),
            Question::Position(deviation, length) => write!(
                f,
                "the position is known no better than by {deviation:.1} m on a travel of {length:.1} m: is its variance in \
                 square metres?"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(theta: f64, variances: [f64; 3]) -> Option<Question> {
        let mut covariance = [[0.0; 3]; 3];
        (0..3).for_each(|axis| covariance[axis][axis] = variances[axis]);
        question(&Odometry { x: 8.0, y: 0.0, theta, covariance })
    }

    #[test]
    fn degrees_are_asked_about_and_radians_are_not() {
        let usual = [0.04, 0.04, 0.001];
        assert_eq!(asked(1.57, usual), None);
        assert_eq!(asked(-std::f64::consts::PI, usual), None);
        assert_eq!(asked(90.0, usual), Some(Question::Turn(90.0, true)));
        assert_eq!(asked(-182.0, usual), Some(Question::Turn(-182.0, true)));
        assert_eq!(asked(45.0, usual), Some(Question::Turn(45.0, false)));
        assert_eq!(asked(1.57, [0.04, 0.04, 4.0]), Some(Question::Heading(2.0)));
        assert_eq!(asked(1.57, [400.0, 0.04, 0.001]), Some(Question::Position(20.0, 8.0)));
    }
}
