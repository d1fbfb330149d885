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
    /// Whether it tells where the robot is, and not only on which line: such a one only carries a chain on.
    pub(super) is_firm: bool,
    /// The match before: its query, and which of its matches.
    before: Option<(usize, usize)>,
    /// How many firm matches the chain up to here has.
    length: usize,
    /// The last firm one of these.
    firm: Option<Match>,
}

/// A match at the end of the longest chain that it continues; `tentative` has the matches of earlier queries.
pub(super) fn linked(
    found: Match,
    is_firm: bool,
    tentative: &[Vec<Linked>],
    travelled: impl Fn(usize) -> f64,
    pose: impl Fn(usize) -> Pose,
) -> Linked {
    let mut before: Option<(usize, usize)> = None;
    let (mut longest, mut firm) = (0, None);
    let first = found.query.saturating_sub(MEMORY);
    for (query, matches) in (first..).zip(&tentative[first..found.query]) {
        let travel = travelled(found.query) - travelled(query);
        for (index, other) in matches.iter().enumerate() {
            // What carries the chain on says nothing about how far along the robot is; the last firm one does.
            let is_same =
                |last: Match| agree(&last, &found, travelled(found.query) - travelled(last.query), &pose);
            if other.length > longest
                && agree(&other.found, &found, travel, &pose)
                && other.firm.is_none_or(is_same)
            {
                (before, longest, firm) = (Some((query, index)), other.length, other.firm);
            }
        }
    }
    let firm = if is_firm { Some(found) } else { firm };
    Linked { found, is_firm, before, length: longest + usize::from(is_firm), firm }
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
        let same = tentative[query].iter().filter(|other| other.is_firm).map(|other| other.found);
        let same = same.filter(|other| agree(other, last, travel, &pose));
        same.max_by(|a, b| a.score.total_cmp(&b.score))
    });
    std::iter::once(*last).chain(before).collect()
}

/// The firm matches of a chain, the last one first.
pub(super) fn chain(last: &Linked, tentative: &[Vec<Linked>]) -> Vec<Match> {
    let before = |one: &&Linked| one.before.and_then(|(query, index)| tentative[query].get(index));
    std::iter::successors(Some(last), before).filter(|one| one.is_firm).map(|one| one.found).collect()
}

#[cfg(test)]
mod tests {
    use hssh_metrics::{Covariance, UncertainPose};
    use nalgebra::Vector2;

    use super::*;

    /// The robot goes along x, a submap every 2.5 m, and meets a pass of 100 m of travel before, 1 m beside it.
    fn matched(query: usize, along: f64, slides: bool) -> Match {
        let mean = Pose::new(along, 1.0, 0.0);
        let covariance = Covariance::from_standard_deviations(0.1, 0.1, 0.01).unwrap();
        Match {
            query,
            reference: query - 40,
            relative: UncertainPose { mean, covariance },
            slide: slides.then(|| Vector2::new(1.0, 0.0)),
            score: 0.8,
            agreement: 1.0,
            overlap: 20.0,
            is_clear: true,
            is_expected: false,
            spread: 10.0,
            off: 1.0,
        }
    }

    /// The firm matches of the chain that ends with the last of these, by how far along each tells that the robot is, and whether it slides.
    fn firm(matches: &[(f64, bool)]) -> usize {
        let mut tentative: Vec<Vec<Linked>> = vec![Vec::new(); 100];
        let pose = |submap: usize| Pose::new(2.5 * (submap % 40) as f64, 0.0, 0.0);
        for (query, &(along, slides)) in (40..).zip(matches) {
            let last = linked(
                matched(query, along, slides),
                !slides,
                &tentative,
                |submap| 2.5 * submap as f64,
                pose,
            );
            tentative[query].push(last);
        }
        chain(&tentative[39 + matches.len()][0], &tentative).len()
    }

    #[test]
    fn what_slides_carries_a_chain_on_and_does_not_count() {
        let row = |firm: usize, slides: usize| {
            [vec![(0.0, false); firm], vec![(0.0, true); slides], vec![(0.0, false); firm]].concat()
        };
        assert_eq!([firm(&row(3, 0)), firm(&row(3, 12))], [6, 6]);
        // Wherever it was slid to.
        let slid: Vec<(f64, bool)> =
            row(3, 12).into_iter().map(|(_, slides)| (if slides { 4.0 } else { 0.0 }, slides)).collect();
        assert_eq!(firm(&slid), 6);
    }

    /// After 5 m of a bare corridor, 3 m off: that is another place.
    #[test]
    fn firm_matches_agree_with_one_another_whatever_slid_between() {
        let row = [[(0.0, false); 3].as_slice(), &[(0.0, true); 2], &[(3.0, false); 3]].concat();
        assert_eq!(firm(&row), 3);
    }
}
