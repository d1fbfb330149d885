//! How often something went wrong, and what is known of its probability.

use std::ops::AddAssign;

/// How many of something there were, and how many of them were wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Count {
    pub(crate) all: u64,
    pub(crate) wrong: u64,
}

impl Count {
    /// Counts one.
    pub(crate) fn add(&mut self, is_wrong: bool) {
        self.all += 1;
        self.wrong += u64::from(is_wrong);
    }

    /// The probability that the next one is wrong, if nothing was known before: (wrong + 1) / (all + 2).
    pub(crate) fn rate(self) -> f64 {
        (self.wrong + 1) as f64 / (self.all + 2) as f64
    }

    /// In which interval that probability lies with a probability of 95%, one fortieth on each side of it.
    pub(crate) fn interval(self) -> [f64; 2] {
        [0.025, 0.975].map(|part| self.quantile(part))
    }

    /// Below which probability of being wrong that part of its distribution lies.
    fn quantile(self, part: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.below(middle) < part { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// How probable it is that the probability of being wrong is below `limit`. It is distributed by Beta(wrong + 1,
    /// all − wrong + 1), and below a limit as probably as more than `wrong` of `all` + 1 trials of the limit's
    /// probability succeed.
    fn below(self, limit: f64) -> f64 {
        let trials = self.all + 1;
        let mut ln_term = trials as f64 * (-limit).ln_1p();
        let mut at_most = ln_term.exp();
        for success in 1..=self.wrong {
            let step = (trials - success + 1) as f64 / success as f64 * limit / (1.0 - limit);
            ln_term += step.ln();
            at_most += ln_term.exp();
        }
        1.0 - at_most
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.all += other.all;
        self.wrong += other.wrong;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_trials_everything_is_as_probable() {
        let none = Count::default();
        assert_eq!(none.rate(), 0.5);
        let [low, high] = none.interval();
        assert!((low - 0.025).abs() < 1e-9 && (high - 0.975).abs() < 1e-9, "{low} {high}");
    }

    /// Without a failure the distribution is 1 − (1 − p)^(n + 1), which can be inverted.
    #[test]
    fn without_a_failure_the_interval_is_known() {
        let count = Count { all: 99, wrong: 0 };
        let [low, high] = count.interval();
        assert!((count.rate() - 1.0 / 101.0).abs() < 1e-12);
        assert!((low - (1.0 - 0.975_f64.powf(0.01))).abs() < 1e-9, "{low}");
        assert!((high - (1.0 - 0.025_f64.powf(0.01))).abs() < 1e-9, "{high}");
    }

    #[test]
    fn the_interval_is_around_the_rate_and_symmetric_at_a_half() {
        let [low, high] = Count { all: 1000, wrong: 500 }.interval();
        assert!((low + high - 1.0).abs() < 1e-9 && (0.46..0.48).contains(&low), "{low}");
    }
}
