//! Whether visits to one place have one place in a map.

use hssh_metrics::Pose;

/// Visits nearer than this are truly to one place, in metres.
const ONE_PLACE: f64 = 1.5;
/// Visits farther apart than this are truly to two places, in metres.
const TWO_PLACES: f64 = 4.0;

/// Pairs of visits, counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct SamePlace {
    /// Truly to one place: with one place in the map, of all.
    truly: (usize, usize),
    /// With one place in the map: truly near one another, of all.
    said: (usize, usize),
}

impl SamePlace {
    /// Counts pairs of visits, by the true pose of the robot on each and the place that a map has for it.
    pub(crate) fn new<P: PartialEq>(visits: &[(Pose, P)]) -> Self {
        let mut count = SamePlace::default();
        for (index, (pose, place)) in visits.iter().enumerate() {
            for (other, other_place) in &visits[..index] {
                let apart = (pose.translation() - other.translation()).norm();
                let is_one = place == other_place;
                if apart <= ONE_PLACE {
                    count.truly.0 += usize::from(is_one);
                    count.truly.1 += 1;
                }
                if is_one {
                    count.said.0 += usize::from(apart <= TWO_PLACES);
                    count.said.1 += 1;
                }
            }
        }
        count
    }

    /// Of the pairs truly to one place, the part that has one in the map; none without such pairs.
    pub(crate) fn recall(self) -> Option<f64> {
        share(self.truly)
    }

    /// Of the pairs with one place in the map, the part that truly was near; none without such pairs.
    pub(crate) fn precision(self) -> Option<f64> {
        share(self.said)
    }
}

fn share((some, all): (usize, usize)) -> Option<f64> {
    (all > 0).then(|| some as f64 / all as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Visits along a line by where they truly were, with the map's places.
    fn score(visits: &[(f64, u32)]) -> (Option<f64>, Option<f64>) {
        let visits: Vec<(Pose, u32)> =
            visits.iter().map(|&(x, place)| (Pose::new(x, 0.0, 0.0), place)).collect();
        let found = SamePlace::new(&visits);
        (found.recall(), found.precision())
    }

    #[test]
    fn pairs_are_counted() {
        assert_eq!(score(&[(0.0, 0), (10.0, 1), (0.3, 0)]), (Some(1.0), Some(1.0)));
        assert_eq!(score(&[(0.0, 0), (10.0, 0), (0.3, 0)]), (Some(1.0), Some(1.0 / 3.0)));
        assert_eq!(score(&[(0.0, 0), (0.2, 0), (0.4, 1)]), (Some(1.0 / 3.0), Some(1.0)));
        assert_eq!(score(&[(0.0, 0), (10.0, 1)]), (None, None));
    }

    /// Between the two limits nothing is held against a map.
    #[test]
    fn what_may_be_one_place_or_two_is_right_either_way() {
        assert_eq!(score(&[(0.0, 0), (3.0, 0)]), (None, Some(1.0)));
        assert_eq!(score(&[(0.0, 0), (3.0, 1)]), (None, None));
    }
}
