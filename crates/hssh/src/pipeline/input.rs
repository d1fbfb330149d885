//! What maps are to explain: an exploration, or a laser log and what was found in it.

use std::io::Read;

use hssh_causal::{Exploration, ParseError};
use hssh_local::{
    LaserLog, LogError, PerceptionModel, Reply, Survey, SurveyError, SurveyStage, SurveyWarning, Track,
    survey, survey_tracked,
};

use super::error::PipelineError;
use super::options::MappingOptions;
use super::scans;
use crate::answer::{AnswerWarning, AnsweredEvidence, AnsweredInput, InputKind, WarningKind};

/// What maps are to explain.
#[derive(Clone, Debug)]
pub struct Input {
    pub(crate) name: String,
    pub(crate) exploration: Exploration,
    pub(crate) surveyed: Option<SurveyedLog>,
}

/// A log with what was found in it.
#[derive(Clone, Debug)]
pub struct SurveyedLog {
    /// The log.
    pub log: LaserLog,
    /// The places that the robot visited.
    pub survey: Survey,
}

impl Input {
    /// An exploration, and what to call it.
    #[must_use]
    pub fn exploration(name: impl Into<String>, exploration: Exploration) -> Self {
        Input { name: name.into(), exploration, surveyed: None }
    }

    /// An exploration as a text (`docs/exploration-format.md`).
    ///
    /// # Errors
    /// If it is none, with line and column.
    pub fn from_ron(name: impl Into<String>, text: &str) -> Result<Self, ParseError> {
        Ok(Input::exploration(name, Exploration::from_ron(text)?))
    }

    /// A laser log, of which the places are found that the robot visited.
    ///
    /// # Errors
    /// If options make no sense, if the log cannot be read or has no scans, if no place is found, or if it is not known how the robot went from one to the
    /// next.
    pub fn from_log(
        name: impl Into<String>,
        log: impl Read,
        options: &MappingOptions,
    ) -> Result<Self, PipelineError> {
        options.check()?;
        let surveyed =
            SurveyedLog::new(LaserLog::read_with(log, &options.laser.mount())?, options, |_, _| {})?;
        Ok(Input::surveyed(name, surveyed)?)
    }

    /// A log that was surveyed already.
    ///
    /// # Errors
    /// If it is not known how the robot went from one visit to the next.
    pub fn surveyed(name: impl Into<String>, surveyed: SurveyedLog) -> Result<Self, SurveyError> {
        let exploration = surveyed.survey.exploration()?;
        Ok(Input { name: name.into(), exploration, surveyed: Some(surveyed) })
    }

    /// What the robot saw and did.
    #[must_use]
    pub fn as_exploration(&self) -> &Exploration {
        &self.exploration
    }

    /// The log, if it is one.
    #[must_use]
    pub fn as_surveyed(&self) -> Option<&SurveyedLog> {
        self.surveyed.as_ref()
    }

    /// The account of it, with so many travels to be explained, of which so many are.
    pub(super) fn account(&self, considered: usize, explained: u64) -> AnsweredInput {
        let surveyed = self.surveyed.as_ref();
        AnsweredInput {
            name: self.name.clone(),
            kind: if surveyed.is_some() { InputKind::LaserLog } else { InputKind::Exploration },
            travels: self.exploration.travels().len() as u64,
            considered: considered as u64,
            explained,
            scans: surveyed.map(SurveyedLog::scans),
            scans_used: surveyed.map(|surveyed| surveyed.log.scans.len() as u64),
            evidence: surveyed.map(SurveyedLog::evidence),
        }
    }
}

impl SurveyedLog {
    /// Finds the places along a log; `progress` is told how many scans each stage has done, and may stop it: the log is then
    /// cut off behind the scans that were matched.
    ///
    /// # Errors
    /// If the options describe no local map, there is no place, or a way cannot be measured.
    pub fn new<R: Into<Reply>>(
        log: LaserLog,
        options: &MappingOptions,
        progress: impl FnMut(SurveyStage, usize) -> R,
    ) -> Result<Self, SurveyError> {
        let (log, survey) = survey(log, &options.places.along_logs(), progress)?;
        Ok(SurveyedLog { log, survey })
    }

    /// The same along a log of which every scan was tracked.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    ///
    /// # Panics
    /// If the track is that of another log.
    pub fn from_track<R: Into<Reply>>(
        log: LaserLog,
        track: Track,
        options: &MappingOptions,
        progress: impl FnMut(SurveyStage, usize) -> R,
    ) -> Result<Self, SurveyError> {
        let survey = survey_tracked(&log, track, &options.places.along_logs(), progress)?;
        Ok(SurveyedLog { log, survey })
    }

    /// How many laser scans the log has, those that cannot be used among them.
    #[must_use]
    pub fn scans(&self) -> u64 {
        scans::all(&self.log)
    }

    /// The number of a scan among all laser scans of the log.
    #[must_use]
    pub fn scan_number(&self, used: usize) -> u64 {
        scans::number(&self.log, used)
    }

    /// What of the log is missing from what is made of it, in words, if it is more than a scan here and there: a tenth of all
    /// scans, or its end.
    #[must_use]
    pub fn partial(&self) -> Option<String> {
        let stopped = |warning: &&SurveyWarning| matches!(warning, SurveyWarning::Interrupted { .. });
        let stopped = self.survey.warnings.iter().find(stopped).map(SurveyWarning::to_string);
        stopped.or_else(|| scans::partial(&self.log))
    }

    /// What its places rest on, in numbers.
    pub(super) fn evidence(&self) -> AnsweredEvidence {
        let evidence = self.survey.evidence;
        AnsweredEvidence {
            returns: evidence.returns as u64,
            contradicted: evidence.contradicted as u64,
            unconfirmed: (evidence.unconfirmed + evidence.adrift + evidence.breaks) as u64,
            lost: evidence.lost as u64,
            probability: evidence.probability(&PerceptionModel::default()),
        }
    }

    /// The first thing in the log that is missing from what is made of it, in words.
    #[must_use]
    pub fn first_loss(&self) -> Option<String> {
        scans::first_loss(&self.log)
    }

    /// What was left out of the log, or decided with little reason.
    #[must_use]
    pub fn warnings(&self) -> Vec<AnswerWarning> {
        let mut warnings = scans::warnings(&self.log);
        // A laser that looks back sees no way out, and then no travel contradicts it.
        if self.log.is_facing_unclear && self.survey.travels.is_empty() {
            let sentence = "one place was met along the whole way, and nothing along it tells whether the laser looks ahead, as \
                            was taken for granted, or back (--laser-pose says so)";
            warnings.push(AnswerWarning::once(WarningKind::LaserView, sentence.to_owned()));
        }
        scans::warn_of(&self.survey.warnings, &self.log, &mut warnings);
        warnings
    }
}

impl From<LogError> for PipelineError {
    fn from(error: LogError) -> Self {
        PipelineError::Log(Box::new(error))
    }
}

impl From<SurveyError> for PipelineError {
    fn from(error: SurveyError) -> Self {
        PipelineError::Survey(Box::new(error))
    }
}
