//! What the travels that are left will cost at least, whatever the map: a bound that looks ahead.
//!
//! Two visits that odometry alone keeps apart can be the same place only at the price of a bent layout.
//! So, if χ²/2 of the whole map is to stay below some b, visits that are further apart than b from one
//! another and from all visits before must be at as many new places. Either the layout is bent by more than
//! b, or the new places are paid for.

use std::iter;
use std::ops::Range;

use hssh_topology::{Olp, StarCatalog, StarId};

use crate::experience::Experience;
use crate::limits::{StopReason, Watch};
use crate::measured::Measured;
use crate::posterior::way::Way;

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

/// Visits between two looks at the clock.
const LOOK: usize = 32;

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
    ways: Vec<(usize, Way)>,
    /// The visits by what was seen: stars of one kind can be one place.
    kinds: Vec<Kind>,
}

/// The visits at which one star was seen, up to isomorphism.
#[derive(Clone, Debug)]
struct Kind {
    star: StarId,
    first: usize,
    /// Those that odometry tells nothing about any more, in order.
    lost: Vec<usize>,
}

/// The earlier visits that may have been to the same place as one.
struct Candidates {
    /// Of which kind of star they are; those that are lost may be it at no price.
    kind: usize,
    /// Those of which odometry tells something, in order, with how much χ²/2 rises at least.
    near: Vec<(usize, f64)>,
    /// The first of all, at whatever price.
    first: Option<usize>,
}

/// Which visits need a new place if χ²/2 stays below a threshold, by the number of travels explained: greedily in order, each visit
/// that is near no explained one and near none that needs a place before it.
#[derive(Clone, Debug, Default)]
struct Needs {
    /// By visit: the numbers of travels explained with which it needs a place, in ascending intervals.
    with: Vec<Vec<Range<usize>>>,
    /// By number of travels explained: how many visits more need one than with one travel less.
    changes: Vec<i32>,
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
        self.changes.resize(visit + 2, 0);
        for interval in &with {
            self.changes[interval.start] += 1;
            self.changes[interval.end] -= 1;
        }
        self.with.push(with);
    }

    /// Counts the visits pushed.
    fn count(&mut self) {
        let sums = self.changes.iter().scan(0, |sum, change| {
            *sum += change;
            Some(*sum)
        });
        self.counts = sums.take(self.with.len()).map(|sum| sum as u32).collect();
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
        for needs in &mut needs {
            needs.push(iter::empty());
            needs.count();
        }
        Outlook { sameness, thresholds, needs, visits: 1, ways: Vec::new(), kinds: Vec::new() }
    }

    /// Takes notice of the visits that are new. A limit may stop it, and the next call goes on.
    pub(crate) fn observe(
        &mut self,
        experience: &Experience,
        measured: Option<&Measured>,
        watch: &Watch,
    ) -> Option<StopReason> {
        if self.kinds.is_empty() {
            self.kind_of(0, experience);
        }
        let mut stop = None;
        for visit in self.visits..=experience.observations.len() {
            stop = if visit.is_multiple_of(LOOK) { watch.interruption() } else { None };
            if stop.is_some() {
                break;
            }
            let Candidates { kind, near, first } = self.candidates(visit, experience, measured);
            let lost = &self.kinds[kind].lost;
            for (&threshold, needs) in self.thresholds.iter().zip(&mut self.needs) {
                if threshold == f64::MAX {
                    needs.push(first.into_iter());
                } else {
                    let near = near.iter().filter(|&&(_, price)| price <= threshold);
                    needs.push(merged(lost.iter().copied(), near.map(|&(earlier, _)| earlier)));
                }
            }
            self.visits += 1;
        }
        self.needs.iter_mut().for_each(Needs::count);
        stop
    }

    /// Which kind of star was seen on a visit; whether it is the first of it.
    fn kind_of(&mut self, visit: usize, experience: &Experience) -> (usize, bool) {
        let star = experience.star_of(visit);
        let is_alike = |kind: &Kind| {
            self.sameness == Sameness::AnyReading
                || kind.star == star
                || rotations(&experience.catalog, star, kind.star).next().is_some()
        };
        if let Some(known) = self.kinds.iter().position(is_alike) {
            return (known, false);
        }
        self.kinds.push(Kind { star, first: visit, lost: Vec::new() });
        (self.kinds.len() - 1, true)
    }

    /// Odometry tells nothing any more about where that visit was.
    fn lose(&mut self, visit: usize, experience: &Experience) {
        let (kind, _) = self.kind_of(visit, experience);
        let lost = &mut self.kinds[kind].lost;
        let place = lost.partition_point(|&other| other < visit);
        lost.insert(place, visit);
    }

    /// The earlier visits that may have been to the same place as one.
    fn candidates(
        &mut self,
        visit: usize,
        experience: &Experience,
        measured: Option<&Measured>,
    ) -> Candidates {
        let before = visit - 1;
        match measured {
            Some(measured) => self.lengthen(&Way::of(&measured.travels[before]), before, experience),
            None => self.lose(before, experience),
        }
        let (kind, is_first) = self.kind_of(visit, experience);
        let Kind { first, ref lost, .. } = self.kinds[kind];
        let mut found = Candidates { kind, near: Vec::new(), first: (!is_first).then_some(first) };
        // Where the first visit is lost, nothing more is asked: whatever is explained, it may have been to the same place.
        let Some(measured) = measured.filter(|_| lost.first() != Some(&0)) else { return found };
        let seen = experience.star_of(visit);
        let most = self.thresholds[self.thresholds.len() - 2];
        for (earlier, way) in &self.ways {
            let trusted = trust(way.turn_variance);
            if way.certainly_exceeds(most / trusted) {
                continue;
            }
            let half_chi2 = match self.sameness {
                Sameness::Isomorphic => {
                    let rotations = rotations(&experience.catalog, seen, experience.star_of(*earlier));
                    let turn = |rotation| measured.frames.turn_between(visit, *earlier, rotation);
                    way.least_half_chi2(rotations.map(turn))
                }
                Sameness::AnyReading => way.half_chi2_of_position(),
            };
            let price = trusted * half_chi2;
            if price <= most {
                found.near.push((*earlier, price));
            }
        }
        found
    }

    /// One travel more, from the visit `before` on.
    fn lengthen(&mut self, step: &Way, before: usize, experience: &Experience) {
        // Where double precision does not tell the two visits apart any more, nothing is claimed; nor where the heading is lost,
        // which no travel brings back.
        let tells = |way: &Way| trust(way.turn_variance) > 0.0;
        let mut lost = Vec::new();
        self.ways.retain_mut(|(earlier, way)| match way.then(step).filter(tells) {
            Some(longer) => {
                *way = longer;
                true
            }
            None => {
                lost.push(*earlier);
                false
            }
        });
        if tells(step) {
            self.ways.push((before, *step));
        } else {
            lost.push(before);
        }
        for visit in lost {
            self.lose(visit, experience);
        }
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

/// Two ascending sequences as one.
fn merged(
    one: impl Iterator<Item = usize>,
    other: impl Iterator<Item = usize>,
) -> impl Iterator<Item = usize> {
    let (mut one, mut other) = (one.peekable(), other.peekable());
    iter::from_fn(move || match (one.peek(), other.peek()) {
        (Some(first), Some(second)) if second < first => other.next(),
        (Some(_), _) => one.next(),
        (None, _) => other.next(),
    })
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
