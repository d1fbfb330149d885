//! Stars from geometry: which streets continue one another across a crossing.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use hssh_topology::{Olp, OlpName, Passability, Sign, Star, StarEnd};

use crate::geometry::wrap;

/// Two streets continue one another only if they deviate from a straight line by no more than
/// this, in radians: half way between going straight on and turning at a right angle.
pub(crate) const STRAIGHT: f64 = FRAC_PI_4;

/// The star of a crossing, read clockwise from north.
pub(crate) struct CrossingStar {
    pub(crate) star: Star,
    /// One bearing per end; a closed end has its street's bearing turned by π.
    pub(crate) bearings: Vec<f64>,
    /// For each street, in the order given: its end of the star.
    pub(crate) olps: Vec<Olp>,
}

/// An end before it has a position in the circular order.
struct End {
    bearing: f64,
    /// The first of the streets on its local path, which tells local paths apart.
    path: usize,
    /// The street itself, `None` at a closed end.
    street: Option<usize>,
}

/// The star of streets that leave a crossing by the given bearings; `None` if there are none.
///
/// Two streets are one local path if each is the other's straightest continuation and they
/// deviate by at most [`STRAIGHT`]. A street without continuation ends here: its opposite is
/// closed. Equal bearings keep the order given, open ends first; a world does not accept them.
pub(crate) fn star_of_crossing(streets: &[f64]) -> Option<CrossingStar> {
    let continuation: Vec<Option<usize>> = (0..streets.len())
        .map(|street| {
            straightest(streets, street).filter(|&other| straightest(streets, other) == Some(street))
        })
        .collect();
    let open = continuation.iter().enumerate().map(|(street, other)| End {
        bearing: wrap(streets[street]),
        path: other.map_or(street, |other| other.min(street)),
        street: Some(street),
    });
    let closed = continuation
        .iter()
        .enumerate()
        .filter(|(_, other)| other.is_none())
        .map(|(street, _)| End { bearing: wrap(streets[street] + PI), path: street, street: None });
    let mut ends: Vec<End> = open.chain(closed).collect();
    ends.sort_by(|a, b| clockwise_from_north(a.bearing).total_cmp(&clockwise_from_north(b.bearing)));

    let mut numbers: Vec<usize> = Vec::new(); // local paths in the order of their first ends
    let mut olps = vec![Olp::new(0); streets.len()];
    let mut star_ends = Vec::new();
    for (position, end) in ends.iter().enumerate() {
        let met = numbers.iter().position(|&path| path == end.path);
        let local_path = met.unwrap_or(numbers.len()) as u32;
        if met.is_none() {
            numbers.push(end.path);
        }
        let sign = if met.is_none() { Sign::Plus } else { Sign::Minus };
        let passability = if end.street.is_some() { Passability::Travelable } else { Passability::Closed };
        star_ends.push(StarEnd { name: OlpName { local_path, sign }, passability, label: None });
        if let Some(street) = end.street {
            olps[street] = Olp::new(position as u32);
        }
    }
    let star = Star::new(star_ends).ok()?; // fails only if there are no streets
    Some(CrossingStar { star, bearings: ends.iter().map(|end| end.bearing).collect(), olps })
}

/// The street that continues `street` most nearly straight, if any does within [`STRAIGHT`].
fn straightest(streets: &[f64], street: usize) -> Option<usize> {
    let deviation = |other: usize| wrap(streets[other] - streets[street] - PI).abs();
    // One order for all pairs, so that a tie cannot leave a ring of streets without a mutual pair.
    let rank = |other: usize| (deviation(other), street.min(other), street.max(other));
    (0..streets.len())
        .filter(|&other| other != street && deviation(other) <= STRAIGHT)
        .min_by(|&a, &b| rank(a).partial_cmp(&rank(b)).expect("deviations of finite bearings are finite"))
}

fn clockwise_from_north(bearing: f64) -> f64 {
    (FRAC_PI_2 - bearing).rem_euclid(TAU)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(degrees: &[f64]) -> String {
        let bearings: Vec<f64> = degrees.iter().map(|degrees: &f64| degrees.to_radians()).collect();
        star_of_crossing(&bearings).unwrap().star.to_string()
    }

    #[test]
    fn right_angles_give_the_stars_of_grids() {
        let (north, east, south, west) = (90.0, 0.0, -90.0, 180.0);
        assert_eq!(read(&[south, east, west, north]), "[<0+,T>, <1+,T>, <0-,T>, <1-,T>]");
        assert_eq!(read(&[west, south, north]), "[<0+,T>, <1+,C>, <0-,T>, <1-,T>]");
        assert_eq!(read(&[east, north]), "[<0+,T>, <1+,T>, <0-,C>, <1-,C>]");
        assert_eq!(read(&[south]), "[<0+,C>, <0-,T>]");
    }

    #[test]
    fn streets_that_bend_too_much_both_end() {
        // Three streets 120° apart: none is straight, each has a closed opposite between the others.
        assert_eq!(read(&[90.0, -30.0, 210.0]), "[<0+,T>, <1+,C>, <2+,T>, <0-,C>, <1-,T>, <2-,C>]");
        // A bend of 40° goes on, one of 50° is a corner.
        assert_eq!(read(&[90.0, -50.0]), "[<0+,T>, <0-,T>]");
        assert_eq!(read(&[90.0, -40.0]), "[<0+,T>, <1+,T>, <0-,C>, <1-,C>]");
    }

    #[test]
    fn a_fork_continues_only_by_its_straighter_branch() {
        // North, and two branches 10° and 20° off the south.
        assert_eq!(read(&[90.0, -100.0, -70.0]), "[<0+,T>, <1+,T>, <0-,T>, <1-,C>]");
        // Equally straight: the street given first goes on.
        assert_eq!(read(&[90.0, -100.0, -80.0]), "[<0+,T>, <1+,T>, <0-,T>, <1-,C>]");
        assert_eq!(read(&[90.0, -80.0, -100.0]), "[<0+,T>, <1+,C>, <0-,T>, <1-,T>]");
    }

    #[test]
    fn streets_point_at_their_own_ends() {
        let bearings = [0.1, 2.0, -2.5, -1.0, 3.0];
        let crossing = star_of_crossing(&bearings).unwrap();
        for (bearing, olp) in bearings.iter().zip(&crossing.olps) {
            assert_eq!(crossing.bearings[olp.index()], *bearing);
            assert!(crossing.star.is_travelable(*olp));
        }
        assert!(star_of_crossing(&[]).is_none());
    }
}
