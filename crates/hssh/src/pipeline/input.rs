//! What maps are to explain: an exploration, or a laser log and what was found in it.

use std::io::Read;

use hssh_causal::{Exploration, ParseError};
use hssh_local::{
    LaserLog, LogError, LogWarning, PerceptionModel, Reply, Survey, SurveyError, SurveyStage, SurveyWarning,
    survey,
};

use super::error::PipelineError;
use super::options::MappingOptions;
use crate::answer::{AnswerWarning, AnsweredEvidence, AnsweredInput, InputKind, Spot, WarningKind};

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
        let survey = survey(&log, &options.places.along_logs(), progress)?;
        let scans = survey.track.scans.len();
        let log = if scans < log.scans.len() { log.beginning(scans) } else { log };
        Ok(SurveyedLog { log, survey })
    }

    /// How many laser scans the log has, those that cannot be used among them.
    #[must_use]
    pub fn scans(&self) -> u64 {
        self.log.scans.len() as u64 + self.unusable().count() as u64
    }

    /// The number of a scan among all laser scans of the log.
    #[must_use]
    pub fn scan_number(&self, used: usize) -> u64 {
        let line = self.log.scans[used].line;
        used as u64 + self.unusable().filter(|&unusable| unusable < line).count() as u64
    }

    /// What of the log is missing from what is made of it, in words, if it is more than a scan here and there: a tenth of all
    /// scans, or its end.
    #[must_use]
    pub fn partial(&self) -> Option<String> {
        let (all, lost) = (self.scans(), self.unusable().count() as u64);
        let broken = self.log.warnings.iter().find(|warning| matches!(warning, LogWarning::BreaksOff { .. }));
        let stopped = |warning: &&SurveyWarning| matches!(warning, SurveyWarning::Interrupted { .. });
        if let Some(stopped) = self.survey.warnings.iter().find(stopped) {
            return Some(stopped.to_string());
        }
        if 10 * lost >= all {
            return Some(format!("{lost} of {all} scans of the log could not be used"));
        }
        broken.map(LogWarning::to_string)
    }

    /// What its places rest on, in numbers.
    pub(super) fn evidence(&self) -> AnsweredEvidence {
        let evidence = self.survey.evidence;
        AnsweredEvidence {
            returns: evidence.returns as u64,
            contradicted: evidence.contradicted as u64,
            unconfirmed: (evidence.unconfirmed + evidence.adrift) as u64,
            lost: evidence.lost as u64,
            probability: evidence.probability(&PerceptionModel::default()),
        }
    }

    /// The first thing in the log that is missing from what is made of it, in words.
    #[must_use]
    pub fn first_loss(&self) -> Option<String> {
        self.log.warnings.iter().find(|warning| warning.is_loss()).map(LogWarning::to_string)
    }

    /// The lines with scans that cannot be used.
    fn unusable(&self) -> impl Iterator<Item = u64> + '_ {
        self.log.warnings.iter().filter_map(|warning| match warning {
            LogWarning::Message { line, kind, .. } if kind.contains("LASER") => Some(*line),
            _ => None,
        })
    }

    /// What was left out of the log, or decided with little reason.
    #[must_use]
    pub fn warnings(&self) -> Vec<AnswerWarning> {
        let mut warnings = Vec::new();
        for warning in &self.log.warnings {
            let (kind, line) = match warning {
                LogWarning::Message { line, .. } => (WarningKind::MessageLeftOut, Some(*line)),
                LogWarning::BreaksOff { line, .. } => (WarningKind::BreaksOff, Some(*line)),
                LogWarning::OddBeams { line, .. } => (WarningKind::BeamsWithoutRange, Some(*line)),
                LogWarning::Jump { line, .. } => (WarningKind::OdometryJump, Some(*line)),
                LogWarning::RangeLimit { .. } => (WarningKind::RangeLimit, None),
                LogWarning::LimitDoubted { .. } => (WarningKind::RangeLimit, None),
                LogWarning::View { .. } => (WarningKind::LaserView, None),
                LogWarning::LaserPose { .. } => (WarningKind::LaserPose, None),
                LogWarning::Remark { .. } => (WarningKind::Recording, None),
                LogWarning::ScansAlone => (WarningKind::NoOdometry, None),
            };
            match line {
                Some(scan) if matches!(warning, LogWarning::Jump { is_text: false, .. }) => {
                    let spot = Spot::Scan(scan.saturating_sub(1));
                    AnswerWarning::record(&mut warnings, kind, spot, || warning.to_string());
                }
                Some(line) => {
                    AnswerWarning::record(&mut warnings, kind, Spot::Line(line), || warning.to_string());
                }
                None => warnings.push(AnswerWarning::once(kind, warning.to_string())),
            }
        }
        let is_told = self.log.warnings.contains(&LogWarning::ScansAlone);
        for warning in &self.survey.warnings {
            if is_told && matches!(warning, SurveyWarning::NoOdometry) {
                continue;
            }
            let (kind, scan) = match *warning {
                SurveyWarning::Contradicted { scan, .. } => (WarningKind::ContradictedReturn, scan),
                SurveyWarning::Unconfirmed { scan, .. } => (WarningKind::UnconfirmedReturn, scan),
                SurveyWarning::Lost { first, .. } => (WarningKind::Lost, first),
                SurveyWarning::NoOdometry => (WarningKind::NoOdometry, 1),
                SurveyWarning::Interrupted { scans } => (WarningKind::SurveyInterrupted, scans),
            };
            let spot = Spot::Scan(self.scan_number(scan - 1));
            AnswerWarning::record(&mut warnings, kind, spot, || warning.to_string());
        }
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
