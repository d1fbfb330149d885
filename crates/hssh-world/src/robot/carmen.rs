//! A drive as a CARMEN log: `ODOM` and `FLASER` messages, and the laser's range as a `PARAM`.

use std::fmt::Write;

use hssh_metrics::Pose;

use super::drive::Drive;
use super::record::Moment;

impl Drive {
    /// The log as text. The first pose of a `FLASER` message is the true one, where other logs have somebody's
    /// scan matching: it is for scoring. The second one is raw odometry, as are all of `ODOM`. Ranges where nothing
    /// came back are written as `robot_front_laser_max`.
    #[must_use]
    pub fn to_carmen(&self) -> String {
        text(&self.moments, self.max_range)
    }
}

/// Moments as lines of a log whose laser has no echo from so many metres on.
pub(super) fn text(moments: &[Moment], max_range: f64) -> String {
    let mut text = format!("PARAM robot_front_laser_max {:.2} nohost 0\n", max_range);
    let mut before: Option<(f64, Pose)> = None;
    for moment in moments {
        let (time, odometry) = (moment.time, moment.odometry);
        let stamp = format!("{time:.2} nohost {time:.2}");
        let (speed, turn) = before.map_or((0.0, 0.0), |(earlier, from)| {
            let (step, seconds) = (from.between(odometry), time - earlier);
            (step.x / seconds, step.theta / seconds)
        });
        before = Some((time, odometry));
        let line = match &moment.scan {
            None => format!("ODOM {} {speed:.4} {turn:.4} 0 {stamp}", pose(odometry)),
            Some(scan) => {
                let written = |range: &f64| format!("{:.3}", range.min(max_range));
                let ranges: Vec<String> = scan.iter().map(written).collect();
                let poses = format!("{} {}", pose(moment.pose), pose(odometry));
                format!("FLASER {} {} {poses} {stamp}", ranges.len(), ranges.join(" "))
            }
        };
        writeln!(text, "{line}").expect("a string takes everything");
    }
    text
}

fn pose(pose: Pose) -> String {
    format!("{:.5} {:.5} {:.6}", pose.x, pose.y, pose.theta)
}
