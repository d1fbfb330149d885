//! What the travels that are left will cost at least, whatever the map: a bound that looks ahead.
//!
//! Two visits that odometry alone keeps apart can be the same place only at the price of a bent layout.
//! So, if χ²/2 of the whole map is to stay below some b, visits that are further apart than b from one
//! another and from all visits before must be at as many new places. Either the layout is bent by more than
//! b, or the new places are paid for.

use hssh_metrics::wrap_angle;
use hssh_topology::{Olp, StarCatalog, StarId};

use crate::experience::Experience;
use crate::limits::{StopReason, Watch};
use crate::measured::{Measured, MeasuredTravel};
use crate::posterior::course::Course;
use crate::posterior::needs::{Need, Needs};
use crate::posterior::noose::{RELIED_ON, least_bend};
use crate::posterior::vicinity::Vicinity;
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

/// Loops of up to so many travels are laid out by themselves. Of longer ones the linear estimate has to do: they are many, and odometry tells
/// little of them.
const LONGEST_LOOP: usize = 100;

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
    /// Where odometry alone says that they are.
    course: Course,
    /// The first visit of which odometry still tells something when the last one is looked at: the heading is lost with time, and no
    /// travel brings it back.
    told_from: usize,
    /// The visits by what was seen: stars of one kind can be one place.
    kinds: Vec<Kind>,
}

/// The visits at which one star was seen, up to isomorphism.
#[derive(Clone, Debug)]
struct Kind {
    star: StarId,
    first: usize,
    /// All of them, where they are measured.
    visits: Vicinity,
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
            needs.push(Need::Always);
            needs.count();
        }
        let (course, kinds) = (Course::new(), Vec::new());
        Outlook { sameness, thresholds, needs, visits: 1, course, told_from: 0, kinds }
    }

    /// Takes notice of the visits that are new. A limit may stop it, and the next call goes on.
    pub(crate) fn observe(
        &mut self,
        experience: &Experience,
        measured: Option<&Measured>,
        watch: &Watch,
    ) -> Option<StopReason> {
        if self.kinds.is_empty() {
            self.join_kind(0, experience);
        }
        let mut stop = None;
        for visit in self.visits..=experience.observations.len() {
            stop = watch.interruption();
            if stop.is_some() {
                break;
            }
            if let Some(measured) = measured {
                self.course.push(&measured.travels[visit - 1]);
                self.forget(visit);
            }
            let needed = self.needed(visit, experience, measured);
            for (needs, need) in self.needs.iter_mut().zip(needed) {
                needs.push(need);
            }
            self.join_kind(visit, experience);
            self.visits += 1;
        }
        self.needs.iter_mut().for_each(Needs::count);
        stop
    }

    /// Where the heading is lost until a visit, nothing is claimed any more.
    fn forget(&mut self, visit: usize) {
        let tells = |earlier: usize| trust(self.course.way(earlier, visit).turn_variance) > 0.0;
        while self.told_from < visit && !tells(self.told_from) {
            self.told_from += 1;
        }
    }

    /// Which kind of star was seen on a visit, if one of it was seen before.
    fn kind_of(&self, visit: usize, experience: &Experience) -> Option<usize> {
        let star = experience.star_of(visit);
        let is_alike = |kind: &Kind| {
            self.sameness == Sameness::AnyReading
                || kind.star == star
                || rotations(&experience.catalog, star, kind.star).next().is_some()
        };
        self.kinds.iter().position(is_alike)
    }

    /// A visit is one of its kind from now on.
    fn join_kind(&mut self, visit: usize, experience: &Experience) {
        let known = self.kind_of(visit, experience);
        let kind = known.unwrap_or(self.kinds.len());
        if known.is_none() {
            let star = experience.star_of(visit);
            self.kinds.push(Kind { star, first: visit, visits: Vicinity::new() });
        }
        if self.thresholds.len() > 1 {
            self.kinds[kind].visits.push(visit, &self.course);
        }
    }

    /// By threshold: with which numbers of travels explained a visit needs a new place.
    fn needed(&self, visit: usize, experience: &Experience, measured: Option<&Measured>) -> Vec<Need> {
        let Some(kind) = self.kind_of(visit, experience) else {
            return vec![Need::Always; self.thresholds.len()];
        };
        let mut needed = vec![Need::never(); self.thresholds.len()];
        let Kind { first, ref visits, .. } = self.kinds[kind];
        // The first of a kind is at a place that is known or new; whoever may be there at no price needs none.
        let Some(measured) = measured.filter(|_| first >= self.told_from) else { return needed };
        let mut open = self.thresholds.len() - 1;
        needed[..open].fill(Need::Always);
        let mut number = 0;
        // Thresholds with which nothing is needed any more ask no more; those above ask for more visits and mostly end sooner.
        while open > 0 {
            let limit = self.thresholds[open - 1] / LINEAR_TRUST;
            let Some((near, earlier)) = visits.next(number, visit, limit, &self.course) else { break };
            number = near + 1;
            if self.is_out(visit, earlier, limit, experience, measured) {
                continue;
            }
            let price = self.price(visit, earlier, experience, measured);
            for (index, needs) in self.needs[..open].iter().enumerate() {
                if price <= self.thresholds[index] && !needed[index].is_never() {
                    needed[index] = needs.without(&needed[index], visit, earlier);
                }
            }
            while open > 0 && needed[open - 1].is_never() {
                open -= 1;
            }
        }
        needed
    }

    /// Whether it is plain that χ²/2 rises by more than that if a visit is to the place of an earlier one.
    fn is_out(
        &self,
        visit: usize,
        earlier: usize,
        half_chi2: f64,
        experience: &Experience,
        measured: &Measured,
    ) -> bool {
        let turns = turns(visit, earlier, experience, measured);
        self.sameness == Sameness::Isomorphic
            && self.course.about(earlier, visit).certainly_exceeds(turns, half_chi2)
    }

    /// How much χ²/2 rises at least if a visit is to the place of an earlier one.
    fn price(&self, visit: usize, earlier: usize, experience: &Experience, measured: &Measured) -> f64 {
        let (way, travels) = (self.course.way(earlier, visit), &measured.travels[earlier..visit]);
        match self.sameness {
            Sameness::Isomorphic => {
                price_of_loop(&way, travels, || turns(visit, earlier, experience, measured))
            }
            Sameness::AnyReading => told(&way, way.half_chi2_of_position()),
        }
    }

    /// The least of χ²/2 plus what new places cost, over all maps that may come of one that explains that
    /// many travels and has bent so far by `bend`, its χ²/2. `cost` is that of so many places more.
    pub(crate) fn least(&self, explained: usize, bend: f64, cost: impl Fn(u32) -> f64) -> f64 {
        let mut least = f64::INFINITY;
        let mut from = 0.0_f64; // χ²/2 is between `from` and the next threshold
        for (&to, needs) in self.thresholds.iter().zip(&self.needs) {
            if to >= bend {
                least = least.min(from.max(bend) + cost(needs.counted(explained)));
                if from.max(bend) + cost(0) >= least {
                    break;
                }
            }
            from = to;
        }
        least
    }
}

/// How much χ²/2 rises at least if a way leads back to where it began, into a frame turned by any of these angles: the single loop is part of every
/// map in which both visits are to one place, so that no map bends by less than the loop alone. What the linear estimate promises is
/// relied on where that is more, or the loop is a long one.
fn price_of_loop<I: Iterator<Item = f64>>(
    way: &Way,
    travels: &[MeasuredTravel],
    turns: impl Fn() -> I,
) -> f64 {
    let half_chi2 = way.least_half_chi2(turns());
    let promised = told(way, half_chi2);
    if promised == 0.0 || half_chi2 <= FIRST_THRESHOLD || travels.len() > LONGEST_LOOP {
        return promised;
    }
    let bend = |least: f64, turn: f64| {
        // Headings add up, so that a loop bends at least by what turns it.
        let off = wrap_angle(way.mean.theta - turn);
        if 0.5 * off * off / way.turn_variance >= least {
            return least;
        }
        least_bend(travels, turn).map_or(0.0, |bend| RELIED_ON * bend).min(least)
    };
    turns().fold(f64::INFINITY, bend).max(promised)
}

/// What can be relied on of a linear estimate of χ²/2 for a way.
fn told(way: &Way, half_chi2: f64) -> f64 {
    if way.is_sound() { trust(way.turn_variance) * half_chi2 } else { 0.0 }
}

/// By what angles the frame of a visit may be turned against that of an earlier one at the same place.
fn turns<'a>(
    visit: usize,
    earlier: usize,
    experience: &'a Experience,
    measured: &'a Measured,
) -> impl Iterator<Item = f64> + 'a {
    let (seen, known) = (experience.star_of(visit), experience.star_of(earlier));
    let rotations = rotations(&experience.catalog, seen, known);
    rotations.map(move |rotation| measured.frames.turn_between(visit, earlier, rotation))
}

/// The rotations of all isomorphisms between two stars.
fn rotations(catalog: &StarCatalog, seen: StarId, first: StarId) -> impl Iterator<Item = u32> + '_ {
    let degree = catalog.star(first).degree();
    (0..degree).filter(move |&rotation| catalog.matches(seen, Olp::new(0), first, Olp::new(rotation)))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use hssh_causal::Exploration;
    use hssh_world::{PlaceId, PolarNoise, grid};

    use super::*;
    use crate::limits::Limits;

    /// Round and round the two rows of a grid, with so many standard deviations of what a good robot errs by.
    fn laps(columns: u32, travels: usize, errors: f64) -> Exploration {
        let world = grid(2, columns, 8.0).unwrap();
        let around: Vec<u32> = (0..columns).chain((columns..2 * columns).rev()).collect();
        let places: Vec<PlaceId> =
            around.iter().cycle().take(travels + 1).map(|&place| PlaceId(place)).collect();
        let (distance, bearing, rotation) = (0.05 * errors, 0.005 * errors, 0.005 * errors);
        let noise = PolarNoise { distance, distance_share: 0.0, bearing, rotation };
        world.explore_with_odometry(&world.route_through(&places).unwrap(), &noise, 1).unwrap()
    }

    /// By later and earlier visit: what it costs at least if both are to one place, the way lengthened travel by travel; nothing if they
    /// cannot be.
    fn prices(experience: &Experience, measured: &Measured, sameness: Sameness) -> Vec<Vec<Option<f64>>> {
        let visits = experience.observations.len() + 1;
        let mut prices = vec![Vec::new(); visits];
        for earlier in 0..visits {
            let mut way: Option<Way> = None;
            for (later, prices) in prices.iter_mut().enumerate().skip(earlier + 1) {
                let step = Way::of(&measured.travels[later - 1]);
                let longer = way.map_or(step, |way| way.then(&step));
                way = Some(longer);
                let turns: Vec<f64> = turns(later, earlier, experience, measured).collect();
                let travels = &measured.travels[earlier..later];
                prices.push(match sameness {
                    Sameness::Isomorphic if turns.is_empty() => None,
                    Sameness::Isomorphic => Some(price_of_loop(&longer, travels, || turns.iter().copied())),
                    Sameness::AnyReading => Some(told(&longer, longer.half_chi2_of_position())),
                });
            }
        }
        prices
    }

    /// Whatever is passed over, the counts are those of the definition with all pairs of visits.
    #[test]
    fn counts_are_those_of_all_pairs() {
        for (columns, travels, errors) in [(4, 60, 1.0), (4, 60, 6.0), (30, 75, 1.0), (60, 90, 8.0)] {
            let experience = Experience::from(&laps(columns, travels, errors));
            let mut measured = Measured::default();
            measured.observe(&experience).unwrap();
            for sameness in [Sameness::Isomorphic, Sameness::AnyReading] {
                let mut outlook = Outlook::new(true, sameness);
                let watch = Watch::start(Limits::default(), &Arc::default());
                assert_eq!(outlook.observe(&experience, Some(&measured), &watch), None);
                let prices = prices(&experience, &measured, sameness);
                for (&threshold, needs) in outlook.thresholds.iter().zip(&outlook.needs) {
                    for explained in (0..=travels).step_by(9) {
                        let mut known: Vec<usize> = (0..=explained).collect();
                        for (visit, prices) in prices.iter().enumerate().take(travels + 1).skip(explained + 1)
                        {
                            let is_near = |&earlier: &usize| prices[earlier].is_some_and(|p| p <= threshold);
                            if !known.iter().any(is_near) {
                                known.push(visit);
                            }
                        }
                        let (count, expected) = (needs.counted(explained), known.len() - explained - 1);
                        assert_eq!(count as usize, expected, "{columns}, {threshold}, {explained}");
                    }
                }
            }
        }
    }
}
