//! A laser log from a recording whose scans and odometry come by themselves, each with its own time.

use hssh_metrics::Pose;

use crate::carmen::{LaserKind, LaserLog, LogError, LogPosition, LogWarning, Moment, RawLog, RawScan};
use crate::matching::{TimedScan, odometry_from_scans};
use crate::scan::Scan;

/// What a robot recorded.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Recording {
    /// The scans in order of their times, with what did not come back as infinite.
    pub scans: Vec<RecordedScan>,
    /// Raw odometry of the robot in order of its times; none if the robot has none.
    pub odometry: Vec<TimedPose>,
    /// Where the laser sits in the frame that the odometry moves, metres ahead and to the left; how it is turned is said by its scans.
    pub laser: [f64; 2],
    /// Whether who reads it said where the laser sits.
    pub is_laser_given: bool,
    /// What its reader has to say.
    pub warnings: Vec<LogWarning>,
}

/// A scan as it was recorded.
#[derive(Clone, PartialEq, Debug)]
pub struct RecordedScan {
    /// The scan in a frame that is turned as the robot is.
    pub scan: Scan,
    /// When it was taken: seconds.
    pub time: f64,
}

/// Where odometry believes the robot to be at a time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TimedPose {
    /// Seconds, of the same clock as the scans.
    pub time: f64,
    /// The robot in the frame of odometry.
    pub pose: Pose,
}

impl Recording {
    /// Drops the scans behind the last reading of odometry, if there is any: while the robot drives on, the next reading says
    /// where they were taken.
    pub fn drop_unsettled(&mut self) {
        if let Some(last) = self.odometry.last() {
            self.scans.retain(|scan| scan.time <= last.time);
        }
    }
}

impl LaserLog {
    /// The log of a recording. A scan stands where odometry was at its time, between the two readings around it; without odometry, where scan
    /// matching puts it.
    ///
    /// # Errors
    /// If there is no scan, or if hardly a beam came back.
    pub fn from_recording(recording: Recording) -> Result<Self, LogError> {
        let Recording { scans, odometry, laser: [x, y], is_laser_given, mut warnings } = recording;
        if scans.is_empty() {
            return Err(LogError::NothingRecorded);
        }
        let odometry: Vec<TimedPose> = if odometry.is_empty() {
            warnings.push(LogWarning::ScansAlone);
            let timed: Vec<TimedScan<'_>> = scans
                .iter()
                .map(|recorded| TimedScan { scan: &recorded.scan, time: recorded.time })
                .collect();
            let poses = odometry_from_scans(&timed);
            timed.iter().zip(poses).map(|(scan, pose)| TimedPose { time: scan.time, pose }).collect()
        } else {
            let at = Pose::new(x, y, 0.0);
            // A laser at the axis leaves every bit of the odometry as it is.
            let moved = |pose: Pose| if at == Pose::IDENTITY { pose } else { pose.compose(at) };
            odometry.into_iter().map(|timed| TimedPose { pose: moved(timed.pose), ..timed }).collect()
        };
        let (geometry, mut raw) = merged(scans, &odometry);
        raw.check_handed(&mut warnings);
        raw.check_repeats(&mut warnings);
        raw.check_speed(&mut warnings);
        raw.check_order()?;
        raw.bridge_jumps(&mut warnings);
        let looks = |scan: usize| geometry[scan];
        let max_range = raw.limit(looks, &mut warnings)?;
        raw.check_pace(looks, max_range, &mut warnings);
        raw.check_noise(looks, max_range, &mut warnings);
        // A recording says where its laser looks.
        Ok(LaserLog { is_laser_given, ..raw.into_log(geometry, max_range, warnings) })
    }
}

/// Scans among the odometry, by time, with the view and the turn of each.
fn merged(scans: Vec<RecordedScan>, odometry: &[TimedPose]) -> (Vec<(f64, f64)>, RawLog) {
    let mut raw = RawLog::default();
    let mut geometry = Vec::with_capacity(scans.len());
    let mut next = 0;
    for (index, RecordedScan { scan, time }) in scans.into_iter().enumerate() {
        let at = LogPosition::Scan(index as u64 + 1);
        let moment = |pose: Pose| Moment { pose, at };
        while let Some(reading) = odometry.get(next).filter(|reading| reading.time < time) {
            raw.trajectory.push(moment(reading.pose));
            next += 1;
        }
        let behind = odometry.get(next);
        let before = next.checked_sub(1).map(|before| odometry[before]);
        let pose = match (before, behind) {
            (_, Some(behind)) if behind.time <= time => {
                next += 1;
                behind.pose
            }
            (Some(before), Some(behind)) => between(before, *behind, time),
            (Some(only), None) => only.pose,
            (None, Some(only)) => only.pose,
            (None, None) => Pose::IDENTITY,
        };
        raw.trajectory.push(moment(pose));
        geometry.push((scan.view, scan.turn));
        raw.scans.push(RawScan {
            kind: LaserKind::Front,
            looks: None,
            ranges: scan.ranges,
            odd_beams: 0,
            odd_word: None,
            corrected: pose,
            moment: raw.trajectory.len() - 1,
            at,
            time: Some(time),
        });
    }
    let at = LogPosition::Scan(geometry.len() as u64);
    raw.trajectory.extend(odometry[next..].iter().map(|reading| Moment { pose: reading.pose, at }));
    (geometry, raw)
}

/// The pose at a time between two readings, as if the robot moved evenly.
fn between(before: TimedPose, behind: TimedPose, time: f64) -> Pose {
    let part = ((time - before.time) / (behind.time - before.time)).clamp(0.0, 1.0);
    let step = before.pose.between(behind.pose);
    before.pose.compose(Pose::new(step.x * part, step.y * part, step.theta * part))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording(times: &[f64], odometry: &[(f64, f64)]) -> Recording {
        let scan = Scan { ranges: vec![1.5, f64::INFINITY, 2.5], view: 2.0, turn: 0.5 };
        let scans = times.iter().map(|&time| RecordedScan { scan: scan.clone(), time }).collect();
        let odometry = odometry.iter().map(|&(time, x)| TimedPose { time, pose: Pose::new(x, 0.0, 0.0) });
        Recording { scans, odometry: odometry.collect(), laser: [0.25, 0.0], ..Recording::default() }
    }

    #[test]
    fn scans_stand_where_odometry_was() {
        let log = recording(&[0.5, 1.0, 1.25, 9.0], &[(0.0, 0.0), (1.0, 1.0), (1.0, 1.0), (2.0, 2.0)]);
        let log = LaserLog::from_recording(log).unwrap();
        let at: Vec<f64> = log.scans.iter().map(|scan| scan.odometry.x).collect();
        assert_eq!(at, [0.75, 1.25, 1.5, 2.25]);
        let way: Vec<f64> = log.trajectory.iter().map(|pose| pose.x).collect();
        assert_eq!(way, [0.25, 0.75, 1.25, 1.25, 1.5, 2.25, 2.25]);
        assert_eq!((log.scans[0].scan.view, log.scans[0].scan.turn), (2.0, 0.5));
    }

    #[test]
    fn without_scans_there_is_no_log() {
        let nothing = LaserLog::from_recording(recording(&[], &[(0.0, 0.0)]));
        assert!(matches!(nothing, Err(LogError::NothingRecorded)));
    }
}
