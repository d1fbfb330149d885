//! The order of preference: (f1, f2, f3), and the genus before it, after it, or not at all (section 2.3.2).

use std::cmp::Ordering;

use crate::lines::{Refusal, Statement};
use crate::map::Map;
use crate::paths::Paths;

/// Where the genus stands in the order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GenusPlace {
    Ignored,
    First,
    Last,
}

/// What preference counts in a map, or a bound on that.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Rank {
    pub(crate) f1: u64,
    pub(crate) f2: u64,
    pub(crate) f3: u64,
    pub(crate) genus: u64,
}

impl Rank {
    /// Four numbers of a line.
    pub(crate) fn read(statement: &mut Statement<'_>) -> Result<Rank, Refusal> {
        Ok(Rank {
            f1: statement.count("f1")?,
            f2: statement.count("f2")?,
            f3: statement.count("f3")?,
            genus: statement.count("a genus")?,
        })
    }

    /// As the certificate writes it.
    pub(crate) fn numbers(self) -> [u64; 4] {
        [self.f1, self.f2, self.f3, self.genus]
    }

    /// What the map is worth.
    pub(crate) fn of(map: &mut Map, paths: &mut Paths) -> Rank {
        paths.trace(map);
        paths.find_sides(map);
        Rank {
            f1: paths.undetermined() as u64,
            f2: paths.count() as u64,
            f3: map.places.len() as u64,
            genus: map.genus() as u64,
        }
    }

    /// What no map that grows from this one within so many travels falls below in any number.
    pub(crate) fn bound(map: &mut Map, paths: &mut Paths, travels: usize) -> Rank {
        paths.trace(map);
        paths.find_sides(map);
        let ends = map.closed_ends() + map.pending().saturating_sub(2 * travels);
        Rank {
            f1: paths.undetermined_for_good() as u64,
            f2: ends.div_ceil(2) as u64,
            f3: map.places.len() as u64,
            genus: map.genus() as u64,
        }
    }
}

impl GenusPlace {
    /// Which of two ranks is preferred: the lesser.
    pub(crate) fn compare(self, a: &Rank, b: &Rank) -> Ordering {
        let key = |rank: &Rank| {
            let f = (rank.f1, rank.f2, rank.f3);
            match self {
                GenusPlace::Ignored => (0, f, 0),
                GenusPlace::First => (rank.genus, f, 0),
                GenusPlace::Last => (0, f, rank.genus),
            }
        };
        key(a).cmp(&key(b))
    }
}

impl std::fmt::Display for Rank {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {} {}", self.f1, self.f2, self.f3, self.genus)
    }
}
