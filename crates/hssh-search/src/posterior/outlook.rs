//! What the travels that are left will cost at least, whatever the map: a bound that looks ahead.
//!
//! Two visits that odometry alone keeps apart can be the same place only at the price of a bent layout.
//! So, if χ²/2 of the whole map is to stay below some b, visits that are further apart than b from one
//! another and from all visits before must be at as many new places. Either the layout is bent by more than
//! b, or the new places are paid for.

use hssh_metrics::{Pose, UncertainPose};
use hssh_topology::{Isomorphism, StarId};

use crate::experience::Experience;
use crate::measured::Measured;

/// The least share of a linear estimate of χ² that is taken to be its true value at least. The linear
/// estimate of a rise of χ² holds for small turns; a layout that can turn at will may get away with less.
pub const LINEAR_TRUST: f64 = 0.1;

/// The standard deviation of a heading up to which linear estimates are trusted at all: rad.
const MOST_HEADING_DEVIATION: f64 = 0.3;

/// The share of a linear estimate that can be relied on where a turn is known with that variance, rad².
pub(crate) fn trust(heading_variance: f64) -> f64 {
    if heading_variance <= MOST_HEADING_DEVIATION * MOST_HEADING_DEVIATION { LINEAR_TRUST } else { 0.0 }
}

/// Thresholds of χ²/2: the first, and the factor from one to the next.
const FIRST_THRESHOLD: f64 = 0.5;
const THRESHOLD_FACTOR: f64 = 1.25;
const THRESHOLDS: usize = 40;

/// How many new places the travels that are left need, by travels explained and by χ²/2.
#[derive(Clone, Debug)]
pub(crate) struct Outlook {
    /// Ascending.
    thresholds: Vec<f64>,
    /// By threshold and number of travels explained; the last row holds for any χ².
    new_places: Vec<Vec<u32>>,
}

impl Outlook {
    /// Compares all pairs of visits; `None` as measurements compares their stars only.
    pub(crate) fn of(experience: &Experience, measured: Option<&Measured>) -> Self {
        let price = price_of_sameness(experience, measured);
        let thresholds: Vec<f64> = match measured {
            Some(_) => {
                let next = |&last: &f64| Some(last * THRESHOLD_FACTOR);
                std::iter::successors(Some(FIRST_THRESHOLD), next).take(THRESHOLDS).collect()
            }
            None => Vec::new(),
        };
        let rows = thresholds.iter().copied().chain([f64::MAX]);
        let new_places = rows.map(|threshold| apart(&price, threshold)).collect();
        Outlook { thresholds, new_places }
    }

    /// The least of χ²/2 plus what new places cost, over all maps that may come of one that explains that
    /// many travels and has bent so far by `bend`, its χ²/2. `cost` is that of so many places more.
    pub(crate) fn least(&self, explained: usize, bend: f64, cost: impl Fn(u32) -> f64) -> f64 {
        let mut least = f64::INFINITY;
        let mut from = 0.0_f64; // χ²/2 is between `from` and the next threshold
        for (row, new_places) in self.new_places.iter().enumerate() {
            let to = self.thresholds.get(row).copied().unwrap_or(f64::INFINITY);
            if to >= bend {
                least = least.min(from.max(bend) + cost(new_places[explained]));
                if from.max(bend) + cost(0) >= least {
                    break;
                }
            }
            from = to;
        }
        least
    }
}

/// By how much χ²/2 rises at least if two visits are at the same place, for all pairs (later, earlier).
fn price_of_sameness(experience: &Experience, measured: Option<&Measured>) -> Vec<Vec<f64>> {
    let stars: Vec<StarId> =
        std::iter::once(experience.start).chain(experience.observations.iter().map(|o| o.star)).collect();
    let mut price: Vec<Vec<f64>> = (0..stars.len()).map(|later| vec![0.0; later]).collect();
    for earlier in 0..stars.len() {
        // The later visit in the frame of the earlier one, by odometry along the way between them.
        let mut way: Option<UncertainPose> = None;
        for later in earlier + 1..stars.len() {
            if let Some(measured) = measured {
                let travel = &measured.travels[later - 1];
                let step = UncertainPose { mean: travel.pose, covariance: travel.covariance };
                way = match &way {
                    None => Some(step),
                    // Where double precision does not tell the two apart any more, nothing is claimed.
                    Some(way) => way.compose(&step).ok(),
                };
                if way.is_none() {
                    break;
                }
            }
            let (first, seen) =
                (experience.catalog.star(stars[earlier]), experience.catalog.star(stars[later]));
            let prices = Isomorphism::all(seen, first).map(|phi| match (measured, &way) {
                (Some(measured), Some(way)) => {
                    let turn = measured.frames.turn_between(later, earlier, phi.rotation());
                    trust(way.covariance.matrix()[(2, 2)]) * half_chi2(way, turn)
                }
                _ => 0.0,
            });
            price[later][earlier] = prices.fold(f64::INFINITY, f64::min);
        }
    }
    price
}

/// χ²/2 of a way that ends where it began, in a frame turned by `turn`.
fn half_chi2(way: &UncertainPose, turn: f64) -> f64 {
    let off = way.mean.compose(Pose::new(0.0, 0.0, -turn));
    let off = nalgebra::vector![off.x, off.y, off.theta];
    0.5 * off.dot(&(way.covariance.information().matrix() * off))
}

/// By number of travels explained: how many of the visits that are left are too far from one another and
/// from all visits before, so that each needs a new place of its own. Taken greedily in order.
fn apart(price: &[Vec<f64>], threshold: f64) -> Vec<u32> {
    let visits = price.len();
    let words = visits.div_ceil(64);
    let near: Vec<Vec<u64>> = price
        .iter()
        .map(|row| {
            let mut bits = vec![0; words];
            for (earlier, _) in row.iter().enumerate().filter(|&(_, &price)| price <= threshold) {
                bits[earlier / 64] |= 1 << (earlier % 64);
            }
            bits
        })
        .collect();
    (0..visits)
        .map(|explained| {
            let mut known = vec![0_u64; words];
            (0..=explained).for_each(|visit| known[visit / 64] |= 1 << (visit % 64));
            let mut new_places = 0;
            for visit in explained + 1..visits {
                if near[visit].iter().zip(&known).all(|(near, known)| near & known == 0) {
                    known[visit / 64] |= 1 << (visit % 64);
                    new_places += 1;
                }
            }
            new_places
        })
        .collect()
}
