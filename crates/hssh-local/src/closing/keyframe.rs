//! Keyframes: the scans that are poses of the graph.

use hssh_metrics::Pose;

use super::options::ClosingOptions;
use crate::carmen::LaserLog;
use crate::matching::{SurfacePoint, Track, surfaces};

/// Metres: what a beam hits nearer than this is kept. Far walls hold the heading, so that this is more than a submap shows.
const REACH: f64 = 30.0;
/// Metres between the surface points that are kept of a keyframe.
const SPACING: f64 = 0.12;

/// A scan that is a pose of the graph.
pub(super) struct Keyframe {
    /// Which scan it is.
    pub(super) scan: usize,
    /// Metres travelled since the first scan.
    pub(super) travelled: f64,
    /// The robot in the frame of the track.
    pub(super) tracked: Pose,
    /// What it saw, in its own frame.
    pub(super) surfaces: Vec<SurfacePoint>,
}

/// The keyframes of a log in order, the first and the last scan among them.
pub(super) fn keyframes(log: &LaserLog, track: &Track, options: &ClosingOptions) -> Vec<Keyframe> {
    let mut keyframes: Vec<Keyframe> = Vec::new();
    for (scan, tracked) in track.scans.iter().enumerate() {
        let is_due = keyframes.last().is_none_or(|last| {
            tracked.travelled - last.travelled >= options.keyframe_distance
                || last.tracked.between(tracked.pose).theta.abs() >= options.keyframe_turn
        });
        if is_due || scan + 1 == track.scans.len() {
            keyframes.push(Keyframe {
                scan,
                travelled: tracked.travelled,
                tracked: tracked.pose,
                surfaces: surfaces(&log.scans[scan].scan, REACH, SPACING),
            });
        }
    }
    keyframes
}
