//! Chains of matches: one match may be chance, several in a row that tell the same are not.

use hssh_metrics::{Pose, wrap_angle};

use super::matching::Match;

/// How far the poses that two matches tell may be apart: metres, metres for each metre of travel between them, and
/// radians.
const CONSISTENT: (f64, f64, f64) = (0.3, 0.03, 0.06);

/// The pose of the query's middle that a match tells, `pose` giving the estimates of the middles.
pub(super) fn told(found: &Match, pose: impl Fn(usize) -> Pose) -> Pose {
    pose(found.reference).compose(found.relative.mean)
}

/// Whether two matches of submaps `travel` metres apart tell the same.
pub(super) fn agree(one: &Match, other: &Match, travel: f64, pose: impl Fn(usize) -> Pose) -> bool {
    let between = pose(one.query).between(pose(other.query));
    let (expected, found) = (told(one, &pose).compose(between), told(other, &pose));
    // What may be slid along a corridor says nothing about how far along it the robot is.
    let mut apart = found.translation() - expected.translation();
    for one in [one, other] {
        if let Some(axis) = one.slide.map(|axis| pose(one.reference).rotation() * axis) {
            apart -= axis * axis.dot(&apart);
        }
    }
    let turned = wrap_angle(found.theta - expected.theta);
    apart.norm() < CONSISTENT.0 + CONSISTENT.1 * travel.abs() && turned.abs() < CONSISTENT.2
}

/// So many submaps back a match may have the one before it in its chain.
const MEMORY: usize = 4;

/// A match, and what precedes it in its chain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linked {
    pub(super) found: Match,
    /// The match before: its query, and which of its matches.
    before: Option<(usize, usize)>,
    /// How many matches the chain up to here has.
    length: usize,
}

/// A match at the end of the longest chain that it continues; `tentative` has the matches of earlier queries.
pub(super) fn linked(
    found: Match,
    tentative: &[Vec<Linked>],
    travelled: impl Fn(usize) -> f64,
    pose: impl Fn(usize) -> Pose,
) -> Linked {
    let mut before: Option<(usize, usize)> = None;
    let mut longest = 0;
    let first = found.query.saturating_sub(MEMORY);
    for (query, matches) in (first..).zip(&tentative[first..found.query]) {
        let travel = travelled(found.query) - travelled(query);
        for (index, other) in matches.iter().enumerate() {
            if other.length > longest && agree(&other.found, &found, travel, &pose) {
                (before, longest) = (Some((query, index)), other.length);
            }
        }
    }
    Linked { found, before, length: longest + 1 }
}

/// A match with the best of each query shortly before that tells the same, the last one first.
pub(super) fn recent(
    last: &Match,
    tentative: &[Vec<Linked>],
    travelled: impl Fn(usize) -> f64,
    pose: impl Fn(usize) -> Pose,
) -> Vec<Match> {
    let before = (last.query.saturating_sub(MEMORY)..last.query).filter_map(|query| {
        let travel = travelled(last.query) - travelled(query);
        let same = tentative[query].iter().map(|other| other.found);
        let same = same.filter(|other| agree(other, last, travel, &pose));
        same.max_by(|a, b| a.score.total_cmp(&b.score))
    });
    std::iter::once(*last).chain(before).collect()
}

/// The matches of a chain, the last one first.
pub(super) fn chain(last: &Linked, tentative: &[Vec<Linked>]) -> Vec<Match> {
    let before = |one: &&Linked| one.before.and_then(|(query, index)| tentative[query].get(index));
    std::iter::successors(Some(last), before).map(|one| one.found).collect()
}
