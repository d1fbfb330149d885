//! The directions of a star's ends: measured bearings where there are any, and a plain drawing of the star
//! where there are none.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use hssh_topology::{PlaceId, StarId, TopologicalMap};
use nalgebra::{DMatrix, DVector};

use super::DrawingError;

/// Bearings of the ends of stars, as far as they were measured.
///
/// For each star, by its number, one bearing per end, clockwise as the star is: radians,
/// counterclockwise from the x axis of the place's own frame. Stars left out have none.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Bearings(pub Vec<Vec<Option<f64>>>);

impl Bearings {
    /// No bearings: every star is drawn by its order alone, its first end upwards.
    #[must_use]
    pub fn none() -> Self {
        Bearings::default()
    }

    fn of(&self, star: StarId) -> &[Option<f64>] {
        self.0.get(star.index()).map_or(&[], Vec::as_slice)
    }
}

/// By oriented local path: the place it belongs to and its direction in that place's frame.
pub(super) fn of_map(map: &TopologicalMap, bearings: &Bearings) -> Result<Vec<(PlaceId, f64)>, DrawingError> {
    let mut ends = Vec::new();
    for place in map.places() {
        let star = map.star(place);
        let opposite: Vec<usize> =
            map.olps_of(place).map(|olp| map.local(map.opposite(olp)).index()).collect();
        let given = bearings.of(star);
        let directions = match given {
            [] => plain(&opposite),
            _ if given.len() != opposite.len() => {
                let (ends, given) = (opposite.len(), given.len());
                return Err(DrawingError::BearingCount { star, ends, given });
            }
            _ if given.iter().all(Option::is_none) => plain(&opposite),
            _ => between_measured(given)
                .ok_or_else(|| DrawingError::NotClockwise { star, bearings: given.to_vec() })?,
        };
        ends.extend(directions.into_iter().map(|direction| (place, direction)));
    }
    Ok(ends)
}

/// The measured bearings, with the ends between two of them spread evenly. `None` if the measured ones
/// are not finite or do not go around clockwise exactly once.
fn between_measured(bearings: &[Option<f64>]) -> Option<Vec<f64>> {
    let degree = bearings.len();
    let known: Vec<(usize, f64)> =
        bearings.iter().enumerate().filter_map(|(end, &bearing)| Some((end, bearing?))).collect();
    if known.iter().any(|(_, bearing)| !bearing.is_finite()) {
        return None;
    }
    let mut directions = vec![0.0; degree];
    let mut around = 0.0;
    for (index, &(end, bearing)) in known.iter().enumerate() {
        let (next, next_bearing) = known[(index + 1) % known.len()];
        let steps = if next > end { next - end } else { next + degree - end };
        let turn = match (bearing - next_bearing).rem_euclid(TAU) {
            _ if known.len() == 1 => TAU,
            turn => turn,
        };
        if turn == 0.0 {
            return None;
        }
        around += turn;
        for step in 0..steps {
            directions[(end + step) % degree] = bearing - turn * step as f64 / steps as f64;
        }
    }
    (around < 1.5 * TAU).then_some(directions)
}

/// How much of an even gap is left at least between neighbours when local paths are straightened.
const NARROWEST_GAP: f64 = 0.45;

/// Directions of a star without bearings, the first end upwards: evenly around, but local paths as
/// straight as the circular order allows. `opposite[end]` is the other end of the same local path.
fn plain(opposite: &[usize]) -> Vec<f64> {
    let degree = opposite.len();
    let even = TAU / degree as f64;
    let straight = straightened_gaps(opposite, even);
    // As much of the straightening as leaves every gap wide enough.
    let share = |gap: f64| {
        if gap >= NARROWEST_GAP * even { 1.0 } else { (1.0 - NARROWEST_GAP) * even / (even - gap) }
    };
    let share = straight.iter().map(|&gap| share(gap)).fold(1.0, f64::min);
    let mut direction = FRAC_PI_2;
    let mut directions = Vec::with_capacity(degree);
    for gap in straight {
        directions.push(direction);
        direction -= even + share * (gap - even);
    }
    directions
}

/// The gaps after each end that minimize the sum of squares of (gap − even gap) over the neighbours and of
/// (turn − π) over the local paths.
fn straightened_gaps(opposite: &[usize], even: f64) -> Vec<f64> {
    let degree = opposite.len();
    // Unknowns: the offsets of ends 1, 2, … clockwise from end 0.
    let unknowns = degree - 1;
    let mut matrix = DMatrix::zeros(unknowns, unknowns);
    let mut right_hand_side = DVector::zeros(unknowns);
    let mut wish = |from: usize, to: usize, turn: f64| {
        // (offset of `to`, one turn further if it comes around) − (offset of `from`) = turn
        let turn = if to <= from { turn - TAU } else { turn };
        let entries: Vec<(usize, f64)> =
            [(from, -1.0), (to, 1.0)].into_iter().filter(|&(end, _)| end > 0).collect();
        for &(row, sign) in &entries {
            right_hand_side[row - 1] += sign * turn;
            for &(column, other) in &entries {
                matrix[(row - 1, column - 1)] += sign * other;
            }
        }
    };
    for (end, &opposite) in opposite.iter().enumerate() {
        wish(end, (end + 1) % degree, even);
        if end < opposite {
            wish(end, opposite, PI);
        }
    }
    let offsets = nalgebra::Cholesky::new(matrix)
        .expect("the gaps alone make the matrix positive definite")
        .solve(&right_hand_side);
    let offset = |end: usize| match end {
        0 => 0.0,
        _ if end == degree => TAU,
        _ => offsets[end - 1],
    };
    (0..degree).map(|end| offset(end + 1) - offset(end)).collect()
}

#[cfg(test)]
mod tests {
    use hssh_topology::{MapOlp, Olp};

    use super::*;

    fn degrees(directions: &[f64]) -> Vec<i64> {
        directions.iter().map(|direction| direction.to_degrees().round() as i64).collect()
    }

    #[test]
    fn crossing_local_paths_are_straight_and_even() {
        assert_eq!(degrees(&plain(&[1, 0])), [90, -90]);
        assert_eq!(degrees(&plain(&[2, 3, 0, 1])), [90, 0, -90, -180]);
        assert_eq!(degrees(&plain(&[3, 4, 5, 0, 1, 2])), [90, 30, -30, -90, -150, -210]);
    }

    #[test]
    fn nested_local_paths_share_the_bend() {
        // 0+ 1+ 1- 0-: gaps a b a c minimize 2(a−90)² + (b−90)² + (c−90)² + (2a+b−180)² + (b−180)²
        // with 2a + b + c = 360: a = 60, b = c = 120.
        assert_eq!(degrees(&plain(&[3, 2, 1, 0])), [90, 30, -90, -150]);
    }

    #[test]
    fn neighbours_never_meet() {
        // Five local paths side by side: straightening alone would fold the star.
        for opposite in [vec![9, 8, 7, 6, 5, 4, 3, 2, 1, 0], vec![1, 0, 3, 2, 5, 4, 7, 6]] {
            let directions = plain(&opposite);
            let even = TAU / opposite.len() as f64;
            let last = directions[0] - TAU;
            for (here, next) in directions.iter().zip(directions[1..].iter().chain([&last])) {
                assert!(here - next >= NARROWEST_GAP * even - 1e-12);
            }
        }
    }

    #[test]
    fn unknown_bearings_lie_evenly_between_known_ones() {
        let known = |degrees: f64| Some(degrees.to_radians());
        let directions = between_measured(&[None, known(10.0), None, known(-170.0)]).unwrap();
        assert_eq!(
            degrees(&directions).iter().map(|d| d.rem_euclid(360)).collect::<Vec<_>>(),
            [100, 10, 280, 190]
        );
        assert_eq!(between_measured(&[known(0.0), known(90.0), known(180.0)]), None);
        assert_eq!(between_measured(&[known(0.0), known(0.0)]), None);
        assert_eq!(between_measured(&[Some(f64::NAN), None]), None);
        assert_eq!(between_measured(&[Some(1.0)]), Some(vec![1.0]));
    }

    #[test]
    fn ends_are_counted_from_the_first_of_their_place() {
        let mut map = TopologicalMap::new();
        let star = "0+ 1+ 0- 1-".parse().unwrap();
        map.add_place(StarId::new(0), &star);
        map.add_place(StarId::new(0), &star);
        let ends = of_map(&map, &Bearings::none()).unwrap();
        assert_eq!(ends.len(), 8);
        assert_eq!(ends[map.olp(PlaceId::new(1), Olp::new(0)).index()], (PlaceId::new(1), FRAC_PI_2));
        assert_eq!(MapOlp::new(4), map.olp(PlaceId::new(1), Olp::new(0)));
    }
}
