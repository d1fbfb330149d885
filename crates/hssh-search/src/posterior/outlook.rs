//! What the travels that are left will cost at least, whatever the map: a bound that looks ahead.
//!
//! Two visits that odometry alone keeps apart can be the same place only at the price of a bent layout.
//! So, if χ²/2 of the whole map is to stay below some b, visits that are further apart than b from one
//! another and from all visits before must be at as many new places. Either the layout is bent by more than
//! b, or the new places are paid for.

use std::collections::BTreeMap;
use std::ops::Range;

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

/// Which visits can have been to one place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Sameness {
    /// Those that show isomorphic stars.
    Isomorphic,
    /// All: perception may have erred.
    AnyReading,
}

/// How many new places the travels that are left need, by travels explained and by χ²/2. It grows with the experience.
#[derive(Clone, Debug)]
pub(crate) struct Outlook {
    sameness: Sameness,
    /// Ascending; the last one is no limit at all.
    thresholds: Vec<f64>,
    /// By threshold: the visits that need a new place.
    needs: Vec<Needs>,
    /// How many visits there are.
    visits: usize,
    /// The earlier visits that odometry alone still tells something about, in order, each with the way from there to the last visit.
    ways: Vec<(usize, UncertainPose)>,
    /// By star: the visits to it that odometry tells nothing about any more, in order.
    lost: BTreeMap<StarId, Vec<usize>>,
}

/// Which visits need a new place if χ²/2 stays below a threshold, by the number of travels explained: greedily in order, each visit
/// that is near no explained one and near none that needs a place before it.
#[derive(Clone, Debug, Default)]
struct Needs {
    /// By visit: the numbers of travels explained with which it needs a place, in ascending intervals.
    with: Vec<Vec<Range<usize>>>,
    /// By number of travels explained: how many visits need one.
    counts: Vec<u32>,
}

impl Needs {
    /// Adds a visit that is near those earlier ones, in ascending order.
    fn push(&mut self, near: impl Iterator<Item = usize>) {
        let visit = self.with.len();
        let mut near = near.peekable();
        // Where less is explained than the first near visit, only visits at new places can be near.
        let first_near = near.peek().copied().unwrap_or(visit);
        let mut with = Vec::new();
        with.extend((first_near > 0).then_some(0..first_near));
        while !with.is_empty()
            && let Some(earlier) = near.next()
        {
            with = without(&with, &self.with[earlier]);
        }
        for interval in &with {
            for count in &mut self.counts[interval.clone()] {
                *count += 1;
            }
        }
        self.with.push(with);
        self.counts.push(0);
    }
}

/// Ascending intervals without what is in others.
fn without(intervals: &[Range<usize>], taken: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut left = Vec::with_capacity(intervals.len());
    let mut taken = taken.iter().peekable();
    for interval in intervals {
        let mut from = interval.start;
        while let Some(next) = taken.peek().filter(|next| next.start < interval.end) {
            if from < next.start {
                left.push(from..next.start);
            }
            from = from.max(next.end);
            if next.end > interval.end {
                break; // it may take from the following interval, too
            }
            taken.next();
        }
        if from < interval.end {
            left.push(from..interval.end);
        }
    }
    left
}

impl Outlook {
    /// Before the first travel.
    pub(crate) fn new(is_measured: bool, sameness: Sameness) -> Self {
        let next = |&last: &f64| Some(last * THRESHOLD_FACTOR);
        let steps = std::iter::successors(Some(FIRST_THRESHOLD), next);
        let steps = steps.take(if is_measured { THRESHOLDS } else { 0 });
        let thresholds: Vec<f64> = steps.chain([f64::MAX]).collect();
        let mut needs = vec![Needs::default(); thresholds.len()];
        needs.iter_mut().for_each(|needs| needs.push(std::iter::empty()));
        Outlook { sameness, thresholds, needs, visits: 1, ways: Vec::new(), lost: BTreeMap::new() }
    }

    /// Takes notice of the visits that are new.
    pub(crate) fn observe(&mut self, experience: &Experience, measured: Option<&Measured>) {
        for visit in self.visits..=experience.observations.len() {
            let prices = self.prices_of_sameness(visit, experience, measured);
            for (&threshold, needs) in self.thresholds.iter().zip(&mut self.needs) {
                let near = prices.iter().filter(|&&(_, price)| price <= threshold);
                needs.push(near.map(|&(earlier, _)| earlier));
            }
            self.visits += 1;
        }
    }

    /// The earlier visits that may have been to the same place, in order, each with how much χ²/2 rises at least if it was.
    fn prices_of_sameness(
        &mut self,
        visit: usize,
        experience: &Experience,
        measured: Option<&Measured>,
    ) -> Vec<(usize, f64)> {
        let before = visit - 1;
        let Some(measured) = measured else {
            self.lost.entry(experience.star_of(before)).or_default().push(before);
            return self.lost_alike(experience.star_of(visit), experience);
        };
        let travel = &measured.travels[before];
        let step = UncertainPose { mean: travel.pose, covariance: travel.covariance };
        // Where double precision does not tell the two visits apart any more, nothing is claimed; nor where the heading is lost,
        // which no travel brings back.
        let tells = |way: &UncertainPose| trust(way.covariance.matrix()[(2, 2)]) > 0.0;
        let mut ways = Vec::with_capacity(self.ways.len() + 1);
        let longer = self.ways.iter().map(|(earlier, way)| (*earlier, way.compose(&step).ok()));
        for (earlier, way) in longer.chain([(before, Some(step))]) {
            match way.filter(tells) {
                Some(way) => ways.push((earlier, way)),
                None => self.lost.entry(experience.star_of(earlier)).or_default().push(earlier),
            }
        }
        self.ways = ways;
        let seen = experience.star_of(visit);
        let mut prices = self.lost_alike(seen, experience);
        if prices.first().is_some_and(|&(earlier, _)| earlier == 0) {
            return prices; // whatever is explained, the first visit may have been to the same place
        }
        for &(earlier, way) in &self.ways {
            let first = experience.star_of(earlier);
            let price = |rotation| {
                let turn = measured.frames.turn_between(visit, earlier, rotation);
                trust(way.covariance.matrix()[(2, 2)]) * half_chi2(&way, turn)
            };
            let price = match self.sameness {
                Sameness::Isomorphic => {
                    rotations(&experience.catalog, seen, first).map(price).fold(f64::INFINITY, f64::min)
                }
                Sameness::AnyReading => trust(way.covariance.matrix()[(2, 2)]) * half_chi2_of_position(&way),
            };
            if price < f64::INFINITY {
                prices.push((earlier, price));
            }
        }
        prices.sort_by_key(|&(earlier, _)| earlier);
        prices
    }

    /// The visits that odometry tells nothing about and at which the same was seen, at no price.
    fn lost_alike(&self, seen: StarId, experience: &Experience) -> Vec<(usize, f64)> {
        let is_alike = |star: StarId| {
            self.sameness == Sameness::AnyReading
                || rotations(&experience.catalog, seen, star).next().is_some()
        };
        let alike = self.lost.iter().filter(|&(&star, _)| is_alike(star));
        let mut visits: Vec<(usize, f64)> =
            alike.flat_map(|(_, visits)| visits.iter().map(|&visit| (visit, 0.0))).collect();
        visits.sort_by_key(|&(visit, _)| visit);
        visits
    }

    /// The least of χ²/2 plus what new places cost, over all maps that may come of one that explains that
    /// many travels and has bent so far by `bend`, its χ²/2. `cost` is that of so many places more.
    pub(crate) fn least(&self, explained: usize, bend: f64, cost: impl Fn(u32) -> f64) -> f64 {
        let mut least = f64::INFINITY;
        let mut from = 0.0_f64; // χ²/2 is between `from` and the next threshold
        for (&to, needs) in self.thresholds.iter().zip(&self.needs) {
            if to >= bend {
                least = least.min(from.max(bend) + cost(needs.counts[explained]));
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

/// The same, in whatever frame: the least over all turns.
fn half_chi2_of_position(way: &UncertainPose) -> f64 {
    let off = way.mean.translation();
    let covariance = way.covariance.matrix().fixed_view::<2, 2>(0, 0).into_owned();
    covariance.try_inverse().map_or(0.0, |information| 0.5 * off.dot(&(information * off)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same by the definition, number by number.
    #[test]
    fn intervals_are_taken_away() {
        let ranges = |bits: u32| -> Vec<Range<usize>> {
            let is_in = |at: usize| at < 12 && bits >> at & 1 == 1;
            let starts = (0..12).filter(|&at| is_in(at) && (at == 0 || !is_in(at - 1)));
            starts.map(|start| start..(start..13).find(|&at| !is_in(at)).unwrap_or(12)).collect()
        };
        for (a, b) in (0..4096).step_by(7).flat_map(|a| (0..4096).step_by(61).map(move |b| (a, b))) {
            let mut left = without(&ranges(a), &ranges(b));
            let mut joined: Vec<Range<usize>> = Vec::new();
            for part in left.drain(..) {
                match joined.last_mut() {
                    Some(last) if last.end == part.start => last.end = part.end,
                    _ => joined.push(part),
                }
            }
            assert_eq!(joined, ranges(a & !b), "{a:b} without {b:b}");
        }
    }
}
