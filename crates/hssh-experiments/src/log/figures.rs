//! What comes out of one log, in figures, and what of it is worse than it should be.

use std::error::Error;
use std::fs::File;
use std::path::Path;

use hssh::answer::{Answer, AnsweredMap};
use hssh::pipeline::{Input, MappingOptions, SurveyedLog, map};
use hssh_local::LaserLog;
use hssh_metrics::Pose;

use crate::bench::usage::Usage;
use crate::score::{Revisits, SamePlace, root_mean_square, stated};

/// What a log must come to at least.
const LEAST_PRECISION: f64 = 0.98;
const LEAST_RECALL: f64 = 0.90;
const LEAST_REVISIT_PRECISION: f64 = 0.99;

/// A log, its survey and what is answered of it, or why there is no map.
pub(super) struct Mapping {
    log: LaserLog,
    input: Option<Input>,
    answer: Option<Answer>,
    problem: Option<String>,
    /// Seconds of processor time of the survey and of the search.
    seconds: [f64; 2],
    peak_bytes: u64,
}

impl Mapping {
    /// Surveys a log on one thread and looks for the best map.
    pub(super) fn of(file: &Path) -> Result<Self, Box<dyn Error>> {
        let log = LaserLog::read(File::open(file)?)?;
        let mut options = MappingOptions::default();
        options.search.threads = 1;
        let started = Usage::now()?.user_seconds;
        let surveyed = SurveyedLog::new(log.clone(), &options, |_, _| ());
        let surveyed_at = Usage::now()?.user_seconds;
        let input = surveyed.and_then(|surveyed| Input::surveyed("log", surveyed));
        let answer = match &input {
            Ok(input) => map(input, &options, &Default::default()).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        let usage = Usage::now()?;
        let (ended, peak_bytes) = (usage.user_seconds, usage.peak_bytes);
        let (answer, problem) = match answer {
            Ok(mapped) => (Some(mapped.answer), None),
            Err(problem) => (None, Some(problem)),
        };
        let mapless = answer.as_ref().filter(|answer| answer.maps.is_empty());
        let problem = problem.or(mapless.map(|answer| answer.verdict.sentence.clone()));
        let seconds = [surveyed_at - started, ended - surveyed_at];
        Ok(Mapping { log, input: input.ok(), answer, problem, seconds, peak_bytes })
    }

    pub(super) fn log(&self) -> &LaserLog {
        &self.log
    }

    pub(super) fn answer(&self) -> Option<&Answer> {
        self.answer.as_ref()
    }

    fn best(&self) -> Option<&AnsweredMap> {
        self.answer.as_ref()?.maps.first()
    }

    /// Seconds of processor time of the survey and the search.
    pub(super) fn seconds(&self) -> f64 {
        self.seconds.iter().sum()
    }

    /// The most memory that this process had at one time so far, in MB.
    pub(super) fn megabytes(&self) -> f64 {
        self.peak_bytes as f64 / 1e6
    }

    fn surveyed(&self) -> Option<&SurveyedLog> {
        self.input.as_ref()?.as_surveyed()
    }

    /// Where raw odometry has the scans.
    pub(super) fn raw(&self) -> Vec<Pose> {
        self.log.scans.iter().map(|scan| scan.odometry).collect()
    }

    /// Where the closed track has the scans.
    pub(super) fn closed(&self) -> Option<Vec<Pose>> {
        Some(self.surveyed()?.survey.track.scans.iter().map(|scan| scan.pose).collect())
    }

    /// The place of each visit in the best map, with the true pose of the scan nearest to it.
    fn visited(&self, truth: &[Pose]) -> Vec<(Pose, u32)> {
        let Some((best, surveyed)) = self.best().zip(self.surveyed()) else { return Vec::new() };
        let visits = best.visits.iter().zip(&surveyed.survey.visits);
        visits.map(|(told, visit)| (truth[visit.reference], told.place)).collect()
    }
}

/// The figures of a log.
pub(super) struct Figures {
    pub(super) name: &'static str,
    pub(super) scans: usize,
    pub(super) metres: f64,
    /// Of raw odometry, the track and the closed track: root mean square of the distance from the truth, in metres.
    pub(super) off: [Option<f64>; 3],
    pub(super) close: Option<f64>,
    /// Of the closed track, and of the corrected poses.
    pub(super) blur: [Option<f64>; 2],
    pub(super) revisit_recall: Option<f64>,
    pub(super) revisit_precision: Option<f64>,
    pub(super) visits: usize,
    /// Places and links of the best map.
    pub(super) size: Option<(usize, usize)>,
    pub(super) same_place: SamePlace,
    pub(super) probability: Option<f64>,
    pub(super) seconds: [f64; 2],
    problem: Option<String>,
}

impl Figures {
    pub(super) fn of(name: &'static str, mapping: &Mapping, track: &[Pose]) -> Self {
        let truth: Vec<Pose> = mapping.log.scans.iter().map(|scan| scan.corrected).collect();
        let revisits = Revisits::new(&truth);
        let (raw, closed) = (mapping.raw(), mapping.closed());
        let closed = closed.as_deref();
        let off = |poses: &[Pose]| root_mean_square(poses, &truth);
        Figures {
            name,
            scans: truth.len(),
            metres: revisits.length(),
            off: [Some(off(&raw)), Some(off(track)), closed.map(off)],
            close: closed.and_then(|poses| revisits.close_error(poses)).map(|error| error[0]),
            blur: [closed, Some(&truth[..])].map(|poses| revisits.blur(&mapping.log, poses?)),
            revisit_recall: closed.and_then(|poses| revisits.recall(poses)),
            revisit_precision: closed.and_then(|poses| revisits.precision(poses)),
            visits: mapping.surveyed().map_or(0, |surveyed| surveyed.survey.visits.len()),
            size: mapping.best().map(|map| (map.places.len(), map.links.len())),
            same_place: SamePlace::new(&mapping.visited(&truth)),
            probability: mapping.best().and_then(stated),
            seconds: mapping.seconds,
            problem: mapping.problem.clone(),
        }
    }

    /// What is worse than it should be, in sentences.
    pub(super) fn faults(&self) -> Vec<String> {
        let name = self.name;
        if self.size.is_none() {
            return vec![format!("{name}: no map: {}", self.problem.as_deref().unwrap_or("none was found"))];
        }
        let least = [
            ("same-place precision", self.same_place.precision(), LEAST_PRECISION),
            ("same-place recall", self.same_place.recall(), LEAST_RECALL),
            ("revisit precision", self.revisit_precision, LEAST_REVISIT_PRECISION),
        ];
        let low = least.into_iter().filter_map(|(what, found, least)| {
            let found = found.filter(|&found| found < least)?;
            Some(format!("{name}: {what} is {found:.3}, less than {least}"))
        });
        let [raw, track, closed] = self.off;
        let farther = [("raw odometry", raw), ("the track", track)].into_iter().filter_map(|(what, off)| {
            let (off, closed) = off.zip(closed).filter(|(off, closed)| closed > off)?;
            Some(format!("{name}: closed loops are {closed:.3} m off, {what} is {off:.3} m off"))
        });
        low.chain(farther).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fair() -> Figures {
        let at = |x: f64| Pose::new(x, 0.0, 0.0);
        Figures {
            name: "hall",
            scans: 3,
            metres: 20.0,
            off: [Some(2.0), Some(1.0), Some(0.1)],
            close: Some(0.1),
            blur: [Some(0.1); 2],
            revisit_recall: Some(0.5),
            revisit_precision: Some(1.0),
            visits: 2,
            size: Some((1, 0)),
            same_place: SamePlace::new(&[(at(0.0), 0), (at(0.1), 0)]),
            probability: Some(0.9),
            seconds: [0.0, 0.0],
            problem: None,
        }
    }

    #[test]
    fn what_is_as_it_should_be_has_no_faults() {
        assert_eq!(fair().faults(), Vec::<String>::new());
        let without_returns = Figures { revisit_precision: None, same_place: SamePlace::default(), ..fair() };
        assert_eq!(without_returns.faults(), Vec::<String>::new());
    }

    #[test]
    fn each_fault_is_told() {
        let at = |x: f64| Pose::new(x, 0.0, 0.0);
        let faults = |figures: Figures| figures.faults().join("; ");
        let none = Figures { size: None, problem: Some("too dark".to_owned()), ..fair() };
        assert_eq!(faults(none), "hall: no map: too dark");
        let far = Figures { off: [Some(0.05), Some(1.0), Some(0.1)], ..fair() };
        assert_eq!(faults(far), "hall: closed loops are 0.100 m off, raw odometry is 0.050 m off");
        let merged = Figures { same_place: SamePlace::new(&[(at(0.0), 0), (at(9.0), 0)]), ..fair() };
        assert_eq!(faults(merged), "hall: same-place precision is 0.000, less than 0.98");
        let split = Figures { same_place: SamePlace::new(&[(at(0.0), 0), (at(0.0), 1)]), ..fair() };
        assert_eq!(faults(split), "hall: same-place recall is 0.000, less than 0.9");
        let lost = Figures { revisit_precision: Some(0.98), ..fair() };
        assert_eq!(faults(lost), "hall: revisit precision is 0.980, less than 0.99");
    }
}
