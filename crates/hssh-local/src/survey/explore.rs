//! A survey as an exploration: named stars with bearings, travels with odometry.

use hssh_causal::{Exploration, NamedStar, Odometry, StarType, Travel, check_bearings};
use hssh_metrics::UncertainPose;
use hssh_topology::Star;

use super::error::SurveyError;
use super::visit::{Survey, Visit};
use crate::place::LocalStar;

impl Survey {
    /// The exploration of the visits. Every visit has a star type of its own, for its bearings were
    /// measured in its own frame; the mapper matches stars by their shape, whatever their names.
    ///
    /// # Errors
    /// If the visits make no exploration, as without an entry or an exit.
    pub fn exploration(&self) -> Result<Exploration, SurveyError> {
        let star_types = self.visits.iter().enumerate().map(|(index, visit)| named(index, &visit.star));
        let legs = self.visits.windows(2).zip(&self.travels);
        let travels = legs.enumerate().map(|(index, (pair, motion))| {
            leg(index, pair, motion).ok_or(SurveyError::NoWay { visit: index })
        });
        Ok(Exploration::new(star_types.collect(), StarType(0), travels.collect::<Result<_, _>>()?)?)
    }
}

/// The travel between two visits; `None` if by which ends the robot went is not known.
fn leg(index: usize, pair: &[Visit], motion: &UncertainPose) -> Option<Travel> {
    let covariance = motion.covariance.matrix();
    let odometry = Odometry {
        x: rounded(motion.mean.x, 1e4),
        y: rounded(motion.mean.y, 1e4),
        theta: rounded(motion.mean.theta, 1e5),
        covariance: std::array::from_fn(|row| {
            std::array::from_fn(|column| rounded(covariance[(row, column)], 1e7))
        }),
    };
    Some(Travel {
        exit: pair[0].exit?,
        entry: pair[1].entry?,
        star: StarType(index as u32 + 1),
        odometry: Some(odometry),
    })
}

/// A star under the name of its shape and the number of its visit.
fn named(index: usize, local: &LocalStar) -> NamedStar {
    NamedStar {
        name: format!("{} at visit {}", shape(local), index),
        star: local.star.clone(),
        bearings: told_apart(&local.star, local.bearings.iter().copied()),
    }
}

/// Bearings in hundredths of a degree, without those that do not tell an end from its neighbors: two ways of a hall may lead
/// the same way at first.
fn told_apart(star: &Star, bearings: impl Iterator<Item = f64>) -> Vec<Option<f64>> {
    let rounded = |bearing: f64| Some(rounded(bearing.to_degrees(), 1e2).to_radians());
    let mut told: Vec<Option<f64>> = bearings.map(rounded).collect();
    while let Err(problem) = check_bearings(star, &told) {
        match star.find(problem.olp()).filter(|olp| told[olp.index()].is_some()) {
            Some(olp) => told[olp.index()] = None,
            None => return vec![None; told.len()],
        }
    }
    told
}

/// What people call a crossing of that shape.
fn shape(local: &LocalStar) -> String {
    let star = &local.star;
    let gateways = star.gateways().count();
    let straight = star.gateways().filter(|&olp| star.is_travelable(star.opposite(olp))).count() / 2;
    match (gateways, straight) {
        (1, _) => "dead end".to_owned(),
        (2, 0) => "L".to_owned(),
        (3, 1) => "T".to_owned(),
        (3, 0) => "Y".to_owned(),
        (4, 2) => "+".to_owned(),
        (ways, _) => format!("{ways}-way"),
    }
}

fn rounded(value: f64, digits: f64) -> f64 {
    (value * digits).round() / digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_tell_ends_apart_is_no_bearing() {
        let star: Star = "0+ 1+ 0- 1-".parse().unwrap();
        let degrees = |numbers: [f64; 4]| {
            let told = told_apart(&star, numbers.into_iter().map(f64::to_radians));
            told.into_iter().map(|bearing| bearing.map(|b| b.to_degrees().round())).collect::<Vec<_>>()
        };
        assert_eq!(degrees([90.0, 0.0, -90.0, 180.0]), [Some(90.0), Some(0.0), Some(-90.0), Some(180.0)]);
        assert_eq!(degrees([90.0, 90.0, -90.0, 180.0]), [Some(90.0), None, Some(-90.0), Some(180.0)]);
        assert_eq!(degrees([90.0, 120.0, -90.0, f64::NAN]).iter().flatten().count(), 2);
    }
}
