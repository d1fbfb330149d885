//! What the travels that are left will cost at least, whatever the map: a bound that looks ahead.
//!
//! Two visits that odometry alone keeps apart can be the same place only at the price of a bent layout.
//! So, if χ²/2 of the whole map is to stay below some b, visits that are further apart than b from one
//! another and from all visits before must be at as many new places. Either the layout is bent by more than
//! b, or the new places are paid for.

use hssh_metrics::{Pose, UncertainPose};
use hssh_topology::{Olp, StarCatalog, StarId};

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

/// How many new places the travels that are left need, by travels explained and by χ²/2. It grows with the experience.
#[derive(Clone, Debug)]
pub(crate) struct Outlook {
    /// Ascending; the last one is no limit at all.
    thresholds: Vec<f64>,
    /// By threshold and number of travels explained: the visits that are left and need a new place, greedily in order.
    new_places: Vec<Vec<Vec<u32>>>,
    /// By visit: the way from there to the last visit by odometry alone, as long as it tells anything.
    ways: Vec<Option<UncertainPose>>,
}

impl Outlook {
    /// Before the first travel.
    pub(crate) fn new(is_measured: bool) -> Self {
        let next = |&last: &f64| Some(last * THRESHOLD_FACTOR);
        let steps = std::iter::successors(Some(FIRST_THRESHOLD), next);
        let steps = steps.take(if is_measured { THRESHOLDS } else { 0 });
        let thresholds: Vec<f64> = steps.chain([f64::MAX]).collect();
        let new_places = vec![vec![Vec::new()]; thresholds.len()];
        Outlook { thresholds, new_places, ways: vec![None] }
    }

    /// Takes notice of the visits that are new.
    pub(crate) fn observe(&mut self, experience: &Experience, measured: Option<&Measured>) {
        for visit in self.ways.len()..=experience.observations.len() {
            let prices = self.prices_of_sameness(visit, experience, measured);
            for (&threshold, rows) in self.thresholds.iter().zip(&mut self.new_places) {
                let is_near = |earlier: usize| prices[earlier] <= threshold;
                // Where less is explained than the first near visit, only visits at new places can be near.
                let first_near = (0..visit).find(|&earlier| is_near(earlier)).unwrap_or(visit);
                for new_places in &mut rows[..first_near] {
                    if !new_places.iter().any(|&earlier| is_near(earlier as usize)) {
                        new_places.push(visit as u32);
                    }
                }
                rows.push(Vec::new());
            }
        }
    }

    /// By earlier visit: by how much χ²/2 rises at least if the visit is at the same place.
    fn prices_of_sameness(
        &mut self,
        visit: usize,
        experience: &Experience,
        measured: Option<&Measured>,
    ) -> Vec<f64> {
        let travel = measured.map(|measured| &measured.travels[visit - 1]);
        if let Some(travel) = travel {
            let step = UncertainPose { mean: travel.pose, covariance: travel.covariance };
            for way in &mut self.ways {
                // Where double precision does not tell the two visits apart any more, nothing is claimed; nor where the
                // heading is lost, which no travel brings back.
                let longer = way.as_ref().and_then(|way| way.compose(&step).ok());
                *way = longer.filter(|way| trust(way.covariance.matrix()[(2, 2)]) > 0.0);
            }
            if let Some(last) = self.ways.last_mut() {
                *last = Some(step).filter(|way| trust(way.covariance.matrix()[(2, 2)]) > 0.0);
            }
        }
        let price = |(earlier, way): (usize, &Option<UncertainPose>)| {
            let (seen, first) = (experience.star_of(visit), experience.star_of(earlier));
            let prices = rotations(&experience.catalog, seen, first).map(|rotation| match (measured, way) {
                (Some(measured), Some(way)) => {
                    let turn = measured.frames.turn_between(visit, earlier, rotation);
                    trust(way.covariance.matrix()[(2, 2)]) * half_chi2(way, turn)
                }
                _ => 0.0,
            });
            prices.fold(f64::INFINITY, f64::min)
        };
        let prices = self.ways.iter().enumerate().map(price).collect();
        self.ways.push(None);
        prices
    }

    /// The least of χ²/2 plus what new places cost, over all maps that may come of one that explains that
    /// many travels and has bent so far by `bend`, its χ²/2. `cost` is that of so many places more.
    pub(crate) fn least(&self, explained: usize, bend: f64, cost: impl Fn(u32) -> f64) -> f64 {
        let mut least = f64::INFINITY;
        let mut from = 0.0_f64; // χ²/2 is between `from` and the next threshold
        for (&to, new_places) in self.thresholds.iter().zip(&self.new_places) {
            if to >= bend {
                least = least.min(from.max(bend) + cost(new_places[explained].len() as u32));
                if from.max(bend) + cost(0) >= least {
                    break;
                }
            }
            from = to;
        }
        least
    }
}

/// The rotations of all isomorphisms between two stars.
fn rotations(catalog: &StarCatalog, seen: StarId, first: StarId) -> impl Iterator<Item = u32> + '_ {
    let degree = catalog.star(first).degree();
    (0..degree).filter(move |&rotation| catalog.matches(seen, Olp::new(0), first, Olp::new(rotation)))
}

/// χ²/2 of a way that ends where it began, in a frame turned by `turn`.
fn half_chi2(way: &UncertainPose, turn: f64) -> f64 {
    let off = way.mean.compose(Pose::new(0.0, 0.0, -turn));
    let off = nalgebra::vector![off.x, off.y, off.theta];
    0.5 * off.dot(&(way.covariance.information().matrix() * off))
}
