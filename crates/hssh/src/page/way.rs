//! The robot's way along a log, with as many scans as a page needs to show it.

use hssh_local::Survey;
use hssh_metrics::Pose;

use super::image::rounded;

/// Scans nearer to the last one than that show nothing new of the way: m.
const STEP: f64 = 0.2;

/// Which scans are enough to draw the way.
pub(super) struct Thinned {
    scans: Vec<usize>,
    /// By visit: the position in `scans` of the one taken nearest to the place.
    visits: Vec<u32>,
}

impl Thinned {
    /// The scans of visits, and others where the robot had moved on.
    pub(super) fn of(survey: &Survey) -> Self {
        let mut scans: Vec<usize> = Vec::new();
        let mut last: Option<Pose> = None;
        let track = &survey.track.scans;
        for (scan, taken) in track.iter().enumerate() {
            let is_visit = survey.visits.iter().any(|visit| visit.reference == scan);
            let has_moved = last.is_none_or(|last| last.between(taken.pose).translation().norm() > STEP);
            if is_visit || has_moved || scan + 1 == track.len() {
                scans.push(scan);
                last = Some(taken.pose);
            }
        }
        let at = |scan: usize| scans.binary_search(&scan).unwrap_or_else(|next| next) as u32;
        let visits = survey.visits.iter().map(|visit| at(visit.reference)).collect();
        Thinned { scans, visits }
    }

    /// Where a visit is on the way.
    pub(super) fn at(&self, visit: usize) -> Option<u32> {
        self.visits.get(visit).copied()
    }

    /// The way, given where all scans were taken.
    pub(super) fn way(&self, poses: &[Pose]) -> Vec<[f64; 2]> {
        let poses = self.scans.iter().filter_map(|&scan| poses.get(scan));
        poses.map(|pose| [rounded(pose.x), rounded(pose.y)]).collect()
    }
}
