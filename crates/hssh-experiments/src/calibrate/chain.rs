//! From a log to what is right and wrong of its survey and its best map.

use std::time::Instant;

use hssh::pipeline::{Input, MappingOptions, SurveyedLog, map};
use hssh_local::LaserLog;
use hssh_metrics::Pose;

use super::judge::{Errors, Verdict};
use crate::score::{root_mean_square, stated};

/// Seconds that a search may take.
const SECONDS: f64 = 10.0;

/// What became of a log.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    pub(crate) errors: Errors,
    pub(crate) visits: usize,
    /// Metres of way.
    pub(crate) metres: f64,
    /// Of raw odometry and of the closed track: root mean square of the distance from the truth, in metres.
    pub(crate) off: [f64; 2],
    /// Seconds from the scans to the map.
    pub(crate) seconds: f64,
    pub(crate) map: Option<JudgedMap>,
    /// Why there is no survey or no map.
    pub(crate) problem: Option<String>,
}

/// The best map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JudgedMap {
    pub(crate) places: usize,
    /// How probable it is said to be.
    pub(crate) stated: f64,
    pub(crate) verdict: Verdict,
}

impl Outcome {
    /// Surveys and maps a log; its corrected poses are the truth.
    pub(crate) fn of(log: LaserLog) -> Self {
        let truth: Vec<Pose> = log.scans.iter().map(|scan| scan.corrected).collect();
        let raw: Vec<Pose> = log.scans.iter().map(|scan| scan.odometry).collect();
        let started = Instant::now();
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
        let closed: Vec<Pose> = survey.track.scans.iter().map(|scan| scan.pose).collect();
        let surveyed = Outcome {
            errors: Errors::of(survey, &truth),
            visits: survey.visits.len(),
            metres: survey.track.scans.last().map_or(0.0, |scan| scan.travelled),
            off: [&raw, &closed].map(|poses| root_mean_square(poses, &truth)),
            ..Outcome::default()
        };
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
        Outcome { map, problem, seconds: started.elapsed().as_secs_f64(), ..surveyed }
    }
}
