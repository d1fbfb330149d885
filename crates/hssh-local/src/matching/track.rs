//! The robot's way through a log: every scan matched against those shortly before it.

use std::collections::VecDeque;

use hssh_metrics::{Pose, UncertainPose, UncertaintyError};

use super::align::align;
use super::cloud::{Cloud, SurfacePoint, surfaces};
use super::correlate::{LikelihoodField, search};
use super::options::MatchOptions;
use crate::carmen::LaserLog;

/// Where a scan was taken.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TrackedScan {
    /// The robot in the frame of the first scan. Good over some ten metres; over more it drifts.
    pub pose: Pose,
    /// The motion since the scan before, in that scan's frame; at the first scan the robot has not moved.
    pub step: Option<UncertainPose>,
    /// Metres travelled since the first scan.
    pub travelled: f64,
}

/// The robot's way, scan by scan.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Track {
    /// As many as the log has scans.
    pub scans: Vec<TrackedScan>,
}

impl Track {
    /// The relative motion between two scans with its covariance: the later one's pose as seen from the
    /// earlier one. `None` if they are the same scan.
    ///
    /// # Errors
    /// If the way is so long that its covariance comes too close to singular.
    pub fn motion(&self, from: usize, to: usize) -> Result<Option<UncertainPose>, UncertaintyError> {
        UncertainPose::compound(self.scans[from + 1..=to].iter().filter_map(|scan| scan.step.as_ref()))
    }
}

/// A scan that later ones are matched against.
struct Keyframe {
    pose: Pose,
    travelled: f64,
    surfaces: Vec<SurfacePoint>,
}

/// What a scan is matched against: the surfaces seen from the keyframes of the last few metres.
struct Reference {
    cloud: Cloud,
    field: LikelihoodField,
}

impl Reference {
    fn new<'a>(keyframes: impl Iterator<Item = &'a Keyframe>, center: Pose, options: &MatchOptions) -> Self {
        let mut cloud = Cloud::default();
        for keyframe in keyframes {
            cloud.insert(keyframe.pose, &keyframe.surfaces, options.spacing / 2.0);
        }
        let field = LikelihoodField::new(&cloud, center.translation(), options.reach);
        Reference { cloud, field }
    }
}

/// Tracks the robot through a log, from scans and raw odometry. `progress` is told after each scan how
/// many are done.
pub fn track(log: &LaserLog, options: &MatchOptions, mut progress: impl FnMut(usize)) -> Track {
    let mut track = Track::default();
    let mut keyframes: VecDeque<Keyframe> = VecDeque::new();
    let mut reference = Reference::new(keyframes.iter(), Pose::IDENTITY, options);
    for (index, logged) in log.scans.iter().enumerate() {
        let seen = surfaces(&logged.scan, options.reach, options.spacing);
        let tracked = match (track.scans.last(), index.checked_sub(1)) {
            (Some(last), Some(before)) => {
                let moments = log.scans[before].moment..=logged.moment;
                let odometry = options.odometry.motion(&log.trajectory[moments]);
                let step = matched(&reference, &seen, last.pose, &odometry, options);
                TrackedScan {
                    pose: last.pose.compose(step.mean),
                    step: Some(step),
                    travelled: last.travelled + step.mean.translation().norm(),
                }
            }
            _ => TrackedScan { pose: Pose::IDENTITY, step: None, travelled: 0.0 },
        };
        if keyframes.back().is_none_or(|last| is_new_view(last, &tracked, options)) {
            let TrackedScan { pose, travelled, .. } = tracked;
            keyframes.push_back(Keyframe { pose, travelled, surfaces: seen });
            keyframes.retain(|keyframe| travelled - keyframe.travelled <= options.memory);
            reference = Reference::new(keyframes.iter().rev(), pose, options);
        }
        track.scans.push(tracked);
        progress(index + 1);
    }
    track
}

/// The motion since the pose `from`: coarse, then fine.
fn matched(
    reference: &Reference,
    seen: &[SurfacePoint],
    from: Pose,
    odometry: &UncertainPose,
    options: &MatchOptions,
) -> UncertainPose {
    let predicted = UncertainPose {
        mean: from.compose(odometry.mean),
        covariance: odometry.covariance.rotated(from.theta),
    };
    let weight = 1.0 / options.hits_per_observation;
    let start = search(&reference.field, seen, &predicted, options.search_sigmas, weight);
    let fine = align(&reference.cloud, seen, start, &predicted, options);
    UncertainPose { mean: from.between(fine.mean), covariance: fine.covariance.rotated(-from.theta) }
}

fn is_new_view(last: &Keyframe, tracked: &TrackedScan, options: &MatchOptions) -> bool {
    tracked.travelled - last.travelled > options.keyframe_distance
        || last.pose.between(tracked.pose).theta.abs() > options.keyframe_turn
}
