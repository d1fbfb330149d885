//! Whether stated probabilities are what they say: of maps with a probability of 0.8, four of five are right.

/// How many bins from 0 to 1.
const BINS: usize = 10;

/// Maps of about one stated probability.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Bin {
    pub(super) maps: usize,
    pub(super) right: usize,
    sum: f64,
}

impl Bin {
    /// The mean of the stated probabilities.
    pub(super) fn stated(self) -> f64 {
        self.sum / self.maps.max(1) as f64
    }

    /// The part that is right.
    pub(super) fn observed(self) -> f64 {
        self.right as f64 / self.maps.max(1) as f64
    }
}

/// The bins in order, of maps with stated probabilities and whether they are right.
pub(super) fn bins(maps: impl Iterator<Item = (f64, bool)>) -> [Bin; BINS] {
    let mut bins = [Bin::default(); BINS];
    for (stated, is_right) in maps {
        let bin = &mut bins[((stated * BINS as f64) as usize).min(BINS - 1)];
        bin.maps += 1;
        bin.right += usize::from(is_right);
        bin.sum += stated;
    }
    bins
}

/// The mean difference of stated and observed, each bin as heavy as it has maps.
pub(super) fn error(bins: &[Bin]) -> f64 {
    let maps: usize = bins.iter().map(|bin| bin.maps).sum();
    let sum: f64 = bins.iter().map(|bin| bin.maps as f64 * (bin.stated() - bin.observed()).abs()).sum();
    sum / maps.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_fall_into_bins() {
        let bins = bins([(0.0, false), (0.05, true), (0.95, true), (1.0, false)].into_iter());
        assert_eq!((bins[0].maps, bins[0].right, bins[9].maps, bins[9].right), (2, 1, 2, 1));
        assert!((bins[9].stated() - 0.975).abs() < 1e-12);
        assert!((error(&bins) - (0.475 + 0.475) / 2.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_said_right_has_no_error() {
        let maps = (0..100).map(|map| (0.75, map % 4 != 0));
        assert!(error(&bins(maps)) < 1e-12);
        assert_eq!(error(&[]), 0.0);
    }
}
