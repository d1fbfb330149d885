//! A log tracked twice, where its first track shows how its odometry is: turned against the laser, or better than believed.

use super::good_odometry::good_odometry;
use super::options::MatchOptions;
use super::track::{Track, track};
use super::turned::unreckoned_turn;
use crate::carmen::LaserLog;
use crate::progress::Reply;

/// Tracks a log as [`track`](super::track()) does. Where that shows that the laser is clearly turned against the odometry, and nobody said how the
/// laser sits, the odometry is turned with it: a degree of it leads a long track astray by metres. Where it shows that the odometry is far
/// better than `options` have it, that is believed: then featureless corridors and people that pass lead nobody astray. In both cases the
/// log is tracked once more.
pub fn track_calibrated<R: Into<Reply>>(
    log: LaserLog,
    options: &MatchOptions,
    mut progress: impl FnMut(usize) -> R,
) -> (LaserLog, Track) {
    let first = track(&log, options, &mut progress);
    let Some((turned, options)) = calibrated(&log, &first, options) else { return (log, first) };
    let second = track(&turned, &options, progress);
    // Stopped on the second way, the first is worth more.
    if second.scans.len() < first.scans.len() { (log, first) } else { (turned, second) }
}

/// A log and options as its track calls for, if that is otherwise than they are.
pub(super) fn calibrated(
    log: &LaserLog,
    track: &Track,
    options: &MatchOptions,
) -> Option<(LaserLog, MatchOptions)> {
    if track.scans.len() < log.scans.len() {
        return None;
    }
    let turn = unreckoned_turn(log, track);
    let good = good_odometry(log, track, options);
    (turn.is_some() || good.is_some()).then(|| {
        let log = log.clone();
        (if let Some(turn) = turn { log.turned(turn) } else { log }, good.unwrap_or(*options))
    })
}
