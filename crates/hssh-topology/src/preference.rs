//! Which map is preferred: boundary relations over paths over places (section 2.3.2).

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::map::TopologicalMap;

/// What preference looks at in a map.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub struct Measure {
    /// f1 of section 2.3.2: pairs of a path and a place off it without a boundary relation, or with both.
    pub undetermined_boundaries: u64,
    /// f2: paths.
    pub paths: u32,
    /// f3: places.
    pub places: u32,
    /// Genus of the embedded graph.
    pub genus: u32,
}

impl Measure {
    /// The measure of a map.
    #[must_use]
    pub fn of(map: &TopologicalMap) -> Self {
        Measure {
            undetermined_boundaries: map.undetermined_boundary_count(),
            paths: map.path_count(),
            places: map.place_count(),
            genus: map.graph().genus(),
        }
    }

    /// A measure that no map grown from this one by at most `travels` more travels falls below, in
    /// any of its numbers.
    ///
    /// Places, genus and closed ends never fall. A travel links at most two of the gateways that are
    /// pending now, and the ends of paths are the closed ends and the pending gateways, two to a path.
    #[must_use]
    pub fn bound(map: &TopologicalMap, travels: u32) -> Self {
        Measure {
            undetermined_boundaries: map.permanently_undetermined_boundary_count(),
            paths: Measure::least_paths(map.closed_end_count(), map.pending_count(), travels),
            places: map.place_count(),
            genus: map.graph().genus(),
        }
    }
}

impl Measure {
    /// How many paths there are at least after so many travels more, with so many closed ends and pending gateways now.
    #[must_use]
    pub fn least_paths(closed_ends: u32, pending: u32, travels: u32) -> u32 {
        (closed_ends + pending.saturating_sub(travels.saturating_mul(2))).div_ceil(2)
    }
}

/// Where the genus stands in the order (relaxed planarity, end of section 3.2).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub enum GenusRank {
    /// The genus does not count.
    #[default]
    Ignored,
    /// It comes before all else.
    First,
    /// It decides between maps that are equal otherwise.
    Last,
}

/// The lexicographic order (2.1) over (f1, f2, f3), with the genus before or after them if wanted.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Preference {
    /// Where the genus stands.
    pub genus: GenusRank,
}

/// The place of a map in the order of preference: the less, the better.
///
/// The four numbers of a measure, each in a field of bits of its own, the first in the order highest.
/// A number too large for its field counts as the largest that it holds: 2⁴⁴ − 1 undetermined boundary
/// relations, 2²⁸ − 1 of anything else.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Rank(u128);

/// The width of the fields of a [`Rank`]: undetermined boundary relations have one, all else another.
const BOUNDARY_BITS: u32 = 44;
const COUNT_BITS: u32 = 28;

impl Preference {
    /// The rank of a map with that measure. It does not fall when a number of the measure grows.
    #[must_use]
    pub fn rank(self, measure: Measure) -> Rank {
        let Measure { undetermined_boundaries, paths, places, genus } = measure;
        let capped = |number: u64, bits: u32| u128::from(number.min((1 << bits) - 1));
        let [paths, places, genus] = [paths, places, genus].map(|n| capped(u64::from(n), COUNT_BITS));
        let boundaries = capped(undetermined_boundaries, BOUNDARY_BITS);
        let by_order = ((boundaries << COUNT_BITS | paths) << COUNT_BITS) | places; // (2.1)
        Rank(match self.genus {
            GenusRank::Ignored => by_order,
            GenusRank::First => genus << (BOUNDARY_BITS + 2 * COUNT_BITS) | by_order,
            GenusRank::Last => by_order << COUNT_BITS | genus,
        })
    }

    /// The measure of a rank; its genus is 0 if the genus does not count.
    #[must_use]
    pub fn measure(self, rank: Rank) -> Measure {
        let Rank(fields) = rank;
        let (by_order, genus) = match self.genus {
            GenusRank::Ignored => (fields, 0),
            GenusRank::First => (fields, fields >> (BOUNDARY_BITS + 2 * COUNT_BITS)),
            GenusRank::Last => (fields >> COUNT_BITS, fields),
        };
        let count = |fields: u128| (fields & ((1 << COUNT_BITS) - 1)) as u32;
        Measure {
            undetermined_boundaries: (by_order >> (2 * COUNT_BITS) & ((1 << BOUNDARY_BITS) - 1)) as u64,
            paths: count(by_order >> COUNT_BITS),
            places: count(by_order),
            genus: count(genus),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Measure { undetermined_boundaries, paths, places, genus } = self;
        write!(f, "(f1 {undetermined_boundaries}, f2 {paths}, f3 {places}), genus {genus}")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The same order, spelled out.
    fn key(preference: Preference, measure: Measure) -> [u64; 4] {
        let Measure { undetermined_boundaries, paths, places, genus } = measure;
        let [paths, places, genus] = [paths, places, genus].map(u64::from);
        match preference.genus {
            GenusRank::Ignored => [undetermined_boundaries, paths, places, 0],
            GenusRank::First => [genus, undetermined_boundaries, paths, places],
            GenusRank::Last => [undetermined_boundaries, paths, places, genus],
        }
    }

    /// Measures whose numbers are small and often the same, or as large as can be told apart.
    fn measure() -> impl Strategy<Value = Measure> {
        let number = |bits: u32| prop_oneof![0..3_u64, 0..1_u64 << bits, Just((1_u64 << bits) - 1)];
        let numbers = (number(BOUNDARY_BITS), number(COUNT_BITS), number(COUNT_BITS), number(COUNT_BITS));
        numbers.prop_map(|(undetermined_boundaries, paths, places, genus)| {
            let [paths, places, genus] = [paths, places, genus].map(|number| number as u32);
            Measure { undetermined_boundaries, paths, places, genus }
        })
    }

    proptest! {
        #[test]
        fn ranks_order_measures_number_by_number_and_give_them_back((a, b) in (measure(), measure())) {
            for genus in [GenusRank::Ignored, GenusRank::First, GenusRank::Last] {
                let preference = Preference { genus };
                let (rank, other) = (preference.rank(a), preference.rank(b));
                prop_assert_eq!(rank.cmp(&other), key(preference, a).cmp(&key(preference, b)));
                let genus = if genus == GenusRank::Ignored { 0 } else { a.genus };
                prop_assert_eq!(preference.measure(rank), Measure { genus, ..a });
            }
        }
    }

    #[test]
    fn numbers_beyond_all_maps_count_as_the_largest() {
        let most = Measure { undetermined_boundaries: u64::MAX, paths: u32::MAX, places: 1, genus: u32::MAX };
        let less = Measure { genus: 0, ..most };
        for genus in [GenusRank::First, GenusRank::Last] {
            assert!(Preference { genus }.rank(less) < Preference { genus }.rank(most));
        }
        let capped = Measure { undetermined_boundaries: (1 << 44) - 1, paths: (1 << 28) - 1, ..less };
        let preference = Preference::default();
        assert_eq!(preference.rank(most), preference.rank(capped));
        assert_eq!(preference.measure(preference.rank(most)), capped);
    }
}
