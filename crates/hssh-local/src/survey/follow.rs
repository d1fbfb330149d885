//! Follows the robot through a log: tracks it, keeps the local map, and looks for places in hindsight.

use super::error::{SurveyError, SurveyWarning};
use super::options::SurveyOptions;
use super::stay::Stay;
use super::visit::{Survey, visits};
use crate::carmen::LaserLog;
use crate::local_map::LocalMap;
use crate::matching::{Track, track};
use crate::place::sight;

/// What a survey is busy with, for those who wait.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SurveyStage {
    /// Matching scans.
    Tracking,
    /// Looking at neighborhoods.
    Looking,
}

/// Surveys a log: the places that the robot visited and the ways between them, from scans and raw
/// odometry alone. `progress` is told how many scans each stage has done.
///
/// # Errors
/// If the options describe no local map, there is no place, or a way cannot be measured.
pub fn survey(
    log: &LaserLog,
    options: &SurveyOptions,
    mut progress: impl FnMut(SurveyStage, usize),
) -> Result<Survey, SurveyError> {
    let track = track(log, &options.matching, |scans| progress(SurveyStage::Tracking, scans));
    let stays = stays(log, &track, options, |scans| progress(SurveyStage::Looking, scans))?;
    let (stays, fleeting): (Vec<Stay>, Vec<Stay>) =
        stays.into_iter().partition(|stay| stay.sightings >= options.least_sightings);
    let mut warnings: Vec<SurveyWarning> = fleeting
        .iter()
        .map(|stay| SurveyWarning::Fleeting { scan: stay.first + 1, times: stay.sightings })
        .collect();
    if stays.is_empty() {
        let metres = track.scans.last().map_or(0.0, |scan| scan.travelled);
        return Err(SurveyError::NoPlaces { metres, depth: options.place.depth() });
    }
    let visits = visits(joined(stays, options), &track, options, &mut warnings);
    Survey::new(visits, track, options, warnings)
}

/// Stays at places in order, sighted in the local map of some metres later.
fn stays(
    log: &LaserLog,
    track: &Track,
    options: &SurveyOptions,
    mut progress: impl FnMut(usize),
) -> Result<Vec<Stay>, SurveyError> {
    let mut map = LocalMap::new(nalgebra::Vector2::zeros(), options.local_map)?;
    let mut stays: Vec<Stay> = Vec::new();
    let mut viewpoints = viewpoints(track, options.look_distance).into_iter().peekable();
    for (scan, tracked) in track.scans.iter().enumerate() {
        map.scroll_to(tracked.pose.translation())?;
        map.insert(tracked.pose, &log.scans[scan].scan);
        if let Some(before) = scan.checked_sub(1) {
            map.clear_way(track.scans[before].pose, tracked.pose);
        }
        let is_over = scan + 1 == track.scans.len();
        let is_ripe = |&viewpoint: &usize| {
            viewpoint <= scan
                && (is_over || track.scans[viewpoint].travelled + options.hindsight <= tracked.travelled)
        };
        while let Some(viewpoint) = viewpoints.next_if(is_ripe) {
            if let Some(stay) = look(&map, viewpoint, track, options) {
                match stays.last_mut() {
                    Some(last) if last.is_at(stay.sighting.center, options.same_place) => last.add(stay),
                    _ => stays.push(stay),
                }
            }
        }
        progress(scan + 1);
    }
    Ok(stays)
}

/// The scans from whose positions neighborhoods are looked at.
fn viewpoints(track: &Track, look_distance: f64) -> Vec<usize> {
    let mut viewpoints: Vec<usize> = Vec::new();
    for (scan, tracked) in track.scans.iter().enumerate() {
        let since = viewpoints.last().map(|&last| tracked.travelled - track.scans[last].travelled);
        if since.is_none_or(|since| since >= look_distance) {
            viewpoints.push(scan);
        }
    }
    viewpoints
}

/// A sighting of a place from where a scan was taken, if there is one.
fn look(map: &LocalMap, viewpoint: usize, track: &Track, options: &SurveyOptions) -> Option<Stay> {
    let at = track.scans[viewpoint].pose.translation();
    let grid = map.window(at, options.window)?;
    let sighting = sight(&grid, at, &options.place).filter(|sighting| sighting.is_place)?;
    Some(Stay::new(viewpoint, at, sighting, grid))
}

/// Joins stays at one place that only a fleeting sighting of something else divided.
fn joined(stays: Vec<Stay>, options: &SurveyOptions) -> Vec<Stay> {
    let mut joined: Vec<Stay> = Vec::new();
    for stay in stays {
        match joined.last_mut() {
            Some(last) if last.is_at(stay.sighting.center, options.same_place) => last.add(stay),
            _ => joined.push(stay),
        }
    }
    joined
}
