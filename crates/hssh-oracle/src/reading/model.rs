//! The parameters of the model, and the price of an end.

/// What each error is the probability of, each in [0, 1), and what bounds a travel.
#[derive(Clone, PartialEq, Debug)]
pub struct ReadingModel {
    /// μ: an end that is there is not seen on a visit.
    pub missed: f64,
    /// γ: an end that is seen for the first time is not there.
    pub ghost: f64,
    /// ρ: an end that is not there is seen once more.
    pub repeat: f64,
    /// υ: a place is passed without a report.
    pub unreported: f64,
    /// η: on a way where none was seen there is a place.
    pub hidden: f64,
    /// φ: a report is of no place.
    pub false_visit: f64,
    /// τ: the robot turns on the way and comes back.
    pub turned_back: f64,
    /// What one travel may cost, in nats.
    pub limit: f64,
    /// How many places one travel passes without a report at most.
    pub most_passed: u32,
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
            limit: 25.0,
            most_passed: 2,
        }
    }
}

/// What is known about an open end.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub(super) struct Evidence {
    /// k: how often it was shown.
    pub(super) shown: i32,
    /// m: how often it was missed.
    pub(super) missed: i32,
    /// Whether the robot left or came in by it.
    pub(super) travelled: bool,
}

impl ReadingModel {
    /// Every error costs infinitely much.
    pub const EXACT: Self = ReadingModel {
        missed: 0.0,
        ghost: 0.0,
        repeat: 0.0,
        unreported: 0.0,
        hidden: 0.0,
        false_visit: 0.0,
        turned_back: 0.0,
        limit: 25.0,
        most_passed: 2,
    };

    /// The weights of its being real and a ghost.
    fn weights(&self, end: Evidence) -> (f64, f64) {
        if end.travelled {
            return (1.0, 0.0);
        }
        let (k, m) = (end.shown, end.missed);
        let real = (1.0 - self.ghost) * (1.0 - self.missed).powi(k) * self.missed.powi(m);
        let ghost = self.ghost * self.repeat.powi(k - 1) * (1.0 - self.repeat).powi(m);
        (real, ghost)
    }

    pub(super) fn shown_again(&self, end: Evidence) -> f64 {
        let (r, g) = self.weights(end);
        price((r * (1.0 - self.missed) + g * self.repeat) / (r + g))
    }

    pub(super) fn missed(&self, end: Evidence) -> f64 {
        let (r, g) = self.weights(end);
        price((r * self.missed + g * (1.0 - self.repeat)) / (r + g))
    }

    pub(super) fn travelled_first(&self, end: Evidence) -> f64 {
        let (r, g) = self.weights(end);
        price(r / (r + g))
    }

    /// At a place that was visited so often before.
    pub(super) fn first_shown(&self, visits: i32) -> f64 {
        price((self.ghost + self.missed.powi(visits)).min(1.0))
    }

    /// The same of the end by which the robot came in.
    pub(super) fn first_shown_as_entry(&self, visits: i32) -> f64 {
        price(self.missed.powi(visits).min(1.0))
    }
}

/// Minus the natural logarithm of a probability, in nats; never below zero by rounding.
pub(super) fn price(probability: f64) -> f64 {
    (-probability.ln()).max(0.0)
}
