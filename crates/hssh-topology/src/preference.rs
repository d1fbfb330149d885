//! Which map is preferred: boundary relations over paths over places (section 2.3.2).

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::map::TopologicalMap;

/// What preference looks at in a map.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub struct Measure {
    /// Pairs of a path and a place off it without a boundary relation, or with both.
    pub f1: u64,
    /// Paths.
    pub f2: u32,
    /// Places.
    pub f3: u32,
    /// Genus of the embedded graph.
    pub genus: u32,
}

impl Measure {
    /// The measure of a map.
    #[must_use]
    pub fn of(map: &TopologicalMap) -> Self {
        Measure {
            f1: map.undetermined_boundary_count(),
            f2: map.path_count(),
            f3: map.place_count(),
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
            f1: map.permanently_undetermined_boundary_count(),
            f2: Measure::least_paths(map.closed_end_count(), map.pending_count(), travels),
            f3: map.place_count(),
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
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Rank([u64; 4]);

impl Preference {
    /// The rank of a map with that measure. It does not fall when a number of the measure grows.
    #[must_use]
    pub fn rank(self, measure: Measure) -> Rank {
        let Measure { f1, f2, f3, genus } = measure;
        let (f2, f3, genus) = (u64::from(f2), u64::from(f3), u64::from(genus));
        Rank(match self.genus {
            GenusRank::Ignored => [f1, f2, f3, 0],
            GenusRank::First => [genus, f1, f2, f3],
            GenusRank::Last => [f1, f2, f3, genus],
        })
    }

    /// The measure of a rank; its genus is 0 if the genus does not count.
    #[must_use]
    pub fn measure(self, rank: Rank) -> Measure {
        let Rank([a, b, c, d]) = rank;
        let (f1, f2, f3, genus) = match self.genus {
            GenusRank::Ignored | GenusRank::Last => (a, b, c, d),
            GenusRank::First => (b, c, d, a),
        };
        Measure { f1, f2: f2 as u32, f3: f3 as u32, genus: genus as u32 }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "(f1 {}, f2 {}, f3 {}), genus {}", self.f1, self.f2, self.f3, self.genus)
    }
}
