//! All scans of a log in one frame, and the map that they draw.

use hssh_metrics::Pose;
use nalgebra::Vector2;

use crate::carmen::LaserLog;
use crate::grid::{LatticeError, OccupancyGrid};
use crate::local_map::{LocalMap, LocalMapOptions};
use crate::survey::Survey;

/// The pose of every scan in the frame that the visits' `frames` are given in. Around a visit it is where
/// the track has it relative to the visit; what the track is off from one visit to the next is spread
/// evenly along the way.
#[must_use]
pub fn global_poses(survey: &Survey, frames: &[Pose]) -> Vec<Pose> {
    let track = &survey.track.scans;
    let seen_from = |visit: usize, scan: usize| {
        frames[visit].compose(survey.visits[visit].frame.between(track[scan].pose))
    };
    let mut next = 0; // the first visit whose reference is not before the scan
    let mut poses = Vec::with_capacity(track.len());
    for scan in 0..track.len() {
        while next < survey.visits.len() && survey.visits[next].reference < scan {
            next += 1;
        }
        let pose = match (next.checked_sub(1), survey.visits.get(next)) {
            (Some(before), Some(after)) => {
                let (from, to) = (seen_from(before, scan), seen_from(next, scan));
                let start = track[survey.visits[before].reference].travelled;
                let length = track[after.reference].travelled - start;
                let part = if length > 0.0 { (track[scan].travelled - start) / length } else { 0.0 };
                from.compose(Pose::exp(from.between(to).log() * part))
            }
            (None, Some(_)) => seen_from(next, scan),
            (before, None) => before.map_or(track[scan].pose, |before| seen_from(before, scan)),
        };
        poses.push(pose);
    }
    poses
}

/// The occupancy grid that the scans of a log draw from these poses. The side of the local maps does not
/// matter here: the grid is as large as it must be.
///
/// # Errors
/// If the poses are not finite, or so far apart that the grid would be too large.
pub fn global_map(
    log: &LaserLog,
    poses: &[Pose],
    options: &LocalMapOptions,
) -> Result<OccupancyGrid, LatticeError> {
    let first = poses.first().map_or(Vector2::zeros(), |pose| pose.translation());
    let (mut low, mut high) = (first, first);
    for pose in poses {
        low = low.inf(&pose.translation());
        high = high.sup(&pose.translation());
    }
    let side = (high - low).max() + 2.0 * options.reach;
    let mut map = LocalMap::new((low + high) / 2.0, LocalMapOptions { side, ..*options })?;
    for (index, (pose, logged)) in poses.iter().zip(&log.scans).enumerate() {
        map.insert(*pose, &logged.scan);
        if let Some(before) = index.checked_sub(1) {
            map.clear_way(poses[before], *pose);
        }
    }
    Ok(map.classify())
}
