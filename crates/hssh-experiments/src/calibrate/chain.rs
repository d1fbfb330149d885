//! From a log to what is right and wrong of its survey and its best map.

use hssh::pipeline::{Input, MappingOptions, SurveyedLog, map};
use hssh_local::LaserLog;
use hssh_metrics::Pose;

use super::judge::{Errors, Verdict};
use crate::score::stated;

/// Seconds that a search may take.
const SECONDS: f64 = 10.0;

/// What became of a log.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    pub(super) errors: Errors,
    pub(super) visits: usize,
    pub(super) map: Option<JudgedMap>,
    /// Why there is no survey or no map.
    pub(super) problem: Option<String>,
}

/// The best map.
#[derive(Clone, Copy, Debug)]
pub(super) struct JudgedMap {
    pub(super) places: usize,
    /// How probable it is said to be.
    pub(super) stated: f64,
    pub(super) verdict: Verdict,
}

impl Outcome {
    /// Surveys and maps a log; its corrected poses are the truth.
    pub(super) fn of(log: LaserLog) -> Self {
        let truth: Vec<Pose> = log.scans.iter().map(|scan| scan.corrected).collect();
        let mut options = MappingOptions::default();
        options.search.threads = 1;
        options.limits.seconds = Some(SECONDS);
        let input = SurveyedLog::new(log, &options, |_, _| ());
        let input = match input.and_then(|surveyed| Input::surveyed("log", surveyed)) {
            Ok(input) => input,
            Err(error) => return Outcome { problem: Some(error.to_string()), ..Outcome::default() },
        };
        let Some(surveyed) = input.as_surveyed() else { return Outcome::default() };
        let survey = &surveyed.survey;
        let surveyed =
            Outcome { errors: Errors::of(survey, &truth), visits: survey.visits.len(), ..Outcome::default() };
        let answer = match map(&input, &options, &Default::default()) {
            Ok(mapped) => mapped.answer,
            Err(error) => return Outcome { problem: Some(error.to_string()), ..surveyed },
        };
        let best = answer.maps.first().and_then(|best| Some((best, stated(best)?)));
        let map = best.map(|(best, stated)| JudgedMap {
            places: best.places.len(),
            stated,
            verdict: Verdict::of_map(best, survey, &truth),
        });
        let problem = Some(answer.verdict.sentence).filter(|_| map.is_none());
        Outcome { map, problem, ..surveyed }
    }
}
