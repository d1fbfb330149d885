//! Scans of the other lasers of a robot, merged with those of the one whose scans are used.

use hssh_metrics::Pose;

use super::error::{LogError, LogWarning};
use super::log::{LaserLog, LoggedScan};
use super::message::LaserKind;
use super::mount::LaserMount;
use super::position::LogPosition;
use super::raw::RawLog;
use crate::scan::{Scan, scan_around};

/// A sweep that was taken longer before or after than this is not of the same moment: seconds.
const TOGETHER: f64 = 0.25;
/// Nor is one between which and the other the robot went farther than that, in metres, or turned by more radians.
const STILL_THERE: f64 = 0.5;

/// Another laser of the robot: what it saw, from where.
pub(super) struct OtherLaser {
    /// The laser on the robot.
    mount: Pose,
    /// In the order of the log.
    sweeps: Vec<Sweep>,
}

struct Sweep {
    scan: Scan,
    /// Where odometry believed the robot to be.
    robot: Pose,
    time: Option<f64>,
    at: LogPosition,
}

impl RawLog {
    /// Leaves the scans that are chosen, the first kind's or those of most use, and hands out those of the others.
    ///
    /// # Errors
    /// If there are none of one of the kinds.
    pub(super) fn choose(
        &mut self,
        chosen: &[LaserKind],
        warnings: &mut Vec<LogWarning>,
    ) -> Result<Vec<RawLog>, LogError> {
        let Some((&first, others)) = chosen.split_first() else {
            self.keep_best_kind(warnings);
            return Ok(Vec::new());
        };
        let of = |kind: LaserKind| self.scans.iter().any(|scan| scan.kind == kind);
        if let Some(asked) = chosen.iter().find(|&&kind| !of(kind)) {
            let has: Vec<&str> =
                LaserKind::ALL.into_iter().filter(|&kind| of(kind)).map(LaserKind::name).collect();
            return Err(LogError::NoSuchLaser { asked: asked.name(), has: has.join(", ") });
        }
        let part = |&kind: &LaserKind| {
            let mut part = self.clone();
            part.scans.retain(|scan| scan.kind == kind);
            part
        };
        let others = others.iter().filter(|kind| **kind != first).map(part).collect();
        self.keep(first);
        Ok(others)
    }
}

impl OtherLaser {
    /// Another laser, given its messages among the odometry of all.
    ///
    /// # Errors
    /// If hardly a beam of it came back.
    pub(super) fn new(mut raw: RawLog, warnings: &mut Vec<LogWarning>) -> Result<Self, LogError> {
        raw.keep_scans_of_known_view(warnings);
        raw.tell_odd_beams(warnings);
        let (geometry, _) = raw.geometry(&LaserMount::default());
        let robot: Vec<Pose> = raw.scans.iter().map(|scan| raw.trajectory[scan.moment].pose).collect();
        let mount = raw.move_to_laser(&LaserMount::default(), &mut Vec::new());
        if let Some(first) = raw.scans.first() {
            let text = format!(
                "merged with {} scans of {}, of a laser {:.2} m ahead of the robot's axis and {:.2} m to its left",
                raw.scans.len(),
                first.kind.name(),
                mount.x,
                mount.y
            );
            warnings.push(LogWarning::Remark { text, is_loss: false });
        }
        let max_range = raw.limit(|scan| geometry[scan], warnings)?;
        let log = raw.into_log(geometry, max_range, Vec::new());
        let sweep = |(logged, robot): (LoggedScan, Pose)| Sweep {
            scan: logged.scan,
            robot,
            time: logged.time,
            at: logged.at,
        };
        Ok(OtherLaser { mount, sweeps: log.scans.into_iter().zip(robot).map(sweep).collect() })
    }

    /// What it saw when the robot's scan at a place of the log was taken: the sweep before or behind that in the log, whichever is nearer.
    fn at_the_moment_of(&self, scan: &LoggedScan, robot: Pose) -> Option<&Sweep> {
        let behind = self.sweeps.partition_point(|sweep| sweep.at < scan.at);
        let around = self.sweeps[behind.saturating_sub(1)..].iter().take(2);
        let off = |sweep: &&Sweep| match (sweep.time, scan.time) {
            (Some(time), Some(other)) => (time - other).abs(),
            _ => 0.0,
        };
        let is_there = |sweep: &&Sweep| {
            let step = robot.between(sweep.robot);
            step.translation().norm() <= STILL_THERE && step.theta.abs() <= STILL_THERE
        };
        around
            .filter(|sweep| off(sweep) <= TOGETHER && is_there(sweep))
            .min_by(|one, other| off(one).total_cmp(&off(other)))
    }
}

impl LaserLog {
    /// The log with what other lasers saw at about the same moments. `robot` is where odometry believed the robot to be at each scan, and `mount`
    /// where the laser of these scans sits on it.
    pub(super) fn seen_around(mut self, robot: &[Pose], mount: Pose, others: &[OtherLaser]) -> Self {
        let limit = self.max_range;
        for (logged, robot) in self.scans.iter_mut().zip(robot) {
            let seen = others.iter().filter_map(|other| {
                let sweep = other.at_the_moment_of(logged, *robot)?;
                let laser = robot.between(sweep.robot).compose(other.mount);
                Some((&sweep.scan, mount.between(laser)))
            });
            let around = scan_around(&logged.scan, &seen.collect::<Vec<_>>());
            let told = |range: f64| if range < limit { range } else { f64::INFINITY };
            logged.scan = Scan { ranges: around.ranges.into_iter().map(told).collect(), ..around };
        }
        self
    }
}
