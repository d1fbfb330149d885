//! What is known from elsewhere of which visits are to one place: must-link and cannot-link constraints on the data association.

use std::collections::BTreeMap;

/// A pair of visits, counted from 0, the start.
pub type VisitPair = [usize; 2];

/// Pairs of visits that are known to be to the same place, or known not to be. No map that says otherwise explains the exploration.
///
/// What follows of the pairs is kept instead of them: two that say the same are equal.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct VisitConstraints {
    /// By the later visit: earlier ones, each with whether it is to the same place.
    by_later: BTreeMap<usize, Vec<(usize, bool)>>,
}

/// Why constraints are none.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ConstraintError {
    /// A visit that is not the same as itself, or a pair of one visit.
    #[error("visit {0} stands twice in a pair: two different visits are one place or two")]
    Itself(usize),
    /// By the pairs of the same place two visits are at one, and a pair says that they are not.
    #[error(
        "visits {} and {} are said to be at different places, and also (by other pairs, maybe) at the same", .0[0], .0[1]
    )]
    Contradiction(VisitPair),
    /// There is no such visit.
    #[error("there is no visit {visit}: the visits are 0, the start, to {last}")]
    Visit {
        /// The visit.
        visit: usize,
        /// The last one that there is.
        last: usize,
    },
}

impl VisitConstraints {
    /// Constraints on pairs of visits; those at the same place may be given in any order and need not be complete.
    ///
    /// # Errors
    /// If a pair is of one visit, or if the pairs contradict one another.
    pub fn new(same: &[VisitPair], different: &[VisitPair]) -> Result<Self, ConstraintError> {
        if let Some([visit, _]) = same.iter().chain(different).find(|[one, other]| one == other) {
            return Err(ConstraintError::Itself(*visit));
        }
        let mut leaders = BTreeMap::new();
        for &[one, other] in same {
            let (one, other) = (leader(&leaders, one), leader(&leaders, other));
            if one != other {
                leaders.insert(one.max(other), one.min(other));
            }
        }
        let is_one = |&&[one, other]: &&VisitPair| leader(&leaders, one) == leader(&leaders, other);
        if let Some(&pair) = different.iter().find(is_one) {
            return Err(ConstraintError::Contradiction(pair));
        }
        let mut by_later: BTreeMap<usize, Vec<(usize, bool)>> = BTreeMap::new();
        // What follows of the pairs is said of the first visit of each place, and so known as early as can be.
        for &visit in same.iter().flatten() {
            let first = leader(&leaders, visit);
            if first != visit {
                by_later.entry(visit).or_default().push((first, true));
            }
        }
        for &[one, other] in different {
            let (one, other) = (leader(&leaders, one), leader(&leaders, other));
            by_later.entry(one.max(other)).or_default().push((one.min(other), false));
        }
        for said in by_later.values_mut() {
            said.sort_unstable();
            said.dedup();
        }
        Ok(VisitConstraints { by_later })
    }

    /// Whether all visits exist, the last one being that.
    ///
    /// # Errors
    /// If one does not.
    pub fn check(&self, last: usize) -> Result<(), ConstraintError> {
        // The last visit of all pairs is the later one of something.
        match self.by_later.last_key_value() {
            Some((&visit, _)) if visit > last => Err(ConstraintError::Visit { visit, last }),
            _ => Ok(()),
        }
    }

    /// What is asked when a visit is explained, as it follows of the pairs: an earlier visit and it, and whether they are to one place.
    pub(crate) fn asked(&self) -> impl Iterator<Item = (VisitPair, bool)> {
        let said = |(&later, said): (&usize, &Vec<(usize, bool)>)| -> Vec<(VisitPair, bool)> {
            said.iter().map(|&(earlier, same)| ([earlier, later], same)).collect()
        };
        self.by_later.iter().flat_map(said)
    }

    /// Whether anything is said of a visit and an earlier one.
    pub(crate) fn concern(&self, visit: usize) -> bool {
        self.by_later.contains_key(&visit)
    }

    /// Whether a visit may be where it is taken to be; `is_there` tells whether an earlier visit was to the same place.
    pub(crate) fn allow(&self, visit: usize, is_there: impl Fn(usize) -> bool) -> bool {
        let said = self.by_later.get(&visit);
        said.is_none_or(|said| said.iter().all(|&(earlier, same)| is_there(earlier) == same))
    }
}

/// The first visit that a visit is known to be the same as.
fn leader(leaders: &BTreeMap<usize, usize>, visit: usize) -> usize {
    let mut visit = visit;
    while let Some(&before) = leaders.get(&visit) {
        visit = before;
    }
    visit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_that_follow_are_known_and_contradictions_found() {
        let constraints = VisitConstraints::new(&[[3, 1], [5, 3]], &[[5, 2]]).unwrap();
        assert!(constraints.allow(3, |earlier| earlier == 1));
        assert!(!constraints.allow(5, |_| false));
        assert!(!constraints.allow(2, |earlier| earlier == 1));
        assert_eq!(
            VisitConstraints::new(&[[3, 1], [5, 3]], &[[1, 5]]),
            Err(ConstraintError::Contradiction([1, 5]))
        );
        assert_eq!(VisitConstraints::new(&[[4, 4]], &[]), Err(ConstraintError::Itself(4)));
        assert_eq!(
            constraints,
            VisitConstraints::new(&[[1, 5], [5, 3]], &[[2, 3]]).unwrap(),
            "the same in other words"
        );
        assert_eq!(constraints.check(5), Ok(()));
        assert_eq!(constraints.check(4), Err(ConstraintError::Visit { visit: 5, last: 4 }));
    }
}
