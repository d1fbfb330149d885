//! Measurements that are possible and yet hardly meant: degrees where radians belong, deviations longer than the travel.

use std::f64::consts::{PI, TAU};
use std::fmt;

use crate::{Exploration, Odometry, Travel};

/// A heading that is known no better than this many radians is as good as not measured.
const VAGUE_HEADING: f64 = 0.5;
/// A travel may always be known no better than this many metres.
const SHORT: f64 = 1.0;
/// Places are hardly farther from one another than this many metres.
const FAR: f64 = 1_000.0;
/// The measured turn may differ from a multiple of a quarter turn by so much, read as degrees, to look like one.
const RIGHT_ANGLE: f64 = 12.0;
/// A turn agrees with the bearing of the end that the robot came in by if it is no more radians off…
const AGREES: f64 = 0.3;
/// …and contradicts it if it is more than so many.
const CONTRADICTS: f64 = 0.5;
/// So many turns have to contradict their bearings in radians and agree with them in degrees before that is asked about…
const FEWEST: usize = 3;
/// …and so many times as many as agree with them in radians.
const TIMES: usize = 4;

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
    /// A turn that contradicts the bearing of the end that the robot came in by, as many do that would agree with it in degrees: radians as
    /// written, and what the bearing says.
    AgainstBearing(f64, f64),
    /// A heading that is known so badly that its variance may be in degrees: its standard deviation as written.
    Heading(f64),
    /// Travels that are as long as no corridor is: the length of the middle one of all.
    Far(f64),
    /// A position that is known no better than within more than the length of the travel: deviation and length.
    Position(f64, f64),
}

impl Exploration {
    /// What is worth asking about, in the order of the travels: at most one question each.
    #[must_use]
    pub fn doubts(&self) -> Vec<Doubt> {
        let against: Vec<Option<Question>> =
            self.travels().iter().map(|travel| self.against_bearing(travel)).collect();
        let in_degrees = against.iter().flatten().count();
        let in_radians = self.travels().iter().filter(|travel| self.agrees_in_radians(travel)).count();
        let are_degrees = in_degrees >= FEWEST.max(TIMES * in_radians);
        let travels = self.travels().iter().zip(against).enumerate();
        let asked = travels.filter_map(|(number, (travel, against))| {
            let question = question(travel.odometry.as_ref()?);
            Some(Doubt { travel: number, question: question.or(against.filter(|_| are_degrees))? })
        });
        let mut asked: Vec<Doubt> = asked.collect();
        if let Some(doubt) = self.far().filter(|far| asked.iter().all(|doubt| doubt.travel != far.travel)) {
            asked.insert(asked.partition_point(|before| before.travel < doubt.travel), doubt);
        }
        asked
    }

    /// The first travel that goes far, if most do.
    fn far(&self) -> Option<Doubt> {
        let length = |travel: &Travel| travel.odometry.as_ref().map(|odometry| odometry.x.hypot(odometry.y));
        let mut lengths: Vec<f64> = self.travels().iter().filter_map(length).collect();
        lengths.sort_by(f64::total_cmp);
        let middle = lengths.get(lengths.len() / 2).copied().filter(|&middle| middle > FAR)?;
        let travel =
            self.travels().iter().position(|travel| length(travel).is_some_and(|metres| metres > FAR))?;
        Some(Doubt { travel, question: Question::Far(middle) })
    }

    /// How far the turn of a travel is off what the bearing of the end says by which it arrives, as radians and as degrees, and what that
    /// is; nothing if no bearing is known, or if both are about the same turn.
    fn off_bearing(&self, travel: &Travel) -> Option<([f64; 2], f64)> {
        let Odometry { x, y, theta, .. } = *travel.odometry.as_ref()?;
        let bearing = self.star_types()[travel.star.index()].bearings[travel.entry.index()]?;
        // The way back leads out of that end.
        let expected = y.atan2(x) + PI - bearing;
        let off = |turn: f64| wrapped(turn - expected).abs();
        let is_telling = wrapped(theta - theta.to_radians()).abs() > CONTRADICTS;
        is_telling.then(|| ([off(theta), off(theta.to_radians())], wrapped(expected)))
    }

    fn against_bearing(&self, travel: &Travel) -> Option<Question> {
        let ([in_radians, in_degrees], expected) = self.off_bearing(travel)?;
        let is_against = in_radians > CONTRADICTS && in_degrees < AGREES;
        is_against.then_some(Question::AgainstBearing(travel.odometry.as_ref()?.theta, expected))
    }

    fn agrees_in_radians(&self, travel: &Travel) -> bool {
        self.off_bearing(travel).is_some_and(|([in_radians, _], _)| in_radians < AGREES)
    }
}

/// An angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
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
            Question::AgainstBearing(theta, expected) => write!(
                f,
                "theta is {theta}, but the end that the robot came in by says {expected:.2}: are these degrees, in which the two \
                 would agree?"
            ),
            Question::Heading(deviation) => write!(
                f,
                "the heading is known no better than by {deviation:.1} rad: is its variance in square degrees? hssh takes \
                 square radians"
            ),
            Question::Far(middle) => write!(
                f,
                "half of the travels are longer than {middle:.0} m: are x and y millimetres or so? hssh takes metres"
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

    #[test]
    fn kilometres_are_asked_about_if_most_travels_have_them() {
        let asked = |lengths: [f64; 3]| {
            let travels: String = lengths
                .iter()
                .map(|x| format!("(exit: \"0+\", entry: \"0-\", star: \"a\", odometry: (x: {x}, y: 0, theta: 0, covariance: [1, 1, 0.01])), "))
                .collect();
            let text = format!("(stars: {{ \"a\": [\"0+\", \"0-\"] }}, start: \"a\", travels: [{travels}])");
            Exploration::from_ron(&text).unwrap().doubts().iter().map(Doubt::to_string).collect::<Vec<_>>()
        };
        let far = "travel 2: half of the travels are longer than 8000 m: are x and y millimetres or so? hssh takes metres";
        assert_eq!(asked([8.0, 8000.0, 9000.0]), [far]);
        assert_eq!(asked([8.0, 9.0, 9000.0]), [""; 0]);
    }

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

    /// Laps of a square of corridors whose corners have bearings, the turns written as `turn` says.
    fn square(turn: impl Fn(usize) -> f64) -> Exploration {
        let travels: String = (0..8)
            .map(|travel| format!("(exit: \"0+\", entry: \"0-\", star: \"corner\", odometry: (x: 8, y: 0.1, theta: {}, covariance: [0.04, 0.04, 0.001])), ", turn(travel)))
            .collect();
        let corner = "[\"0+ @0\", \"1+ @-90 closed\", \"0- @178\", \"1- @90 closed\"]";
        let text = format!("(stars: {{ \"corner\": {corner} }}, start: \"corner\", travels: [{travels}])");
        Exploration::from_ron(&text).unwrap()
    }

    /// Small turns are told by the bearings.
    #[test]
    fn turns_that_fit_as_degrees_only_are_asked_about() {
        let degrees = [1.5, 3.0, 2.5, 0.0, 2.0, 4.0, 1.0, 5.0];
        let doubts = square(|travel| degrees[travel]).doubts();
        assert_eq!(doubts.len(), 7, "{doubts:?}");
        assert!(doubts.iter().all(|doubt| matches!(doubt.question, Question::AgainstBearing(..))));
        assert!(doubts[0].to_string().contains("are these degrees"), "{}", doubts[0]);
        assert!(square(|travel| degrees[travel].to_radians()).doubts().is_empty());
        // Two turns that are wrong are no reason to ask.
        assert!(square(|travel| if travel < 2 { 3.0 } else { 0.03 }).doubts().is_empty());
    }
}
