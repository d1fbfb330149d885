//! The robot's way through a log that is still being written.

use super::calibrated::calibrated;
use super::options::MatchOptions;
use super::track::{Track, Tracker};
use crate::carmen::LaserLog;

/// A log and the robot's way through it, as far as both have come.
pub struct GrowingTrack {
    options: MatchOptions,
    tracker: Tracker,
    log: Option<LaserLog>,
    track: Track,
    is_outdated: bool,
}

impl GrowingTrack {
    /// Nothing yet.
    #[must_use]
    pub fn new(options: MatchOptions) -> Self {
        GrowingTrack {
            options,
            tracker: Tracker::new(options),
            log: None,
            track: Track::default(),
            is_outdated: false,
        }
    }

    /// Tracks what is new in a log. Where what came before is told otherwise now, as when only now the range limit shows, scans
    /// before keep the poses that they have, and the track [is outdated](Self::is_outdated): it takes as long as ever to track all anew.
    pub fn follow(&mut self, log: LaserLog) {
        if let Some(before) = &self.log {
            self.is_outdated |= !begins_with(&log, before);
        }
        if log.scans.len() < self.track.scans.len() {
            self.tracker = Tracker::new(self.options);
            self.track = Track::default();
            self.is_outdated = false;
        }
        while self.track.scans.len() < log.scans.len() {
            self.track.extend(&mut self.tracker, &log);
        }
        self.log = Some(log);
    }

    /// Whether the track is another one than that of the log as a whole, for the log told its beginning otherwise when it was tracked.
    #[must_use]
    pub fn is_outdated(&self) -> bool {
        self.is_outdated
    }

    /// The log tracked anew from its beginning; what [`follow`](Self::follow) is given next may be longer.
    #[must_use]
    pub fn anew(options: MatchOptions, log: LaserLog) -> Self {
        let mut anew = GrowingTrack::new(options);
        anew.follow(log);
        anew
    }

    /// Goes on with a track that was made anew of an earlier state of the same log.
    pub fn replace(&mut self, anew: GrowingTrack) {
        let log = self.log.take();
        *self = anew;
        if let Some(log) = log {
            self.follow(log);
        }
    }

    /// Takes the odometry as [`track_calibrated`](super::track_calibrated) would; where that is otherwise than before, the track is
    /// outdated.
    pub fn calibrate(&mut self) {
        let found = self.log.as_ref().and_then(|log| calibrated(log, &self.track, &self.options));
        if let Some((log, options)) = found {
            (self.log, self.options, self.is_outdated) = (Some(log), options, true);
        }
    }

    /// How scans are matched.
    #[must_use]
    pub fn options(&self) -> MatchOptions {
        self.options
    }

    /// The log that was followed last, if there was any.
    #[must_use]
    pub fn log(&self) -> Option<&LaserLog> {
        self.log.as_ref()
    }

    /// The way through that log.
    #[must_use]
    pub fn track(&self) -> &Track {
        &self.track
    }
}

/// Whether all that a tracker has seen of a log is the same in another one.
fn begins_with(log: &LaserLog, before: &LaserLog) -> bool {
    let moments = before.scans.last().map_or(0, |last| last.moment + 1);
    let is_same = |(now, then): (&crate::carmen::LoggedScan, &crate::carmen::LoggedScan)| {
        now.moment == then.moment && now.scan == then.scan
    };
    log.scans.len() >= before.scans.len()
        && log.trajectory.get(..moments) == before.trajectory.get(..moments)
        && log.scans.iter().zip(&before.scans).all(is_same)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::track;
    use hssh_metrics::Pose;
    use proptest::prelude::*;

    /// A robot between two walls, one of them with a corner.
    fn log(scans: u32, limit: f64) -> LaserLog {
        let mut text = String::new();
        for scan in 0..scans {
            let pose = Pose::new(0.1 * f64::from(scan), 0.0, 0.01 * f64::from(scan));
            text += "FLASER 61";
            for beam in 0..61 {
                let bearing = pose.theta + (f64::from(beam) - 30.0) * 0.05;
                let aside = if bearing.sin() > 0.0 { 2.0 } else { 1.5 + 0.2 * (pose.x * 2.0).sin().round() };
                text += &format!(" {:.2}", (aside / bearing.sin().abs().max(1e-6)).min(limit));
            }
            let Pose { x, y, theta } = pose;
            text += &format!(" {x} {y} {theta} {x} {y} {theta} {scan} host {scan}\n");
        }
        LaserLog::read(text.as_bytes()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]
        /// However a log comes, its track is that of the log as a whole, or outdated where its limit shows only in the end; tracked anew it is
        /// that again.
        #[test]
        fn the_track_is_that_of_the_log(cuts in prop::collection::vec(1_usize..40, 0..5), is_limited in any::<bool>()) {
            let log = log(40, if is_limited { 8.0 } else { 49.0 });
            let mut growing = GrowingTrack::new(MatchOptions::default());
            for cut in cuts {
                let mut beginning = log.beginning(cut);
                if is_limited && cut < 20 {
                    beginning.scans.iter_mut().for_each(|scan| scan.scan.ranges[0] = 8.0);
                }
                growing.follow(beginning);
                prop_assert_eq!(growing.track().scans.len(), cut);
            }
            growing.follow(log.clone());
            if growing.is_outdated() {
                prop_assert!(is_limited);
                growing.replace(GrowingTrack::anew(MatchOptions::default(), log.beginning(30)));
            }
            // A laser that looks where the odometry says is not turned.
            growing.calibrate();
            prop_assert_eq!(growing.log(), Some(&log));
            prop_assert!(!growing.is_outdated());
            prop_assert_eq!(growing.track(), &track(&log, &MatchOptions::default(), |_| {}));
        }
    }
}
