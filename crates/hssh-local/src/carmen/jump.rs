//! Jumps of the odometry that no robot makes: its base was restarted, or somebody carried it.

use hssh_metrics::Pose;

use super::error::LogWarning;
use super::raw::{Moment, RawLog};

/// No step between two readings is a jump that is shorter than this many metres…
const LEAST: f64 = 2.0;
/// …or than so many usual steps, where it is known how long they take and where it is not…
const TIMES_USUAL: (f64, f64) = (4.0, 20.0);
/// …or that a robot could have made in the time at this speed, in metres per second…
const FASTEST: f64 = 4.0;
/// …or, for turns, at this rate, in radians per second.
const QUICKEST: f64 = 4.0;
/// A step between two readings takes no longer than so many of the same stretch do on average.
const UNEVEN: f64 = 4.0;
/// No turn between two readings is a jump that is smaller, in radians.
const LEAST_TURN: f64 = 1.2;
/// Odometry that comes from farther away than this, in metres and radians, and is exactly where it counts from begins anew.
const ANEW: f64 = 0.3;
/// What is known of a step across a jump is as little as after so many metres of travel.
const DETOUR: f64 = 8.0;

impl RawLog {
    /// Takes jumps out of the trajectory: what comes behind one is moved to where the step before would have led, and a
    /// detour there and back says that this is a guess, so that scans decide.
    pub(crate) fn bridge_jumps(&mut self, warnings: &mut Vec<LogWarning>) {
        let usual = self.usual_step();
        let raw = std::mem::take(&mut self.trajectory);
        let seconds = self.seconds(raw.len());
        let mut position = Vec::with_capacity(raw.len());
        let (mut moved, mut last_step) = (Pose::IDENTITY, Pose::IDENTITY);
        for (index, &Moment { pose, at }) in raw.iter().enumerate() {
            if let Some(before) = index.checked_sub(1) {
                let step = raw[before].pose.between(pose);
                if begins_anew(step, pose) || is_jump(step, usual, seconds[index]) {
                    let (metres, turn) = (step.translation().norm(), step.theta);
                    warnings.push(LogWarning::Jump { at, metres, turn });
                    let here = self.trajectory.last().map_or(pose, |last| last.pose);
                    moved = here.compose(last_step).compose(pose.inverse());
                    let away = here.compose(Pose::new(DETOUR / 2.0, 0.0, 0.0));
                    self.trajectory.extend([away, here].map(|pose| Moment { pose, at }));
                } else {
                    last_step = step;
                }
            }
            position.push(self.trajectory.len());
            self.trajectory.push(Moment { pose: moved.compose(pose), at });
        }
        for scan in &mut self.scans {
            scan.moment = position[scan.moment];
        }
    }

    /// The middle one of all steps that are any.
    pub(super) fn usual_step(&self) -> f64 {
        let step = |pair: &[Moment]| pair[0].pose.between(pair[1].pose).translation().norm();
        let mut steps: Vec<f64> = self.trajectory.windows(2).map(step).filter(|&step| step > 1e-3).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied().unwrap_or(0.0)
    }

    /// For each step from one reading to the next, how long it took at most, in seconds: no longer than it is from scan to scan, and not much
    /// longer than the readings between them have each.
    fn seconds(&self, readings: usize) -> Vec<Option<f64>> {
        let mut seconds = vec![None; readings];
        for pair in self.scans.windows(2) {
            if let (Some(from), Some(to)) = (pair[0].time, pair[1].time) {
                let steps = pair[1].moment - pair[0].moment;
                let part = (UNEVEN / steps as f64).min(1.0);
                seconds[pair[0].moment + 1..=pair[1].moment].fill(Some(part * (to - from)));
            }
        }
        seconds
    }
}

/// Whether a step ends exactly where all odometry begins, however long it took: the recording was stopped and begun again.
fn begins_anew(step: Pose, pose: Pose) -> bool {
    pose == Pose::IDENTITY && step.translation().norm().max(step.theta.abs()) > ANEW
}

fn is_jump(step: Pose, usual: f64, seconds: Option<f64>) -> bool {
    // Clocks that stand still or go back tell nothing.
    let seconds = seconds.filter(|&seconds| seconds > 0.0);
    let way = seconds.map_or(0.0, |seconds| FASTEST * seconds);
    let (far, turned) = (step.translation().norm(), step.theta.abs());
    let times = if seconds.is_some() { TIMES_USUAL.0 } else { TIMES_USUAL.1 };
    let is_far = far > LEAST.max(times * usual).max(way);
    let is_quick = seconds.is_some_and(|seconds| turned > LEAST_TURN + QUICKEST * seconds);
    is_far || is_quick
}
