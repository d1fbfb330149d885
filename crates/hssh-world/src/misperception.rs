//! Explorations in which perception erred: ends misread, places passed unreported, places seen that are none, and travels on which
//! the robot turned back.

use std::f64::consts::{PI, TAU};

use hssh_causal::{Exploration, NamedStar, Odometry, StarType, Travel};
use hssh_topology::{Olp, OlpName, Passability, Sign, Star, StarEnd};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::geometry::{Point, length, wrap};
use crate::noise::OdometryNoise;
use crate::route::{Route, RouteError};
use crate::world::{PlaceId, World, WorldOlp};

/// How often perception errs: probabilities.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ErrorRates {
    /// By gateway of a visit that the robot neither came in nor left by: it is not seen.
    pub missed: f64,
    /// By visit: a gateway is seen that is not there.
    pub ghost: f64,
    /// By place on the way, but the first: the visit is not reported.
    pub unreported: f64,
    /// By travel: somewhere on the way a place is reported that is none.
    pub false_visit: f64,
    /// By travel: before it the robot sets out, turns, and comes back.
    pub turned_back: f64,
}

impl ErrorRates {
    /// All errors at one rate; a ghost a visit at a third of it, since a place has about three gateways to miss.
    #[must_use]
    pub fn all(rate: f64) -> Self {
        ErrorRates { missed: rate, ghost: rate / 3.0, unreported: rate, false_visit: rate, turned_back: rate }
    }
}

/// An exploration with errors, and what it is an exploration of.
#[derive(Clone, PartialEq, Debug)]
pub struct Misperceived {
    /// What the robot told.
    pub exploration: Exploration,
    /// By visit, the start first: the place of the world; `None` if it is none.
    pub visits: Vec<Option<PlaceId>>,
    /// How many errors there are: ends missed, ghosts, places passed, false visits, turns.
    pub errors: [usize; 5],
}

impl Misperceived {
    /// Pairs of visits that say which are to one place, and pairs that say which are not: of all visits but false ones.
    #[must_use]
    pub fn pairs(&self) -> [Vec<[usize; 2]>; 2] {
        let first = |place: &PlaceId| self.visits.iter().position(|other| other.as_ref() == Some(place));
        let (mut same, mut leaders) = (Vec::new(), Vec::new());
        for (visit, place) in self.visits.iter().enumerate() {
            match place.as_ref().and_then(first) {
                Some(first) if first < visit => same.push([first, visit]),
                _ => leaders.push(visit),
            }
        }
        let pairs = |(number, &one): (usize, &usize)| -> Vec<[usize; 2]> {
            leaders[..number].iter().map(|&other| [other, one]).collect()
        };
        [same, leaders.iter().enumerate().flat_map(pairs).collect()]
    }

    /// Whether places are those of the world: two visits are to one place exactly if they were, and a report of no place is taken for none, or for a
    /// place where the robot was on no other visit.
    #[must_use]
    pub fn is_told_apart_by<T: Copy + PartialEq>(&self, places: &[Option<T>]) -> bool {
        let visits: Vec<_> = places.iter().zip(&self.visits).collect();
        let is_same = |place: &Option<T>, other: &Option<T>| place.is_some() && place == other;
        places.len() == self.visits.len()
            && visits.iter().all(|(place, truth)| truth.is_none() || place.is_some())
            && visits.iter().enumerate().all(|(later, (place, truth))| {
                let earlier = &visits[..later];
                earlier.iter().all(|(other, other_truth)| {
                    is_same(place, other) == (truth.is_some() && truth == other_truth)
                })
            })
    }
}

/// A visit that is reported.
struct Report {
    place: Option<PlaceId>,
    /// By which end the robot came in; the first visit has none.
    entry: Option<Olp>,
    exit: Option<Olp>,
    /// The way from the report before.
    way: Vec<Point>,
    /// Of a false visit: where the way came from and where it goes on.
    along: [f64; 2],
}

/// A star as seen, with where the ends of the true star are in it.
struct Seen {
    star: Star,
    bearings: Vec<f64>,
    positions: Vec<Option<Olp>>,
}

impl World {
    /// What a robot on this route tells whose perception errs at those rates; every travel is measured, with the noise given. The robot
    /// is never taken to be at another place, and the ends by which it comes and goes are always seen. The same arguments give the same exploration.
    ///
    /// # Errors
    /// As [`World::explore_with_odometry`].
    pub fn misperceive(
        &self,
        route: &Route,
        noise: &impl OdometryNoise,
        rates: ErrorRates,
        seed: u64,
    ) -> Result<Misperceived, RouteError> {
        noise.check()?;
        let crossings = self.follow_route(route)?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut errors = [0; 5];
        let reports = self.reports(route.start, &crossings, rates, &mut random, &mut errors);

        let mut stars: Vec<NamedStar> = Vec::new();
        let mut travels = Vec::new();
        let mut start = StarType(0);
        let mut before: Option<(Seen, Option<Olp>)> = None;
        let mut heading = None;
        for report in &reports {
            let seen = self.look(report, rates, &mut random, &mut errors);
            let number = star_type(&mut stars, &seen);
            let position = |end: Option<Olp>| end.and_then(|end| seen.positions[end.index()]);
            match (&before, position(report.entry)) {
                (Some((last, Some(exit))), Some(entry)) => {
                    let exit = last.positions[exit.index()].expect("the exit is seen");
                    let odometry = measure(noise, &report.way, &mut heading, &mut random);
                    travels.push(Travel { exit, entry, star: number, odometry: Some(odometry) });
                }
                _ => start = number,
            }
            before = Some((seen, report.exit));
        }
        let exploration =
            Exploration::new(stars, start, travels).expect("what is seen has the ends that are used");
        Ok(Misperceived { exploration, visits: reports.iter().map(|report| report.place).collect(), errors })
    }

    /// What is reported, in order.
    fn reports(
        &self,
        start: PlaceId,
        crossings: &[(WorldOlp, WorldOlp)],
        rates: ErrorRates,
        random: &mut ChaCha8Rng,
        errors: &mut [usize; 5],
    ) -> Vec<Report> {
        let first = crossings.first().map(|(exit, _)| exit.olp);
        let at =
            |place| Report { place: Some(place), entry: None, exit: first, way: Vec::new(), along: [0.0; 2] };
        let mut reports = vec![at(start)];
        // Since the last report.
        let mut way: Vec<Point> = Vec::new();
        for (index, &(exit, entry)) in crossings.iter().enumerate() {
            let link = self.way(exit).unwrap_or_default();
            if way.is_empty() && random.random_bool(rates.turned_back) {
                errors[4] += 1;
                let mut there_and_back = cut(&link, random.random_range(0.3..0.6)).0;
                there_and_back.extend(there_and_back.clone().into_iter().rev().skip(1));
                let place = Some(exit.place);
                let (entry, exit) = (Some(exit.olp), Some(exit.olp));
                reports.push(Report { place, entry, exit, way: there_and_back, along: [0.0; 2] });
            }
            way.extend(link.iter().skip(usize::from(!way.is_empty())));
            if random.random_bool(rates.false_visit) {
                errors[3] += 1;
                let (to, from) = cut(&way, random.random_range(0.3..0.7));
                let along = [to[to.len() - 1].bearing_to(to[to.len() - 2]), from[0].bearing_to(from[1])];
                let (entry, exit) = (Some(Olp::new(0)), Some(Olp::new(1)));
                reports.push(Report { place: None, entry, exit, way: to, along });
                way = from;
            }
            let is_last = index + 1 == crossings.len();
            let next = crossings.get(index + 1).map(|(exit, _)| exit.olp);
            let turns = next == Some(entry.olp);
            if !is_last && !turns && random.random_bool(rates.unreported) {
                errors[2] += 1;
                continue;
            }
            let way = std::mem::take(&mut way);
            reports.push(Report {
                place: Some(entry.place),
                entry: Some(entry.olp),
                exit: next,
                way,
                along: [0.0; 2],
            });
        }
        reports
    }

    /// What the robot sees on a visit.
    fn look(
        &self,
        report: &Report,
        rates: ErrorRates,
        random: &mut ChaCha8Rng,
        errors: &mut [usize; 5],
    ) -> Seen {
        let Some(place) = report.place else {
            let [back, ahead] = report.along;
            let star: Star = "0+ 0-".parse().expect("the star of a way");
            let positions = star.olps().map(Some).collect();
            return Seen { star, bearings: vec![back, ahead], positions };
        };
        let place = self.place(place);
        let used = |olp: Olp| Some(olp) == report.entry || Some(olp) == report.exit;
        let mut open: Vec<bool> = place.star.olps().map(|olp| place.star.is_travelable(olp)).collect();
        for olp in place.star.gateways().filter(|&olp| !used(olp)) {
            if random.random_bool(rates.missed) {
                errors[0] += 1;
                open[olp.index()] = false;
            }
        }
        // A local path of which nothing is open is not seen.
        let mut ends: Vec<(Option<Olp>, StarEnd, f64)> = Vec::new();
        for olp in place.star.olps() {
            if open[olp.index()] || open[place.star.opposite(olp).index()] {
                let passability =
                    if open[olp.index()] { Passability::Travelable } else { Passability::Closed };
                let end = StarEnd { passability, ..place.star.ends()[olp.index()].clone() };
                ends.push((Some(olp), end, place.bearings[olp.index()]));
            }
        }
        if random.random_bool(rates.ghost) {
            errors[1] += 1;
            add_ghost(&mut ends, random.random_range(-PI..PI));
        }
        let mut positions = vec![None; open.len()];
        for (position, (olp, ..)) in ends.iter().enumerate() {
            if let Some(olp) = olp {
                positions[olp.index()] = Some(Olp::new(position as u32));
            }
        }
        let bearings = ends.iter().map(|(.., bearing)| *bearing).collect();
        let star = Star::new(ends.into_iter().map(|(_, end, _)| end)).expect("ends stay in pairs");
        Seen { star, bearings, positions }
    }
}

/// A local path whose one direction is an open end that is not there.
fn add_ghost(ends: &mut Vec<(Option<Olp>, StarEnd, f64)>, bearing: f64) {
    let path = ends.iter().map(|(_, end, _)| end.name.local_path).max().map_or(0, |most| most + 1);
    for (sign, passability, bearing) in [
        (Sign::Plus, Passability::Travelable, bearing),
        (Sign::Minus, Passability::Closed, wrap(bearing + PI)),
    ] {
        // Clockwise from the first end: how far it is to each.
        let first = ends[0].2;
        let clockwise = |to: f64| (first - to).rem_euclid(TAU);
        let position = ends
            .iter()
            .skip(1)
            .position(|(.., other)| clockwise(*other) > clockwise(bearing))
            .map_or(ends.len(), |p| p + 1);
        let end = StarEnd { name: OlpName { local_path: path, sign }, passability, label: None };
        ends.insert(position, (None, end, bearing));
    }
}

/// A way in two, after that share of its length.
fn cut(way: &[Point], share: f64) -> (Vec<Point>, Vec<Point>) {
    let mut left = share * length(way);
    let mut to = vec![way[0]];
    for (index, piece) in way.windows(2).enumerate() {
        let step = piece[0].distance_to(piece[1]);
        if step >= left && step > 0.0 {
            let t = left / step;
            let at = Point::new(
                piece[0].x + t * (piece[1].x - piece[0].x),
                piece[0].y + t * (piece[1].y - piece[0].y),
            );
            to.push(at);
            let from = std::iter::once(at).chain(way[index + 1..].iter().copied()).collect();
            return (to, from);
        }
        left -= step;
        to.push(piece[1]);
    }
    (to.clone(), vec![to[to.len() - 1]; 2])
}

fn measure(
    noise: &impl OdometryNoise,
    way: &[Point],
    heading: &mut Option<f64>,
    random: &mut ChaCha8Rng,
) -> Odometry {
    let leaving = way[0].bearing_to(way[1]);
    let turn = heading.map_or(0.0, |heading: f64| wrap(leaving - heading).abs());
    *heading = Some(way[way.len() - 2].bearing_to(way[way.len() - 1]));
    noise.measure(turn, way, random)
}

fn star_type(stars: &mut Vec<NamedStar>, seen: &Seen) -> StarType {
    let bearings: Vec<Option<f64>> = seen.bearings.iter().copied().map(Some).collect();
    let known = stars.iter().position(|known| known.star == seen.star && known.bearings == bearings);
    let number = known.unwrap_or_else(|| {
        let name = format!("S{}", stars.len());
        stars.push(NamedStar { name, star: seen.star.clone(), bearings });
        stars.len() - 1
    });
    StarType(number as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DriftModel, grid, random_planar, random_walk, snake};

    #[test]
    fn without_errors_it_is_the_exploration() {
        let world = grid(3, 3, 8.0).unwrap();
        let route = world.route_through(&snake(3, 3)).unwrap();
        let told = world.misperceive(&route, &DriftModel::default(), ErrorRates::default(), 1).unwrap();
        let exact = world.explore(&route).unwrap();
        assert_eq!(told.errors, [0; 5]);
        assert_eq!(told.visits.len(), exact.travels().len() + 1);
        for (told, exact) in told.exploration.travels().iter().zip(exact.travels()) {
            assert_eq!((told.exit, told.entry), (exact.exit, exact.entry));
        }
        let stars = told.exploration.visits().zip(exact.visits());
        assert!(
            stars.into_iter().all(|(told_star, star)| told.exploration.star(told_star) == exact.star(star))
        );
    }

    #[test]
    fn errors_are_those_that_were_asked_for() {
        for seed in 0..40 {
            let world = random_planar(12, 0.4, 10.0, seed).unwrap();
            let route = random_walk(&world, 40, seed);
            let told = world.misperceive(&route, &DriftModel::default(), ErrorRates::all(0.3), seed).unwrap();
            let [_, _, passed, none, turned] = told.errors;
            assert_eq!(told.visits.len(), route.exits.len() + 1 + none + turned - passed);
            assert_eq!(told.visits.iter().filter(|visit| visit.is_none()).count(), none);
            assert_eq!(told.visits.len(), told.exploration.travels().len() + 1);
        }
    }
}
