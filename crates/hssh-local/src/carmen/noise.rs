//! How much the ranges of neighboring beams scatter: where they do so by decimetres, walls and ways out are guesses.

use super::error::LogWarning;
use super::raw::RawLog;

/// Walls that are met aslant bend ranges from beam to beam, the more the farther these are apart: with beams farther apart than this, in
/// radians, nothing is said.
const MOST_APART: f64 = 0.036;
/// A second difference of three independent readings has so many times their standard deviation, and a quarter of all of a normal
/// distribution are less than so many of its own. Edges of walls and leaves of trees are among the other three quarters.
const OF_DIFFERENCE: f64 = 2.449_5;
const QUARTER: f64 = 0.318_6;
/// With fewer readings nothing is said.
const LEAST: usize = 1_000;
/// More say no more.
const MOST_SCANS: usize = 200;
/// No laser has such a standard deviation, in metres.
const DOUBTFUL: f64 = 0.12;

impl RawLog {
    /// Warns if ranges scatter as those of no laser do.
    pub(crate) fn check_noise(
        &self,
        geometry: impl Fn(usize) -> (f64, f64),
        max_range: f64,
        warnings: &mut Vec<LogWarning>,
    ) {
        if let Some(sigma) = self.noise(geometry, max_range).filter(|sigma| *sigma > DOUBTFUL) {
            warnings.push(LogWarning::Noisy { sigma });
        }
    }

    /// The standard deviation of a reading from its neighbors', in metres. `geometry` is how each scan looks, view and turn in radians.
    pub(super) fn noise(&self, geometry: impl Fn(usize) -> (f64, f64), max_range: f64) -> Option<f64> {
        let mut differences = Vec::new();
        for (index, scan) in
            self.scans.iter().enumerate().step_by(self.scans.len().div_ceil(MOST_SCANS).max(1))
        {
            if geometry(index).0 > MOST_APART * scan.ranges.len() as f64 {
                continue;
            }
            let came_back = |range: &f64| *range > 0.0 && *range < max_range;
            let threes = scan.ranges.windows(3).filter(|three| three.iter().all(came_back));
            differences.extend(threes.map(|three| (three[0] - 2.0 * three[1] + three[2]).abs()));
        }
        if differences.len() < LEAST {
            return None;
        }
        let quarter = differences.len() / 4;
        let (_, difference, _) = differences.select_nth_unstable_by(quarter, f64::total_cmp);
        Some(*difference / (QUARTER * OF_DIFFERENCE))
    }
}
