//! The true map, grown beside the search: what becomes of it under a set of axioms.

use std::collections::BTreeMap;
use std::fmt;

use hssh_search::Experience;
use hssh_topology::{Axioms, Derivation, Hypothesis, Outcome, PlaceId, Rules, Step};
use serde::{Deserialize, Serialize};

/// What became of the true map, from bad to good.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Verdict {
    /// The axioms do not admit it.
    Lost,
    /// It is one of the final maps, but not one of the best that the search found.
    Survives,
    /// It shares the best rank with others.
    AmongOptima,
    /// No other map ranks as high.
    OnlyOptimum,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Verdict::Lost => "lost",
            Verdict::Survives => "survives",
            Verdict::AmongOptima => "among optima",
            Verdict::OnlyOptimum => "only optimum",
        })
    }
}

/// The hypothesis that takes every visit for what it was; `None` if the axioms do not admit it.
///
/// `visits` are the places truly visited, by any numbers, the start first. At every visit of a place
/// its star must have been written down from the same end on, as explorations of worlds are: the true
/// φ is the identity then, and the true map is known gateway by gateway.
pub(crate) fn true_hypothesis(
    experience: &Experience,
    visits: &[usize],
    axioms: &Axioms,
) -> Option<Hypothesis> {
    let mut hypothesis = experience.root();
    let mut known: BTreeMap<usize, PlaceId> = BTreeMap::new();
    known.insert(*visits.first()?, hypothesis.position.place);
    let (rules, mut step) = (Rules { catalog: &experience.catalog, axioms }, Step::default());
    for (&observation, visit) in experience.observations.iter().zip(&visits[1..]) {
        hypothesis.step(observation, rules, &mut step);
        let back_at = |&place| Derivation::Closure(hypothesis.map.olp(place, observation.entry));
        let derivation = match step.outcome {
            Outcome::Predicted => Derivation::Predicted,
            _ => known.get(visit).map_or(Derivation::NewPlace, back_at),
        };
        if !step.derivations.contains(&derivation) {
            return None;
        }
        let _ = hypothesis.follow(observation, derivation, rules.catalog);
        known.entry(*visit).or_insert(hypothesis.position.place);
    }
    Some(hypothesis)
}

/// Whether two hypotheses of one experience are the same map, place and φ. Places are numbered in the
/// order of their creation in both, so that nothing has to be matched.
pub(crate) fn is_same(a: &Hypothesis, b: &Hypothesis) -> bool {
    let stars = |hypothesis: &Hypothesis| -> Vec<_> {
        hypothesis.map.places().map(|place| hypothesis.map.star(place)).collect()
    };
    a.position == b.position && stars(a) == stars(b) && a.map.links().eq(b.map.links())
}
