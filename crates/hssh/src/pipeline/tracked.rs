//! A laser log whose odometry is corrected from scan to scan, without places and without loops.

use hssh_local::{
    LaserLog, LatticeError, MatchOptions, OccupancyGrid, Reply, SurveyWarning, Track, building_map, doubts,
    track_calibrated, turned_laser,
};
use hssh_metrics::{Edge, GraphError, Pose, PoseGraph, PoseId};

use super::scans;
use crate::answer::AnswerWarning;

/// A log with the robot's way, scan by scan.
#[derive(Clone, Debug)]
pub struct TrackedLog {
    /// The log.
    pub log: LaserLog,
    /// The robot's way, in the frame of its first scan.
    pub track: Track,
    /// Where it is doubtful.
    doubts: Vec<SurveyWarning>,
}

impl TrackedLog {
    /// Matches each scan of a log with those before it; `progress` is told how many are done, and may stop it: the log is then
    /// cut off behind them.
    pub fn new<R: Into<Reply>>(
        log: LaserLog,
        options: &MatchOptions,
        progress: impl FnMut(usize) -> R,
    ) -> Self {
        let (log, track) = track_calibrated(log, options, progress);
        let scans = track.scans.len();
        let is_whole = scans == log.scans.len();
        let log = if is_whole { log } else { log.beginning(scans) };
        let mut doubts = doubts(&log, &track);
        doubts.extend(turned_laser(&log, &track));
        if !is_whole {
            doubts.push(SurveyWarning::Interrupted { scans });
        }
        TrackedLog { log, track, doubts }
    }

    /// How many laser scans the log has, those that cannot be used among them.
    #[must_use]
    pub fn scans(&self) -> u64 {
        scans::all(&self.log)
    }

    /// The number of a scan among all laser scans of the log.
    #[must_use]
    pub fn scan_number(&self, used: usize) -> u64 {
        scans::number(&self.log, used)
    }

    /// What was left out of the log, or where the robot is lost.
    #[must_use]
    pub fn warnings(&self) -> Vec<AnswerWarning> {
        let mut warnings = scans::warnings(&self.log);
        scans::warn_of(&self.doubts, &self.log, &mut warnings);
        warnings
    }

    /// What of the log is missing from the track, in words, if it is more than a scan here and there.
    #[must_use]
    pub fn partial(&self) -> Option<String> {
        scans::partial(&self.log)
    }

    /// The first thing in the log that is missing from the track, in words.
    #[must_use]
    pub fn first_loss(&self) -> Option<String> {
        scans::first_loss(&self.log)
    }

    /// Where each scan that can be used was taken, in the frame of the first.
    #[must_use]
    pub fn poses(&self) -> Vec<Pose> {
        self.track.scans.iter().map(|scan| scan.pose).collect()
    }

    /// When every scan of the log was taken and where, those that cannot be used among them: they have the pose of the scan
    /// before. The time is that of the log, or the number of the scan.
    #[must_use]
    pub fn trajectory(&self) -> Vec<(f64, Pose)> {
        scans::timed(&self.log, &self.poses())
    }

    /// What the scans draw where the track has them.
    ///
    /// # Errors
    /// If the grid would be too large.
    pub fn grid(&self) -> Result<OccupancyGrid, LatticeError> {
        building_map(&self.log, &self.poses())
    }

    /// A pose for each scan, and an edge for each tracked step.
    ///
    /// # Errors
    /// If a step is no edge.
    pub fn graph(&self) -> Result<PoseGraph, GraphError> {
        let mut graph = PoseGraph::new();
        for scan in &self.track.scans {
            let end = graph.add_pose(scan.pose);
            if let (Some(start), Some(step)) = (end.0.checked_sub(1), &scan.step) {
                graph.add_edge(Edge::observed(PoseId(start), end, step.mean, &step.covariance))?;
            }
        }
        graph.anchor_components();
        Ok(graph)
    }
}
