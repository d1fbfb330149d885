//! The scans of a log by their number among all that it has, those that cannot be used among them.

use hssh_local::{LaserLog, LogPosition, LogWarning, SurveyWarning};
use hssh_metrics::Pose;

use crate::answer::{AnswerWarning, Spot, WarningKind};

/// Where the scans stand that cannot be used.
fn unusable(log: &LaserLog) -> impl Iterator<Item = LogPosition> + '_ {
    log.warnings.iter().filter_map(|warning| match warning {
        LogWarning::Message { at, kind, .. } if kind.contains("LASER") => Some(*at),
        _ => None,
    })
}

/// How many laser scans a log has.
pub(super) fn all(log: &LaserLog) -> u64 {
    log.scans.len() as u64 + unusable(log).count() as u64
}

/// The number of a used scan among all of a log.
pub(super) fn number(log: &LaserLog, used: usize) -> u64 {
    let at = log.scans[used].at;
    used as u64 + unusable(log).filter(|&unusable| unusable < at).count() as u64
}

/// When every scan was taken and where: those that cannot be used have the pose of the scan before, and their number for a
/// time. `poses` has one for each that is used.
pub(super) fn timed(log: &LaserLog, poses: &[Pose]) -> Vec<(f64, Pose)> {
    let mut timed: Vec<(f64, Pose)> = Vec::new();
    for (used, pose) in poses.iter().enumerate() {
        let number = number(log, used) as usize;
        let before = timed.last().map_or(*pose, |last| last.1);
        while timed.len() < number {
            timed.push((timed.len() as f64, before));
        }
        timed.push((log.scans[used].time.unwrap_or(number as f64), *pose));
    }
    let last = timed.last().map_or(Pose::IDENTITY, |last| last.1);
    while (timed.len() as u64) < all(log) {
        timed.push((timed.len() as f64, last));
    }
    timed
}

/// What of a log is missing from what is made of it, in words, if it is more than a scan here and there: a tenth of all
/// scans, or its end.
pub(super) fn partial(log: &LaserLog) -> Option<String> {
    let (all, lost) = (all(log), unusable(log).count() as u64);
    if 10 * lost >= all {
        return Some(format!("{lost} of {all} scans of the log could not be used"));
    }
    let broken = log.warnings.iter().find(|warning| matches!(warning, LogWarning::BreaksOff { .. }));
    broken.map(LogWarning::to_string)
}

/// The first thing in a log that is missing from what is made of it, in words.
pub(super) fn first_loss(log: &LaserLog) -> Option<String> {
    log.warnings.iter().find(|warning| warning.is_loss()).map(LogWarning::to_string)
}

/// What was passed over in a log.
pub(super) fn warnings(log: &LaserLog) -> Vec<AnswerWarning> {
    let mut warnings = Vec::new();
    for warning in &log.warnings {
        let kind = match warning {
            LogWarning::Message { .. } => WarningKind::MessageLeftOut,
            LogWarning::BreaksOff { .. } => WarningKind::BreaksOff,
            LogWarning::OddBeams { .. } => WarningKind::BeamsWithoutRange,
            LogWarning::Jump { .. } => WarningKind::OdometryJump,
            LogWarning::RangeLimit { .. } => WarningKind::RangeLimit,
            LogWarning::LimitDoubted { .. } => WarningKind::RangeLimitDoubted,
            LogWarning::OdometryScale { .. }
            | LogWarning::TooFast { .. }
            | LogWarning::TurnsApart { .. }
            | LogWarning::OtherHanded
            | LogWarning::Noisy { .. }
            | LogWarning::ScansRepeat { .. } => WarningKind::Questionable,
            LogWarning::StrayOdometry { .. } | LogWarning::OddParameter { .. } => WarningKind::MessageLeftOut,
            LogWarning::View { .. }
            | LogWarning::Facing { is_reckoned: false, .. }
            | LogWarning::Mirrored { .. } => WarningKind::LaserView,
            LogWarning::LaserPose { .. } | LogWarning::Facing { is_reckoned: true, .. } => {
                WarningKind::LaserPose
            }
            LogWarning::Remark { .. } => WarningKind::Recording,
            LogWarning::ScansAlone => WarningKind::NoOdometry,
        };
        let spot = warning.position().map(|at| match at {
            LogPosition::Line(line) => Spot::Line(line),
            LogPosition::Scan(scan) => Spot::Scan(scan.saturating_sub(1)),
        });
        match spot {
            Some(spot) => AnswerWarning::record(&mut warnings, kind, spot, || warning.to_string()),
            None => warnings.push(AnswerWarning::once(kind, warning.to_string())),
        }
    }
    warnings
}

/// Adds what was decided with little reason along a log.
pub(super) fn warn_of(found: &[SurveyWarning], log: &LaserLog, warnings: &mut Vec<AnswerWarning>) {
    let is_told = log.warnings.contains(&LogWarning::ScansAlone);
    for warning in found {
        if is_told && matches!(warning, SurveyWarning::NoOdometry) {
            continue;
        }
        let (kind, scan) = match *warning {
            SurveyWarning::Contradicted { scan, .. } => (WarningKind::ContradictedReturn, scan),
            SurveyWarning::Unconfirmed { scan, .. }
            | SurveyWarning::Possible { scan, .. }
            | SurveyWarning::Break { scan } => (WarningKind::UnconfirmedReturn, scan),
            SurveyWarning::Carried { scan } => (WarningKind::Lost, scan),
            SurveyWarning::Lost { first, .. } => (WarningKind::Lost, first),
            SurveyWarning::ShortSighted { .. } => (WarningKind::Questionable, 1),
            SurveyWarning::LaserTurned(_) | SurveyWarning::TurnedWithLaser(_) => (WarningKind::LaserPose, 1),
            SurveyWarning::NoOdometry => (WarningKind::NoOdometry, 1),
            SurveyWarning::OdometryStands { first, .. } => (WarningKind::NoOdometry, first),
            SurveyWarning::Interrupted { scans } => (WarningKind::SurveyInterrupted, scans),
        };
        AnswerWarning::record(warnings, kind, Spot::Scan(number(log, scan - 1)), || warning.to_string());
    }
}
