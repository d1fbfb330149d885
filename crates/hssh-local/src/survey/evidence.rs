//! What a survey rests on: how often the laser showed that the robot was back, how often the rest of the log contradicts
//! that, and where the robot seems to be back although the laser does not show it.

use super::error::SurveyWarning;
use crate::closing::Closure;
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
/// Metres of travel between the scans that are asked whether the robot is back.
const STEP: f64 = 1.0;

/// What speaks for the closures of a survey, and against them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Evidence {
    /// How often the robot came back to a stretch of its way, as the laser shows.
    pub returns: usize,
    /// How many stretches looked like an earlier one, and the rest of the log contradicts that.
    pub contradicted: usize,
    /// How many times the robot seems to be back and the laser does not show it.
    pub unconfirmed: usize,
}

/// How often a survey errs: what the probabilities of its maps are multiplied with.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PerceptionModel {
    /// A return that the laser shows is none.
    pub wrong_return: f64,
    /// Something else is wrong with the map where a closure is contradicted.
    pub contradicted: f64,
    /// The robot was back somewhere else, or not at all, where the laser does not show it.
    pub unconfirmed: f64,
}

impl Default for PerceptionModel {
    fn default() -> Self {
        PerceptionModel { wrong_return: 0.002, contradicted: 0.1, unconfirmed: 0.02 }
    }
}

impl Evidence {
    /// How probable it is that all of the survey's closures are right, and that none is missing.
    #[must_use]
    pub fn probability(&self, model: &PerceptionModel) -> f64 {
        let all = |error: f64, times: usize| (1.0 - error).powi(times.min(10_000) as i32);
        all(model.wrong_return, self.returns)
            * all(model.contradicted, self.contradicted)
            * all(model.unconfirmed, self.unconfirmed)
    }
}

/// The evidence for a closed track, and what there is to say about it.
pub(super) fn evidence(track: &Track, closures: &[Closure]) -> (Evidence, Vec<SurveyWarning>) {
    let at = |scan: usize| track.scans[scan].travelled;
    let (believed, contradicted): (Vec<Closure>, Vec<Closure>) =
        closures.iter().partition(|closure| closure.weight >= BELIEVED);
    let mut warnings = Vec::new();
    let stretches = |closures: &[Closure]| -> Vec<Closure> {
        let mut stretches: Vec<Closure> = Vec::new();
        let mut last: Vec<Closure> = Vec::new();
        for closure in closures {
            let is_same = |other: &Closure| {
                (at(other.later) - at(closure.later)).abs() < ONE_RETURN
                    && (at(other.earlier) - at(closure.earlier)).abs() < ONE_RETURN
            };
            match last.iter_mut().find(|other| is_same(other)) {
                Some(other) => *other = *closure,
                None => {
                    stretches.push(*closure);
                    last.push(*closure);
                }
            }
        }
        stretches
    };
    let mut evidence = Evidence { returns: stretches(&believed).len(), ..Evidence::default() };
    for closure in stretches(&contradicted) {
        evidence.contradicted += 1;
        warnings.push(SurveyWarning::Contradicted { scan: closure.later + 1, earlier: closure.earlier + 1 });
    }
    for (later, earlier) in unconfirmed(track, &believed) {
        evidence.unconfirmed += 1;
        warnings.push(SurveyWarning::Unconfirmed { scan: later + 1, earlier: earlier + 1 });
    }
    (evidence, warnings)
}

/// Where the robot seems to be back, and no closure says so: one pair of scans for each stretch.
fn unconfirmed(track: &Track, believed: &[Closure]) -> Vec<(usize, usize)> {
    let mut asked: Vec<usize> = Vec::new();
    for (scan, tracked) in track.scans.iter().enumerate() {
        if asked.last().is_none_or(|&last| tracked.travelled - track.scans[last].travelled >= STEP) {
            asked.push(scan);
        }
    }
    let at = |scan: usize| track.scans[scan].travelled;
    let mut found: Vec<(usize, usize)> = Vec::new();
    for (index, &later) in asked.iter().enumerate() {
        for &earlier in &asked[..index] {
            let apart =
                (track.scans[later].pose.translation() - track.scans[earlier].pose.translation()).norm();
            if at(later) - at(earlier) < LEAST_TRAVEL || apart > NEAR {
                continue;
            }
            let is_confirmed = believed.iter().any(|closure| {
                (at(closure.later) - at(later)).abs() < CONFIRMING
                    && (at(closure.earlier) - at(earlier)).abs() < CONFIRMING
            });
            let is_told = found.iter().any(|&(other, before)| {
                (at(other) - at(later)).abs() < ONE_RETURN && (at(before) - at(earlier)).abs() < ONE_RETURN
            });
            if !is_confirmed && !is_told {
                found.push((later, earlier));
            }
        }
    }
    found
}
