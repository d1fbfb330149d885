//! The ways of a log's map as the robot drove them.

use hssh_local::{Survey, driven_line, global_poses, visit_frames};
use hssh_metrics::{Pose, PoseGraph};
use hssh_topology::Position;

/// Where every scan was taken, in the frame of the first place of a map that has the visits at `positions`. `None` if the map has them
/// elsewhere than the survey and its places are not placed.
pub(super) fn scan_poses(
    survey: &Survey,
    positions: &[Position],
    places: Option<&PoseGraph>,
) -> Option<Vec<Pose>> {
    if survey.agrees_with(positions) {
        let first = survey.visits[0].frame;
        return Some(survey.track.scans.iter().map(|scan| first.between(scan.pose)).collect());
    }
    let mut frames = visit_frames(&survey.visits, positions, places?.poses());
    // Beyond the travels explained, the track goes on.
    for travel in &survey.travels[frames.len() - 1..] {
        frames.push(frames[frames.len() - 1].compose(travel.mean));
    }
    Some(global_poses(survey, &frames))
}

/// The travels of a log in the frame of a map's first place.
pub(super) struct Drives<'a> {
    survey: &'a Survey,
    positions: &'a [Position],
    places: &'a [Pose],
    scans: Vec<Pose>,
}

impl<'a> Drives<'a> {
    pub(super) fn new(survey: &'a Survey, positions: &'a [Position], places: &'a PoseGraph) -> Option<Self> {
        let scans = scan_poses(survey, positions, Some(places))?;
        Some(Drives { survey, positions, places: places.poses(), scans })
    }

    /// The line of the travel from a visit to the next one, from place to place.
    pub(super) fn line(&self, visit: usize) -> Vec<[f64; 2]> {
        let place = |visit: usize| self.places[self.positions[visit].place.index()];
        let [first, last] = [visit, visit + 1].map(|visit| self.survey.visits[visit].reference);
        let ends = [place(visit), place(visit + 1)];
        let driven = &self.scans[first..=last.max(first)];
        let poses = std::iter::once(&ends[0]).chain(driven).chain([&ends[1]]);
        let points: Vec<[f64; 2]> =
            poses.filter(|pose| pose.is_finite()).map(|pose| [pose.x, pose.y]).collect();
        driven_line(&points)
    }
}

/// How long a line is, in metres.
pub(super) fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|pair| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1])).sum()
}
