//! What a survey rests on: how often the laser showed that the robot was back, how often the rest of the log contradicts
//! that, and where the robot seems to be back although the laser does not show it.

use hssh_metrics::UncertainPose;

use super::error::SurveyWarning;
use crate::closing::{ClosedTrack, Closure, Known, Ways};
use crate::matching::Track;

/// Closures of scans that are nearer than this to one another on both passes are one return: metres of travel.
const ONE_RETURN: f64 = 15.0;
/// Where two poses are this near, one would expect the scans to match: metres.
const NEAR: f64 = 1.5;
/// A return is confirmed by closures no farther away than this on either pass: metres of travel.
pub(super) const CONFIRMING: f64 = 8.0;
/// The robot is not back where it was less than so many metres of travel ago.
const LEAST_TRAVEL: f64 = 15.0;
/// A closure that counts less than this in the end is contradicted.
pub(super) const BELIEVED: f64 = 0.5;
/// So many returns may go unconfirmed however few are confirmed.
const FEW_UNCONFIRMED: usize = 2;
/// A return to where the robot was hardly expected or known is confirmed if it is one of so many.
const CONFIRMED: usize = 4;
/// Where the robot is known up to this standard deviation, in metres, it is where it seems to be.
const WELL_KNOWN: f64 = 2.5;
/// A stretch lies between two returns if neither is farther from it than so many metres of travel.
const BETWEEN: f64 = 60.0;
/// What part of a way two passes of it differ by: a robot does not go where it went to the centimetre.
const WAY_ERROR: f64 = 0.03;
/// Metres of travel between the scans that are asked whether the robot is back.
const STEP: f64 = 1.0;

/// What speaks for the closures of a survey, and against them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Evidence {
    /// How often the robot came back to a stretch of its way, as the laser shows.
    pub returns: usize,
    /// How many of these the robot came back to after so long a way that it might have been elsewhere.
    pub far_returns: usize,
    /// How many stretches looked like an earlier one, and the rest of the log contradicts that.
    pub contradicted: usize,
    /// How many times the robot seems to be back and the laser does not show it.
    pub unconfirmed: usize,
    /// How many times it seems to be back after so long a way that it might as well be elsewhere, and the laser does
    /// not show it; or may be back, as far as is known; or is back, as the laser shows, where it was hardly expected, or known.
    pub adrift: usize,
    /// How often a scan lies on nothing that was seen before, and the robot never came back to what was: it may have been carried.
    pub breaks: usize,
    /// On how many stretches the robot was lost: scans lie on nothing that was seen before, wherever they are put. A log
    /// without odometry counts as one, and so does one of a laser that sees too little.
    pub lost: usize,
}

/// How often a survey errs: what the probabilities of its maps are multiplied with.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PerceptionModel {
    /// A return that the laser shows is none.
    pub wrong_return: f64,
    /// The same after a long way.
    pub wrong_far_return: f64,
    /// Something else is wrong with the map where a closure is contradicted.
    pub contradicted: f64,
    /// The robot was back somewhere else, or not at all, where the laser does not show it.
    pub unconfirmed: f64,
    /// The same after so long a way that the robot might as well be elsewhere, in a log of which nothing else is known; or the robot was carried.
    pub adrift: f64,
    /// Something is wrong with the map where the robot was lost.
    pub lost: f64,
}

impl Default for PerceptionModel {
    fn default() -> Self {
        PerceptionModel {
            wrong_return: 0.002,
            wrong_far_return: 0.03,
            contradicted: 0.1,
            unconfirmed: 0.02,
            adrift: 0.3,
            lost: 0.7,
        }
    }
}

impl Evidence {
    /// How probable it is that all of the survey's closures are right, and that none is missing.
    #[must_use]
    pub fn probability(&self, model: &PerceptionModel) -> f64 {
        let all = |error: f64, times: usize| (1.0 - error).powi(times.min(10_000) as i32);
        // Where the robot seems to be back more often than the laser shows that it is, the poses are wrong, rather than that nothing was seen.
        let usual = self.unconfirmed.min(self.returns.max(FEW_UNCONFIRMED));
        all(model.wrong_return, self.returns.saturating_sub(self.far_returns))
            * all(model.wrong_far_return, self.far_returns)
            * all(model.contradicted, self.contradicted)
            * all(model.unconfirmed, usual)
            * none_adrift(
                model.adrift.max(model.unconfirmed),
                self.returns.saturating_sub(self.far_returns),
                self.adrift + self.unconfirmed - usual,
            )
            * all(model.adrift, self.breaks)
            * all(model.lost, self.lost)
    }
}

/// How probable it is that the robot was where it seems to be each of so many times, after it was so many other times, as the laser shows. How
/// often it is not differs from log to log, and is not known of this one before: whose poses are wrong once, they mostly are wrong again. So this
/// is the rule of succession, for a prior by which one time alone is wrong with the error's probability, Beta(1, 1/error − 1).
fn none_adrift(error: f64, confirmed: usize, times: usize) -> f64 {
    if times == 0 || error <= 0.0 {
        return 1.0;
    }
    let right = 1.0 / error - 1.0 + confirmed as f64;
    right / (right + times as f64)
}

/// The evidence for a closed track, and what there is to say about it.
pub(super) fn evidence(track: &Track, closed: &ClosedTrack) -> (Evidence, Vec<SurveyWarning>) {
    let (believed, contradicted): (Vec<Closure>, Vec<Closure>) =
        closed.closures.iter().partition(|closure| closure.weight >= BELIEVED);
    let mut warnings = Vec::new();
    let returns = stretches(track, &believed);
    let is_far = |closure: &Closure| closure.spread > WELL_KNOWN;
    let far_returns = returns.iter().filter(|stretch| stretch.iter().any(is_far)).count();
    let mut evidence = Evidence { returns: returns.len(), far_returns, ..Evidence::default() };
    for closure in doubtful(&returns) {
        evidence.adrift += 1;
        warnings.push(SurveyWarning::Possible { scan: closure.later + 1, earlier: closure.earlier + 1 });
    }
    for closure in
        stretches(track, contradicted.iter().filter(|closure| !is_back_there(track, &believed, closure)))
            .iter()
            .filter_map(|stretch| stretch.first())
    {
        evidence.contradicted += 1;
        warnings.push(SurveyWarning::Contradicted { scan: closure.later + 1, earlier: closure.earlier + 1 });
    }
    for (later, earlier, known) in unconfirmed(track, &believed, &closed.alike.expected) {
        let is_known = known.across <= WELL_KNOWN;
        *if is_known { &mut evidence.unconfirmed } else { &mut evidence.adrift } += 1;
        warnings.push(SurveyWarning::Unconfirmed { scan: later + 1, earlier: earlier + 1 });
    }
    for scan in breaks(track, &believed) {
        evidence.breaks += 1;
        warnings.push(SurveyWarning::Break { scan: scan + 1 });
    }
    let possible = closed.alike.possible.iter().copied();
    let possible: Vec<(usize, usize)> =
        possible.filter(|pair| !is_between_returns(track, &believed, *pair)).collect();
    for (earlier, later) in possible_stretches(track, &possible) {
        evidence.adrift += 1;
        warnings.push(SurveyWarning::Possible { scan: later + 1, earlier: earlier + 1 });
    }
    (evidence, warnings)
}

/// The scans that lie on nothing that was seen before, the first of each row of them, after which the robot never came back to where it was
/// before: it may have been carried, or its odometry begun anew, and nobody would see it.
fn breaks(track: &Track, believed: &[Closure]) -> Vec<usize> {
    // The lost ones are in order.
    let is_first =
        |scan: &usize| scan.checked_sub(1).is_none_or(|before| track.lost.binary_search(&before).is_err());
    let is_bridged =
        |scan: usize| believed.iter().any(|closure| closure.earlier < scan && scan <= closure.later);
    track.lost.iter().copied().filter(is_first).filter(|&scan| !is_bridged(scan)).collect()
}

/// Whether other closures show that the robot was back on that stretch: then it is in doubt how exactly, not whether.
fn is_back_there(track: &Track, believed: &[Closure], closure: &Closure) -> bool {
    let is_near = |one: usize, other: usize| {
        (track.scans[one].travelled - track.scans[other].travelled).abs() < CONFIRMING
    };
    believed
        .iter()
        .any(|other| is_near(other.earlier, closure.earlier) && is_near(other.later, closure.later))
}

/// The returns to where the robot was hardly expected, or after so long a way that it might have been elsewhere: they may as well be to
/// a corridor that looks the same; unless there are more returns, of which some would not fit to a wrong one.
fn doubtful(returns: &[Vec<Closure>]) -> Vec<Closure> {
    let is_doubtful =
        |closure: &&Closure| closure.off > closure.spread.max(NEAR) || closure.spread > WELL_KNOWN;
    let mut doubtful: Vec<Closure> =
        returns.iter().filter_map(|stretch| stretch.iter().find(is_doubtful)).copied().collect();
    if doubtful.len() * CONFIRMED <= returns.len() {
        doubtful.clear();
    }
    doubtful
}

/// Whether there are returns before and after a pair of scans that looks alike, and the robot went as far from the one to the other as it
/// had the first time, in either direction: then it went the same way, and the pair is where it has to be.
fn is_between_returns(track: &Track, believed: &[Closure], (earlier, later): (usize, usize)) -> bool {
    let at = |scan: usize| track.scans[scan].travelled;
    let firm = || believed.iter().filter(|closure| !slides(closure));
    let goes = |direction: f64, onward: bool| {
        firm().any(|closure| {
            let (now, then) = (at(closure.later) - at(later), at(closure.earlier) - at(earlier));
            (now > 0.0) == onward
                && now.abs() < BETWEEN
                && (now - direction * then).abs() < NEAR + WAY_ERROR * now.abs()
        })
    };
    [1.0, -1.0].into_iter().any(|direction| goes(direction, false) && goes(direction, true))
}

/// Whether a closure can be slid along its corridor.
fn slides(closure: &Closure) -> bool {
    Known::of(STEP, &closure.covariance).across > WELL_KNOWN
}

/// One pair of scans for each later stretch of the way that looks like an earlier one where it may be. One pair alone is chance.
fn possible_stretches(track: &Track, possible: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let at = |scan: usize| track.scans[scan].travelled;
    let mut stretches: Vec<Vec<(usize, usize)>> = Vec::new();
    for &(earlier, later) in possible {
        match stretches.iter_mut().find(|stretch| at(later) - at(stretch[0].1) < ONE_RETURN) {
            Some(stretch) => stretch.push((earlier, later)),
            None => stretches.push(vec![(earlier, later)]),
        }
    }
    stretches.retain(|stretch| stretch.last().is_some_and(|last| last.1 != stretch[0].1));
    stretches.into_iter().map(|stretch| stretch[0]).collect()
}

/// Closures that follow one another along a stretch of the way, together.
pub(super) fn stretches<'a>(
    track: &Track,
    closures: impl IntoIterator<Item = &'a Closure>,
) -> Vec<Vec<Closure>> {
    let at = |scan: usize| track.scans[scan].travelled;
    let mut stretches: Vec<Vec<Closure>> = Vec::new();
    for closure in closures {
        let is_same = |other: &Closure| {
            (at(other.later) - at(closure.later)).abs() < ONE_RETURN
                && (at(other.earlier) - at(closure.earlier)).abs() < ONE_RETURN
        };
        match stretches.iter_mut().find(|stretch| stretch.last().is_some_and(is_same)) {
            Some(stretch) => stretch.push(*closure),
            None => stretches.push(vec![*closure]),
        }
    }
    stretches
}

/// Where the robot seems to be back, and neither a closure says so nor does it look alike as expected: one pair of scans for each
/// stretch, the later one first, and how well they are known to one another.
fn unconfirmed(
    track: &Track,
    believed: &[Closure],
    expected: &[(usize, usize)],
) -> Vec<(usize, usize, Known)> {
    let mut asked: Vec<usize> = Vec::new();
    for (scan, tracked) in track.scans.iter().enumerate() {
        if asked.last().is_none_or(|&last| tracked.travelled - track.scans[last].travelled >= STEP) {
            asked.push(scan);
        }
    }
    let ways = ways(track, &asked, believed);
    let at = |scan: usize| track.scans[scan].travelled;
    let mut found: Vec<(usize, usize, Known)> = Vec::new();
    for (index, &later) in asked.iter().enumerate() {
        let mut known: Option<Vec<Known>> = None;
        for (point, &earlier) in asked[..index].iter().enumerate() {
            let apart =
                (track.scans[later].pose.translation() - track.scans[earlier].pose.translation()).norm();
            if at(later) - at(earlier) < LEAST_TRAVEL || apart > NEAR {
                continue;
            }
            let mut shown =
                expected.iter().copied().chain(believed.iter().map(|one| (one.earlier, one.later)));
            let is_confirmed = shown.any(|(before, after)| {
                (at(after) - at(later)).abs() < CONFIRMING && (at(before) - at(earlier)).abs() < CONFIRMING
            });
            let is_told = found.iter().any(|&(other, before, _)| {
                (at(other) - at(later)).abs() < ONE_RETURN && (at(before) - at(earlier)).abs() < ONE_RETURN
            });
            if is_confirmed || is_told {
                continue;
            }
            let pose = |point: usize| track.scans[asked[point]].pose;
            let known = known.get_or_insert_with(|| ways.from(index, pose));
            found.push((later, earlier, known[point]));
        }
    }
    found
}

/// The ways between some scans, by the track and by closures.
fn ways(track: &Track, asked: &[usize], believed: &[Closure]) -> Ways {
    let mut ways = Ways::new(asked.len());
    for (index, pair) in asked.windows(2).enumerate() {
        let length = track.scans[pair[1]].travelled - track.scans[pair[0]].travelled;
        if let Ok(Some(motion)) = track.motion(pair[0], pair[1]) {
            // What is too uncertain leads nowhere.
            ways.add([index, index + 1], length, motion).ok();
        }
    }
    let nearest = |scan: usize| asked.partition_point(|&other| other <= scan).saturating_sub(1);
    for closure in believed {
        let link = UncertainPose { mean: closure.relative, covariance: closure.covariance };
        // What can be slid along a corridor is no short cut.
        if slides(closure) {
            continue;
        }
        ways.add([nearest(closure.earlier), nearest(closure.later)], STEP, link).ok();
    }
    ways
}

#[cfg(test)]
mod tests {
    use hssh_metrics::{Covariance, Pose, PoseGraph};
    use proptest::prelude::*;

    use super::*;
    use crate::closing::Alike;
    use crate::matching::TrackedScan;

    /// Scans every half metre along a line through corners.
    fn track(corners: &[[f64; 2]]) -> Track {
        let mut scans: Vec<TrackedScan> = Vec::new();
        for pair in corners.windows(2) {
            let steps = 2.0 * (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            let at = |part: f64, axis: usize| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]);
            for step in 1..=steps as usize {
                let part = step as f64 / steps;
                let pose = Pose::new(at(part, 0), at(part, 1), 0.0);
                let travelled = 0.5 * (scans.len() as f64 + 1.0);
                let mean = scans.last().map_or(Pose::IDENTITY, |last| last.pose.between(pose));
                let covariance = Covariance::from_standard_deviations(0.01, 0.01, 0.001).unwrap();
                scans.push(TrackedScan { pose, step: Some(UncertainPose { mean, covariance }), travelled });
            }
        }
        Track { scans, lost: Vec::new() }
    }

    /// One scan for each half metre, so that `at` metres of travel are reached with the scan before `2 at`.
    fn closure((earlier, later): (f64, f64), weight: f64) -> Closure {
        let scan = |at: f64| (2.0 * at) as usize - 1;
        let (earlier, later) = (scan(earlier), scan(later));
        let covariance = Covariance::from_standard_deviations(0.1, 0.1, 0.01).unwrap();
        Closure {
            earlier,
            later,
            relative: Pose::IDENTITY,
            covariance,
            agreement: 1.0,
            spread: 0.5,
            off: 0.0,
            weight,
        }
    }

    /// Scan 50 lies on nothing. With a return from later on to what was before, it does not matter how the robot came there.
    #[test]
    fn where_a_scan_lies_on_nothing_the_way_is_broken_until_the_robot_comes_back() {
        let broken = Track { lost: vec![50, 51, 90], ..around() };
        let told = |closures: Vec<Closure>| {
            let (found, warnings) = evidence(&broken, &closed(closures));
            let is_break = |warning: &&SurveyWarning| matches!(warning, SurveyWarning::Break { .. });
            (found.breaks, warnings.iter().filter(is_break).cloned().collect::<Vec<_>>())
        };
        let breaks = [51, 91].map(|scan| SurveyWarning::Break { scan });
        assert_eq!(told(Vec::new()), (2, breaks.to_vec()));
        assert_eq!(told(vec![closure((30.0, 150.0), 1.0)]), (1, breaks[..1].to_vec()));
        assert_eq!(told(again(2, 60)), (0, vec![]));
    }

    /// Where the robot seems to be back and hardly ever is as the laser shows, it is elsewhere: two times may be chance.
    #[test]
    fn what_is_unconfirmed_more_often_than_not_costs_as_much_as_what_is_adrift() {
        let model = PerceptionModel::default();
        let of = |returns: usize, unconfirmed: usize, adrift: usize| {
            Evidence { returns, unconfirmed, adrift, ..Evidence::default() }.probability(&model)
        };
        assert!((of(0, 5, 0) - of(0, 2, 3)).abs() < 1e-12);
        assert!((of(4, 5, 0) - of(4, 4, 1)).abs() < 1e-12);
        assert!(
            (of(5, 5, 0) - (1.0 - model.wrong_return).powi(5) * (1.0 - model.unconfirmed).powi(5)).abs()
                < 1e-12
        );
    }

    /// By the chances of the prior, integrated: ∫ Beta(q; 1, 1/0.3 − 1) (1 − q)^(confirmed + times) dq over that with `confirmed` alone.
    #[test]
    fn who_was_right_often_is_right_again() {
        let beyond = 1.0 / 0.3 - 1.0;
        let mean = |power: usize| {
            let steps = 200_000;
            let at = |step: usize| (step as f64 + 0.5) / steps as f64;
            let density = |q: f64| beyond * (1.0 - q).powf(beyond - 1.0);
            (0..steps).map(|step| density(at(step)) * (1.0 - at(step)).powi(power as i32)).sum::<f64>()
                / steps as f64
        };
        for (confirmed, times) in [(0, 1), (0, 10), (5, 7), (35, 13)] {
            let expected = mean(confirmed + times) / mean(confirmed);
            assert!(
                (none_adrift(0.3, confirmed, times) - expected).abs() < 1e-6,
                "{confirmed} {times} {expected}"
            );
        }
        assert!((none_adrift(0.3, 0, 1) - 0.7).abs() < 1e-12);
    }

    /// Around a square of 30 m, and half of it again.
    fn around() -> Track {
        let corners =
            [[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [0.0, 30.0], [0.0, 0.0], [30.0, 0.0], [30.0, 30.0]];
        track(&corners)
    }

    /// The second time is 120 m after the first.
    fn again(from: u32, to: u32) -> Vec<Closure> {
        (from..to).step_by(5).map(f64::from).map(|at| closure((at, at + 120.0), 1.0)).collect()
    }

    fn closed(closures: Vec<Closure>) -> ClosedTrack {
        ClosedTrack { graph: PoseGraph::default(), closures, alike: Alike::default() }
    }

    fn counts(evidence: Evidence) -> (usize, usize, usize) {
        (evidence.returns, evidence.contradicted, evidence.unconfirmed)
    }

    #[test]
    fn closures_along_a_stretch_are_one_return() {
        let (found, warnings) = evidence(&around(), &closed(again(2, 60)));
        assert_eq!((counts(found), warnings), ((1, 0, 0), vec![]));
        // A return at the beginning, and another one a long way on; between them nothing was seen.
        let apart: Vec<Closure> = again(2, 12).into_iter().chain(again(45, 60)).collect();
        let (found, warnings) = evidence(&around(), &closed(apart));
        assert_eq!(found.returns, 2);
        assert_eq!(found.unconfirmed, warnings.len());
        assert!(found.unconfirmed >= 1, "{warnings:?}");
    }

    #[test]
    fn where_nothing_says_that_the_robot_is_back_it_is_said() {
        let (found, warnings) = evidence(&around(), &closed(Vec::new()));
        // 60 m twice, told every 15 m.
        assert_eq!(counts(found), (0, 0, warnings.len()));
        assert!((4..=6).contains(&warnings.len()), "{warnings:?}");
        for warning in warnings {
            let SurveyWarning::Unconfirmed { scan, earlier } = warning else { panic!("{warning:?}") };
            let between = scan as f64 / 2.0 - earlier as f64 / 2.0;
            assert!((between - 120.0).abs() <= 1.5, "{scan} {earlier}");
        }
    }

    /// What looks alike as expected is no doubt, and what looks alike elsewhere is one for each 15 m of way, if it does so twice.
    #[test]
    fn what_looks_alike_confirms_or_makes_doubtful() {
        let pairs = |from: f64, to: f64| -> Vec<(usize, usize)> {
            again(2, 60)
                .iter()
                .map(|one| (one.earlier, one.later))
                .filter(|one| {
                    let at = one.0 as f64 / 2.0;
                    from <= at && at <= to
                })
                .collect()
        };
        let (found, warnings) = evidence(
            &around(),
            &ClosedTrack {
                alike: Alike { expected: pairs(0.0, 60.0), ..Alike::default() },
                ..closed(Vec::new())
            },
        );
        assert_eq!((counts(found), found.adrift, warnings), ((0, 0, 0), 0, vec![]));
        // 4 m back from where the returns say that the robot is.
        let elsewhere = |from: f64, to: f64| -> Vec<(usize, usize)> {
            pairs(from, to).into_iter().map(|(earlier, later)| (earlier, later - 8)).collect()
        };
        let alike = |from: f64, to: f64| ClosedTrack {
            alike: Alike { possible: elsewhere(from, to), ..Alike::default() },
            ..closed(again(2, 60))
        };
        let doubts = |from: f64, to: f64| evidence(&around(), &alike(from, to)).0.adrift;
        assert_eq!((doubts(0.0, 60.0), doubts(10.0, 18.0), doubts(10.0, 14.0)), (4, 1, 0));
    }

    /// From one return to the next it went as far as the first time: what looks alike between them is no doubt. After the last one it may be.
    #[test]
    fn what_looks_alike_between_two_returns_is_where_it_has_to_be() {
        let possible =
            |at: [f64; 2]| at.map(|at| ((2.0 * at) as usize - 1, (2.0 * (at + 120.0)) as usize - 1)).to_vec();
        let doubts = |returns: Vec<Closure>, at: [f64; 2]| {
            let alike = Alike { possible: possible(at), ..Alike::default() };
            evidence(&around(), &ClosedTrack { alike, ..closed(returns) }).0.adrift
        };
        let ends: Vec<Closure> = again(2, 12).into_iter().chain(again(48, 60)).collect();
        assert_eq!([doubts(ends.clone(), [25.0, 30.0]), doubts(again(2, 12), [25.0, 30.0])], [0, 1]);
        // Bare corridors do not tell how far along the robot is.
        let covariance = Covariance::from_standard_deviations(5.0, 0.1, 0.01).unwrap();
        let sliding = ends.into_iter().map(|closure| Closure { covariance, ..closure }).collect();
        assert_eq!(doubts(sliding, [25.0, 30.0]), 1);
    }

    /// The robot was believed to be 3 m off, and known up to 2 m: of two returns that is one too surprising, of four it is none.
    #[test]
    fn a_surprising_return_is_doubtful_until_more_returns_confirm_it() {
        let surprising = |at: f64| Closure { spread: 2.0, off: 3.0, ..closure((at, at + 120.0), 1.0) };
        let doubts = |others: u32| {
            let returns =
                (1..=others).map(|k| 10.0 + 16.0 * f64::from(k)).map(|at| closure((at, at + 120.0), 1.0));
            let (found, _) =
                evidence(&around(), &closed(std::iter::once(surprising(5.0)).chain(returns).collect()));
            (found.returns, found.adrift)
        };
        // Where the robot seems to be back later on and no closure says so is told as unconfirmed, not here.
        assert_eq!([doubts(1), doubts(3)], [(2, 1), (4, 0)]);
    }

    /// So is a return after so long a way that the robot might have been elsewhere, however near it is to where it was expected.
    #[test]
    fn a_return_after_a_long_way_is_doubtful_until_more_returns_confirm_it() {
        let far = |at: f64| Closure { spread: 9.0, ..closure((at, at + 120.0), 1.0) };
        let near = |k: u32| closure((10.0 + 16.0 * f64::from(k), 130.0 + 16.0 * f64::from(k)), 1.0);
        let found = |returns: Vec<Closure>| {
            let (found, _) = evidence(&around(), &closed(returns));
            (found.far_returns, found.adrift)
        };
        assert_eq!(found(vec![far(5.0)]), (1, 1));
        assert_eq!(found(vec![far(5.0), near(1), near(2), near(3)]), (1, 0));
    }

    /// A closure that can be slid along its corridor says that the robot is back, but not how well it is known where: the track does.
    #[test]
    fn what_can_be_slid_makes_nothing_uncertain() {
        let covariance = Covariance::from_standard_deviations(5.0, 0.1, 0.01).unwrap();
        let sliding = Closure { covariance, ..closure((5.0, 125.0), 1.0) };
        let (found, _) = evidence(&around(), &closed(vec![sliding]));
        assert!(found.unconfirmed >= 1 && found.adrift == 0, "{found:?}");
    }

    #[test]
    fn what_the_rest_contradicts_is_no_return() {
        let mut closures = again(2, 60);
        closures.extend([closure((10.0, 95.0), 0.01), closure((12.0, 97.0), 0.2)]);
        closures.push(closure((15.0, 55.0), 0.1));
        let (found, warnings) = evidence(&around(), &closed(closures));
        assert_eq!(counts(found), (1, 2, 0));
        let expected =
            [(190, 20), (110, 30)].map(|(scan, earlier)| SurveyWarning::Contradicted { scan, earlier });
        assert_eq!(warnings, expected);
        // What is off by half a metre where other closures say that the robot was back contradicts no return.
        let mut inexact = again(2, 60);
        inexact.push(closure((12.0, 132.5), 0.01));
        assert_eq!(counts(evidence(&around(), &closed(inexact)).0), (1, 0, 0));
        // What is contradicted confirms nothing either.
        let doubtful: Vec<Closure> =
            again(2, 60).into_iter().map(|closure| Closure { weight: 0.1, ..closure }).collect();
        let (found, _) = evidence(&around(), &closed(doubtful));
        assert!(found.returns == 0 && found.contradicted == 1 && found.unconfirmed >= 4, "{found:?}");
    }

    #[test]
    fn who_never_comes_back_has_no_evidence() {
        assert_eq!(
            evidence(&track(&[[0.0, 0.0], [80.0, 0.0], [80.0, 50.0]]), &closed(Vec::new())),
            (Evidence::default(), vec![])
        );
        assert_eq!(Evidence::default().probability(&PerceptionModel::default()), 1.0);
    }

    proptest! {
        #[test]
        fn probabilities_are_in_range_and_fall_with_what_can_be_wrong(
            returns in 0_usize..3000, contradicted in 0_usize..40, unconfirmed in 0_usize..40,
            errors in prop::array::uniform3(0.0_f64..=1.0),
        ) {
            let certain = PerceptionModel {
                wrong_return: 0.0, wrong_far_return: 0.0, contradicted: 0.0, unconfirmed: 0.0, adrift: 0.0, lost: 0.0,
            };
            let model =
                PerceptionModel { wrong_return: errors[0], contradicted: errors[1], unconfirmed: errors[2], ..certain };
            let evidence = Evidence { returns, contradicted, unconfirmed, ..Evidence::default() };
            let probability = evidence.probability(&model);
            prop_assert!((0.0..=1.0).contains(&probability));
            // A return more speaks for what is unconfirmed.
            let confirmed = Evidence { unconfirmed: unconfirmed.min(returns), ..evidence };
            let again = Evidence { returns: returns + 1, ..confirmed };
            prop_assert!(again.probability(&model) <= confirmed.probability(&model));
            for more in [
                Evidence { contradicted: contradicted + 1, ..evidence },
                Evidence { unconfirmed: unconfirmed + 1, ..evidence },
            ] {
                prop_assert!(more.probability(&model) <= probability);
            }
            let right = (1.0 - 0.25_f64).powi(2) * (1.0 - 0.5) * (1.0 - 0.125);
            let model = PerceptionModel { wrong_return: 0.25, contradicted: 0.5, unconfirmed: 0.125, lost: 0.5, ..certain };
            let two_one_one = Evidence { returns: 2, contradicted: 1, unconfirmed: 1, ..Evidence::default() };
            prop_assert!((two_one_one.probability(&model) - right).abs() < 1e-12);
        }
    }
}
