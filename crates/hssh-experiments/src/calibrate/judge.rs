//! What of a survey and of its best map is wrong, by the true poses.

use std::ops::AddAssign;

use hssh::answer::AnsweredMap;
use hssh_local::{Survey, SurveyWarning, Track};
use hssh_metrics::Pose;

use super::count::Count;

/// A relative position is wrong if it is off by more than this, in metres.
const OFF: f64 = 2.0;
/// Visits farther apart than this are not to one place, in metres…
const TWO_PLACES: f64 = 4.0;
/// …and nearer than this not to two.
const ONE_PLACE: f64 = 1.0;
/// The robot truly is back where two poses are this near, in metres…
const BACK: f64 = 1.0;
/// …and it travelled so far since; so far apart on both passes it is back anew. Asked every so many metres.
const LEAST_TRAVEL: f64 = 15.0;
const STEP: f64 = 1.0;

/// What a survey rests on, and what of it is wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Errors {
    /// Returns that the laser shows; wrong if the closed track is off at one of their closures, which alone may not know
    /// how far along a corridor the robot is.
    pub(crate) returns: Count,
    /// Contradicted ones; wrong if the closed track is off there.
    pub(crate) contradicted: Count,
    /// Unconfirmed ones; wrong if the closed track is off there.
    pub(crate) unconfirmed: Count,
    /// True returns; wrong if the closed track is off there. No probability of the model is about these.
    pub(crate) true_returns: Count,
}

/// The kinds of errors by name, with the probability that the model has for them.
pub(crate) const KINDS: [&str; 4] = ["return", "contradicted", "unconfirmed", "true return"];

impl Errors {
    /// Counts what a survey rests on.
    pub(crate) fn of(survey: &Survey, truth: &[Pose]) -> Self {
        let mut errors = Errors::default();
        let is_lost = |earlier: usize, later: usize| {
            let believed = survey.track.scans[earlier].pose.between(survey.track.scans[later].pose);
            let true_relative = truth[earlier].between(truth[later]);
            (true_relative.translation() - believed.translation()).norm() > OFF
        };
        for closures in survey.returns() {
            errors.returns.add(closures.iter().any(|closure| is_lost(closure.earlier, closure.later)));
        }
        for warning in &survey.warnings {
            match *warning {
                SurveyWarning::Contradicted { scan, earlier } => {
                    errors.contradicted.add(is_lost(earlier - 1, scan - 1));
                }
                SurveyWarning::Unconfirmed { scan, earlier } | SurveyWarning::Possible { scan, earlier } => {
                    errors.unconfirmed.add(is_lost(earlier - 1, scan - 1));
                }
                // Neither tells of a return.
                SurveyWarning::Lost { .. }
                | SurveyWarning::Break { .. }
                | SurveyWarning::Carried { .. }
                | SurveyWarning::NoOdometry
                | SurveyWarning::OdometryStands { .. }
                | SurveyWarning::ShortSighted { .. }
                | SurveyWarning::LaserTurned(_)
                | SurveyWarning::TurnedWithLaser(_)
                | SurveyWarning::Interrupted { .. } => {}
            }
        }
        for (earlier, later) in true_returns(&survey.track, truth) {
            errors.true_returns.add(is_lost(earlier, later));
        }
        errors
    }

    /// In the order of [`KINDS`].
    pub(crate) fn kinds(&self) -> [Count; 4] {
        [self.returns, self.contradicted, self.unconfirmed, self.true_returns]
    }
}

impl AddAssign for Errors {
    fn add_assign(&mut self, other: Self) {
        self.returns += other.returns;
        self.contradicted += other.contradicted;
        self.unconfirmed += other.unconfirmed;
        self.true_returns += other.true_returns;
    }
}

/// Where the robot truly is back: an earlier and a later scan for each stretch of the way.
fn true_returns(track: &Track, truth: &[Pose]) -> Vec<(usize, usize)> {
    let at = |scan: usize| track.scans[scan].travelled;
    let mut asked: Vec<usize> = Vec::new();
    for scan in 0..truth.len() {
        if asked.last().is_none_or(|&last| at(scan) - at(last) >= STEP) {
            asked.push(scan);
        }
    }
    let mut found: Vec<(usize, usize)> = Vec::new();
    for (index, &later) in asked.iter().enumerate() {
        for &earlier in &asked[..index] {
            let apart = (truth[later].translation() - truth[earlier].translation()).norm();
            let is_back = apart <= BACK && at(later) - at(earlier) > LEAST_TRAVEL;
            let is_told = |&(before, other): &(usize, usize)| {
                (at(other) - at(later)).abs() < LEAST_TRAVEL
                    && (at(before) - at(earlier)).abs() < LEAST_TRAVEL
            };
            if is_back && !found.iter().any(is_told) {
                found.push((earlier, later));
            }
        }
    }
    found
}

/// What is wrong with a map: pairs of visits.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Verdict {
    /// With one place in the map, and truly to two.
    pub(crate) merged: usize,
    /// How far apart those truly are at most, in metres.
    pub(crate) farthest: f64,
    /// With two places in the map, and truly to one.
    pub(crate) split: usize,
}

impl Verdict {
    /// Judges where visits truly were, each with its place in the map.
    pub(crate) fn of(visits: &[(Pose, u32)]) -> Self {
        let mut verdict = Verdict::default();
        for (index, (pose, place)) in visits.iter().enumerate() {
            for (other, other_place) in &visits[..index] {
                let apart = (pose.translation() - other.translation()).norm();
                if place == other_place && apart > TWO_PLACES {
                    verdict.merged += 1;
                    verdict.farthest = verdict.farthest.max(apart);
                }
                verdict.split += usize::from(place != other_place && apart < ONE_PLACE);
            }
        }
        verdict
    }

    /// Judges a map. A visit was where its center is, seen from the scan nearest to it, if that scan was where it truly
    /// was.
    pub(crate) fn of_map(map: &AnsweredMap, survey: &Survey, truth: &[Pose]) -> Self {
        let visits = map.visits.iter().zip(&survey.visits).map(|(told, visit)| {
            let robot = survey.track.scans[visit.reference].pose;
            (truth[visit.reference].compose(robot.between(visit.frame)), told.place)
        });
        Verdict::of(&visits.collect::<Vec<_>>())
    }

    /// Whether nothing is wrong.
    pub(crate) fn is_right(self) -> bool {
        self.merged + self.split == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(visits: &[(f64, u32)]) -> Verdict {
        let visits: Vec<(Pose, u32)> =
            visits.iter().map(|&(x, place)| (Pose::new(x, 0.0, 0.0), place)).collect();
        Verdict::of(&visits)
    }

    #[test]
    fn a_right_map_has_one_place_for_each_place() {
        assert!(verdict(&[(0.0, 0), (10.0, 1), (0.5, 0), (10.3, 1)]).is_right());
        assert!(verdict(&[(0.0, 0), (3.0, 0)]).is_right(), "may be one");
        assert!(verdict(&[(0.0, 0), (3.0, 1)]).is_right(), "or two");
        assert!(verdict(&[]).is_right());
    }

    #[test]
    fn merged_and_split_places_are_counted() {
        let merged = verdict(&[(0.0, 0), (10.0, 0), (12.0, 1)]);
        assert_eq!((merged.merged, merged.farthest, merged.split), (1, 10.0, 0));
        let split = verdict(&[(0.0, 0), (0.5, 1), (0.9, 2)]);
        assert_eq!((split.merged, split.split), (0, 3));
    }

    #[test]
    fn counts_add_up() {
        let mut sum = Errors::default();
        let mut one = Errors::default();
        one.returns.add(true);
        one.unconfirmed.add(false);
        sum += one;
        sum += one;
        assert_eq!(sum.kinds().map(|count| (count.all, count.wrong)), [(2, 2), (0, 0), (2, 0), (0, 0)]);
    }
}
