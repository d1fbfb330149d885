//! F, the one number that chapter 4 makes of the order of preference (section 4.5 and 4.7.1).

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::map::TopologicalMap;

/// The weights of F = c1·f1 + c2·f2' + c3·f3, equation (4.15). The less F, the simpler the map.
///
/// f1 and f3 are those of section 2.3.2; f2' counts the paths with at least two places, so that a place
/// just found does not add all the paths that begin in it (section 4.7.1).
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Simplicity {
    /// Weight of the missing boundary relations.
    pub c1: f64,
    /// Weight of the paths with at least two places.
    pub c2: f64,
    /// Weight of the places.
    pub c3: f64,
}

impl Default for Simplicity {
    /// Section 4.7.1: F = 2·f2' + f3.
    fn default() -> Self {
        Simplicity { c1: 0.0, c2: 2.0, c3: 1.0 }
    }
}

/// Weights that make no order.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error("the weights of F are {0}: each must be finite and not negative, and that of the places positive")]
pub struct SimplicityError(Simplicity);

impl Simplicity {
    /// Checks that no weight is negative and that every place counts, so that F is positive.
    ///
    /// # Errors
    /// If they are not so.
    pub fn check(self) -> Result<(), SimplicityError> {
        let Simplicity { c1, c2, c3 } = self;
        let usable = [c1, c2, c3].iter().all(|weight| weight.is_finite() && *weight >= 0.0) && c3 > 0.0;
        if usable { Ok(()) } else { Err(SimplicityError(self)) }
    }

    /// F of a map.
    #[must_use]
    pub fn of(self, map: &TopologicalMap) -> f64 {
        let f1 = if self.c1 > 0.0 { map.undetermined_boundary_count() } else { 0 };
        let f2 = map.long_path_count();
        self.c1 * f1 as f64 + self.c2 * f64::from(f2) + self.c3 * f64::from(map.place_count())
    }

    /// A number that F does not fall below in any map grown from this one by at most `travels` more
    /// travels. Each place more adds c3 to it.
    #[must_use]
    pub fn bound(self, map: &TopologicalMap, travels: u32) -> f64 {
        self.floor(map).least(travels)
    }

    /// What F does not fall below in any map grown from this one.
    ///
    /// A path with two places keeps them, and every path has two ends: of those on such paths, the closed
    /// ones stay, and a travel links at most two of the pending ones.
    #[must_use]
    pub fn floor(self, map: &TopologicalMap) -> SimplicityFloor {
        let f1 = if self.c1 > 0.0 { map.permanently_undetermined_boundary_count() } else { 0 };
        let fixed = self.c1 * f1 as f64 + self.c3 * f64::from(map.place_count());
        let (pending, closed) = (map.pending_ends_of_long_paths(), map.closed_ends_of_long_paths());
        SimplicityFloor { c2: self.c2, fixed, pending, closed }
    }
}

/// What F does not fall below, by how many travels are to come.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct SimplicityFloor {
    c2: f64,
    /// What boundary relations and places weigh.
    fixed: f64,
    /// The pending ends of paths with at least two places.
    pending: u32,
    /// Their closed ends.
    closed: u32,
}

impl SimplicityFloor {
    /// For at most so many travels more.
    #[must_use]
    pub fn least(self, travels: u32) -> f64 {
        let ends = self.closed + self.pending.saturating_sub(travels.saturating_mul(2));
        self.fixed + self.c2 * f64::from(ends.div_ceil(2))
    }
}

impl fmt::Display for Simplicity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}·f1 + {}·f2' + {}·f3", self.c1, self.c2, self.c3)
    }
}
