//! How often perception errs, and what each error costs.

use serde::{Deserialize, Serialize};

/// How probable the errors of perception are (docs/readings.md). What an error costs is minus the logarithm of its probability: nats.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ReadingModel {
    /// An end that is there is not seen on a visit.
    pub missed: f64,
    /// An end that is seen for the first time is not there.
    pub ghost: f64,
    /// An end that is not there is seen once more.
    pub repeat: f64,
    /// A place is passed without a report.
    pub unreported: f64,
    /// There is a place on a way where none was seen.
    pub hidden: f64,
    /// A report is of no place.
    pub false_visit: f64,
    /// The robot turns on the way and comes back.
    pub turned_back: f64,
    /// What one travel may cost at most: nats.
    pub limit: f64,
    /// How many places one travel may pass unreported.
    pub most_passed: u32,
}

/// A model that defines no prices.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum ReadingModelError {
    /// A probability is none.
    #[error("{name} is {value}: it must be a probability below 1")]
    Probability {
        /// The parameter.
        name: &'static str,
        /// What it is.
        value: f64,
    },
    /// The limit is no price.
    #[error("the limit of one travel is {0}: it must be at least 0 nats")]
    Limit(f64),
}

impl ReadingModel {
    /// Perception does not err: every error costs infinitely much.
    pub const EXACT: ReadingModel = ReadingModel {
        missed: 0.0,
        ghost: 0.0,
        repeat: 0.0,
        unreported: 0.0,
        hidden: 0.0,
        false_visit: 0.0,
        turned_back: 0.0,
        limit: 12.0,
        most_passed: 0,
    };

    /// Checks that the numbers are what they stand for.
    ///
    /// # Errors
    /// With the first that is not.
    pub fn check(&self) -> Result<(), ReadingModelError> {
        let probabilities = [
            ("missed", self.missed),
            ("ghost", self.ghost),
            ("repeat", self.repeat),
            ("unreported", self.unreported),
            ("hidden", self.hidden),
            ("false_visit", self.false_visit),
            ("turned_back", self.turned_back),
        ];
        match probabilities.into_iter().find(|(_, value)| !(0.0..1.0).contains(value)) {
            Some((name, value)) => Err(ReadingModelError::Probability { name, value }),
            None if self.limit >= 0.0 => Ok(()),
            None => Err(ReadingModelError::Limit(self.limit)),
        }
    }
}

impl Default for ReadingModel {
    fn default() -> Self {
        ReadingModel {
            missed: 0.10,
            ghost: 0.03,
            repeat: 0.20,
            unreported: 0.10,
            hidden: 0.10,
            false_visit: 0.05,
            turned_back: 0.05,
            limit: 12.0,
            most_passed: 2,
        }
    }
}

/// Minus the logarithm of a probability: nats, never negative.
pub(super) fn nats(probability: f64) -> f64 {
    -probability.min(1.0).ln()
}

/// What was seen of an open end so far.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub struct Sightings {
    /// On how many visits it was seen.
    pub shown: u32,
    /// On how many it was not, since its place is known.
    pub missed: u32,
    /// Whether the robot left or came in by it: then it is there.
    pub travelled: bool,
}

impl Sightings {
    /// The weights with which the end is real, and a ghost.
    fn weights(self, model: &ReadingModel) -> (f64, f64) {
        if self.travelled || self.shown == 0 {
            return (1.0, 0.0);
        }
        let power = |base: f64, exponent: u32| base.powi(exponent as i32);
        let real =
            (1.0 - model.ghost) * power(1.0 - model.missed, self.shown) * power(model.missed, self.missed);
        let ghost =
            model.ghost * power(model.repeat, self.shown - 1) * power(1.0 - model.repeat, self.missed);
        (real, ghost)
    }

    /// What it costs that the end is seen once more.
    pub(super) fn price_of_shown(self, model: &ReadingModel) -> f64 {
        let (real, ghost) = self.weights(model);
        nats((real * (1.0 - model.missed) + ghost * model.repeat) / (real + ghost))
    }

    /// What it costs that the end is not seen.
    pub(super) fn price_of_missed(self, model: &ReadingModel) -> f64 {
        let (real, ghost) = self.weights(model);
        nats((real * model.missed + ghost * (1.0 - model.repeat)) / (real + ghost))
    }

    /// What it costs that the robot goes by the end: nothing if it did before.
    pub(super) fn price_of_travel(self, model: &ReadingModel) -> f64 {
        let (real, ghost) = self.weights(model);
        nats(real / (real + ghost))
    }
}

impl ReadingModel {
    /// What it costs that an end is seen for the first time at a place that was visited so often.
    pub(super) fn price_of_new_end(&self, visits: u32) -> f64 {
        nats(self.ghost + self.missed.powi(visits as i32))
    }

    /// The same if the robot came in by the end: it is there.
    pub(super) fn price_of_new_entry(&self, visits: u32) -> f64 {
        nats(self.missed.powi(visits as i32))
    }

    /// What it costs to pass so many places without a report.
    pub(super) fn price_of_passes(&self, times: u32) -> f64 {
        if times == 0 { 0.0 } else { f64::from(times) * nats(self.unreported) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_seen_often_is_believed() {
        let model = ReadingModel::default();
        let seen = |shown, missed| Sightings { shown, missed, travelled: false };
        assert!(seen(5, 0).price_of_missed(&model) > seen(1, 0).price_of_missed(&model));
        assert!(seen(1, 5).price_of_missed(&model) < 0.3, "what was missed five times is a ghost");
        assert!(seen(1, 5).price_of_travel(&model) > 5.0, "and nobody leaves by a ghost");
        let travelled = Sightings { travelled: true, ..seen(1, 5) };
        assert!((travelled.price_of_missed(&model) - 0.1_f64.ln().abs()).abs() < 1e-12);
    }

    #[test]
    fn without_errors_what_is_right_is_free_and_all_else_is_not() {
        let seen = Sightings { shown: 3, missed: 0, travelled: false };
        let exact = ReadingModel::EXACT;
        assert_eq!(seen.price_of_shown(&exact).abs(), 0.0);
        assert_eq!(seen.price_of_travel(&exact).abs(), 0.0);
        assert_eq!(seen.price_of_missed(&exact), f64::INFINITY);
        assert_eq!(exact.price_of_new_end(2), f64::INFINITY);
        assert_eq!(exact.price_of_passes(1), f64::INFINITY);
    }

    #[test]
    fn what_is_no_probability_is_refused() {
        assert!(ReadingModel::default().check().is_ok());
        assert!(ReadingModel { missed: f64::NAN, ..ReadingModel::default() }.check().is_err());
        assert!(ReadingModel { ghost: 1.0, ..ReadingModel::default() }.check().is_err());
        assert!(ReadingModel { limit: -1.0, ..ReadingModel::default() }.check().is_err());
    }
}
