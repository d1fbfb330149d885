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
    drawn(log, poses, options, |_, _| true)
}

/// The grid map of a building for a robot to drive by: cells of 0.05 m. All scans that saw a cell count the same, so that
/// where people stood once and others looked through later, nothing is.
///
/// # Errors
/// If the poses are not finite, or so far apart that the grid would be too large.
pub fn building_map(log: &LaserLog, poses: &[Pose]) -> Result<OccupancyGrid, LatticeError> {
    /// A scan taken nearer to the one before, in metres and radians, shows nothing new.
    const NEW: (f64, f64) = (0.2, 0.2);
    /// A cell is seen through more often than hit if its sum is below 0, and one of each says that it is free.
    const HIT: f32 = 0.9;
    let options = LocalMapOptions {
        resolution: 0.05,
        hit: HIT,
        miss: 1.0,
        bounds: (-1e4, 1e4),
        thresholds: (-0.05, 0.05),
        ..LocalMapOptions::default()
    };
    let grid = drawn(log, poses, &options, |last, pose| {
        let moved = last.between(pose);
        moved.translation().norm() > NEW.0 || moved.theta.abs() > NEW.1
    })?;
    Ok(grid.known_part())
}

/// What the scans draw that are new after the last one drawn.
fn drawn(
    log: &LaserLog,
    poses: &[Pose],
    options: &LocalMapOptions,
    is_new: impl Fn(Pose, Pose) -> bool,
) -> Result<OccupancyGrid, LatticeError> {
    let first = poses.first().map_or(Vector2::zeros(), |pose| pose.translation());
    let (mut low, mut high) = (first, first);
    for pose in poses {
        low = low.inf(&pose.translation());
        high = high.sup(&pose.translation());
    }
    let side = (high - low).max() + 2.0 * options.reach;
    let mut map = LocalMap::new((low + high) / 2.0, LocalMapOptions { side, ..*options })?;
    let mut last: Option<Pose> = None;
    for (pose, logged) in poses.iter().zip(&log.scans) {
        if last.is_none_or(|last| is_new(last, *pose)) {
            map.insert(*pose, &logged.scan);
            if let Some(last) = last {
                map.clear_way(last, *pose);
            }
            last = Some(*pose);
        }
    }
    Ok(map.classify())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Occupancy;

    /// Somebody stands 2 m ahead in the first of some scans, and a wall is 4 m ahead in all of them.
    #[test]
    fn people_are_left_out_and_walls_are_not() {
        let scan = |number: usize| {
            let range = |beam: usize| {
                let is_person = number == 0 && (88..=92).contains(&beam);
                if is_person {
                    2.0
                } else {
                    4.0 / (f64::from(beam as u32) - 90.0).to_radians().cos().max(0.2)
                }
            };
            let ranges: Vec<String> = (0..=180).map(|beam| range(beam).to_string()).collect();
            let y = 0.25 * number as f64;
            format!("FLASER 181 {} 0 {y} 0 0 {y} 0 {number} host {number}\n", ranges.join(" "))
        };
        let text: String = (0..3).map(scan).collect();
        let log = LaserLog::read(text.as_bytes()).unwrap();
        let poses: Vec<Pose> = log.scans.iter().map(|scan| scan.odometry).collect();
        let at = |grid: &OccupancyGrid, x: f64, y: f64| grid.at([x, y]);
        let grid = building_map(&log, &poses).unwrap();
        assert_eq!(grid.lattice().resolution(), 0.05);
        assert_eq!(at(&grid, 2.0, 0.0), Occupancy::Free);
        assert_eq!(at(&grid, 4.02, 0.5), Occupancy::Occupied);
        assert_eq!(at(&grid, 4.6, 0.5), Occupancy::Unknown);
        let alone = building_map(&log.beginning(1), &poses[..1]).unwrap();
        assert_eq!(at(&alone, 2.0, 0.0), Occupancy::Occupied);
    }
}
