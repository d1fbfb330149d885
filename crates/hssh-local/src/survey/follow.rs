//! From a log to visits: the robot is tracked, its loops are closed, and the network of its ways is read in the map
//! of the whole building.

use hssh_metrics::Pose;

use super::error::{SurveyError, SurveyWarning};
use super::evidence::evidence;
use super::lost::{carried, doubts, turned_laser};
use super::options::SurveyOptions;
use super::sight::short_sighted;
use super::visit::{Survey, Visit};
use crate::carmen::LaserLog;
use crate::closing::close_loops;
use crate::global_map::global_map;
use crate::local_map::LocalMapOptions;
use crate::matching::{Track, TrackedScan, track_calibrated};
use crate::progress::Reply;
use crate::route::route;

/// What a survey is busy with, for those who wait.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SurveyStage {
    /// Matching scans.
    Tracking,
    /// Looking for where the robot has been before.
    Closing,
    /// Looking at neighborhoods.
    Looking,
}

/// Surveys a log: the places that the robot visited and the ways between them, from scans and raw
/// odometry alone. `progress` is told how many scans each stage has done, and may stop it: then the survey is one of the
/// scans matched so far, with the loops found so far.
///
/// The log comes back as the survey takes it: up to the last scan that was matched, its odometry [turned](track_calibrated) with the laser.
///
/// # Errors
/// If the options describe no local map, there is no place, or a way cannot be measured.
pub fn survey<R: Into<Reply>>(
    log: LaserLog,
    options: &SurveyOptions,
    mut progress: impl FnMut(SurveyStage, usize) -> R,
) -> Result<(LaserLog, Survey), SurveyError> {
    let mut stopped = false;
    let (mut log, track) = track_calibrated(log, &options.matching, |scans| {
        let reply = progress(SurveyStage::Tracking, scans).into();
        stopped |= reply == Reply::Stop;
        reply
    });
    if track.scans.len() < log.scans.len() {
        log = log.beginning(track.scans.len());
    }
    let mut survey = survey_tracked(&log, track, options, &mut progress)?;
    let is_told = |warning: &SurveyWarning| matches!(warning, SurveyWarning::Interrupted { .. });
    if stopped && !survey.warnings.iter().any(is_told) {
        survey.warnings.push(SurveyWarning::Interrupted { scans: log.scans.len() });
    }
    Ok((log, survey))
}

/// Surveys a log of which every scan was tracked, as [`survey`] does.
///
/// # Errors
/// As [`survey`].
///
/// # Panics
/// If the track is that of another log.
pub fn survey_tracked<R: Into<Reply>>(
    log: &LaserLog,
    mut track: Track,
    options: &SurveyOptions,
    mut progress: impl FnMut(SurveyStage, usize) -> R,
) -> Result<Survey, SurveyError> {
    assert_eq!(track.scans.len(), log.scans.len(), "a pose for each scan");
    let mut stopped = false;
    let mut tell = |stage, scans| {
        let reply = progress(stage, scans).into();
        stopped |= reply == Reply::Stop;
        reply
    };
    let closed = close_loops(log, &track, &options.closing, |scans| tell(SurveyStage::Closing, scans))?;
    for (scan, pose) in track.scans.iter_mut().zip(closed.poses()) {
        *scan = TrackedScan { pose: *pose, ..*scan };
    }
    let local_map = building_options(closed.poses(), options);
    let building = global_map(log, closed.poses(), &local_map)?;
    let found = route(&building, closed.poses(), options.window, &options.route, &options.place);
    tell(SurveyStage::Looking, log.scans.len());
    if found.visits.is_empty() {
        let metres = track.scans.last().map_or(0.0, |scan| scan.travelled);
        return Err(SurveyError::NoPlaces { metres, depth: options.place.depth() });
    }
    let last = found.visits.len() - 1;
    let visits = found.visits.iter().enumerate().map(|(index, visit)| {
        let place = &found.places[visit.spot];
        let center = place.center;
        Visit {
            scans: visit.scans,
            reference: visit.reference,
            spot: visit.spot,
            frame: Pose::new(center.x, center.y, 0.0),
            star: place.star.clone(),
            entry: visit.entry.filter(|_| index > 0),
            exit: visit.exit.filter(|_| index < last),
            grid: building.window(center.into(), options.window).unwrap_or_else(|| building.clone()),
        }
    });
    let (mut evidence, mut warnings) = evidence(&track, &closed);
    carried(log, &mut evidence, &mut warnings);
    let mut lost = doubts(log, &track);
    lost.extend(short_sighted(log, options.place.depth()));
    evidence.lost += lost.len();
    warnings.extend(lost);
    warnings.extend(turned_laser(log, &track));
    if stopped {
        warnings.push(SurveyWarning::Interrupted { scans: log.scans.len() });
    }
    Survey::new(visits.collect(), track, closed, evidence, options, warnings)
}

/// How the map of the building is drawn: with cells so large that the routes' grid has not too many.
fn building_options(poses: &[Pose], options: &SurveyOptions) -> LocalMapOptions {
    let reach = options.local_map.reach;
    let span = |axis: fn(&Pose) -> f64| {
        let (low, high) =
            poses.iter().map(axis).fold((0.0_f64, 0.0_f64), |(low, high), at| (low.min(at), high.max(at)));
        high - low
    };
    let side = span(|pose| pose.x).max(span(|pose| pose.y)) + 2.0 * reach;
    let resolution = options.local_map.resolution.max(side / options.route.most_cells);
    LocalMapOptions { resolution, ..options.local_map }
}
