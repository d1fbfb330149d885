//! The robot's way through a log: every scan matched against those shortly before it.

use std::collections::VecDeque;

use hssh_metrics::{Pose, UncertainPose, UncertaintyError};

use super::align::align;
use super::bend::Bend;
use super::cloud::{Cloud, SurfacePoint, filled, surfaces};
use super::correlate::{LikelihoodField, USUAL_REACH, search};
use super::options::MatchOptions;
use super::outlook::Outlook;
use crate::carmen::LaserLog;
use crate::progress::Reply;
use crate::scan::Scan;

/// Of a scan that lies on nothing the hits' mean log-likelihood is below this, in nats: 0 is perfect, −3 hits nothing.
const LOST: f64 = -1.2;
/// A scan of which less than this part may have been seen before, as after half a turn at once, tells its pose no better than odometry does, and
/// lies on nothing that was seen, as if its hits fitted so well.
const LEAST_KNOWN: f64 = 0.1;
const OFF_ALL: f64 = -3.0;
/// The odometry of a step is taken for worse than believed if the hits' mean log-likelihood is below this…
const SUSPICION: f64 = -0.3;
/// …and worse odometry fits better by so many nats.
const PRICE: f64 = 6.0;
/// With fewer surfaces in sight, which may be people who move, odometry is not doubted.
const MUCH: usize = 40;
/// A search this wide, in metres, is made with a part of the surfaces.
const WIDE: f64 = 0.5;

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
    /// The scans that lie on nothing that was seen before, wherever they are put: there the robot is lost, or it came
    /// around a corner in one step.
    pub lost: Vec<usize>,
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

    /// Adds the next scan of a log, of which the tracker has seen all before.
    pub(super) fn extend(&mut self, tracker: &mut Tracker, log: &LaserLog) {
        let index = self.scans.len();
        let logged = &log.scans[index];
        let before = index.checked_sub(1).map_or(logged.moment, |before| log.scans[before].moment);
        self.scans.push(tracker.add(&logged.scan, &log.trajectory[before..=logged.moment]));
        if tracker.is_lost() {
            self.lost.push(index);
        }
    }
}

/// A scan that later ones are matched against.
struct Keyframe {
    travelled: f64,
    surfaces: Vec<SurfacePoint>,
    outlook: Outlook,
}

/// What a scan is matched against: the surfaces seen from the keyframes of the last few metres.
struct Reference {
    cloud: Cloud,
    field: LikelihoodField,
    /// The coarse search goes by what was hit nearer than this, in metres.
    coarse_reach: f64,
}

impl Reference {
    fn new<'a>(
        keyframes: impl Iterator<Item = &'a Keyframe>,
        center: Pose,
        coarse_reach: f64,
        options: &MatchOptions,
    ) -> Self {
        let mut cloud = Cloud::default();
        for keyframe in keyframes {
            cloud.insert(keyframe.outlook.pose(), &keyframe.surfaces, options.spacing / 2.0);
        }
        let field = LikelihoodField::new(&cloud, center.translation(), coarse_reach);
        Reference { cloud, field, coarse_reach }
    }
}

/// What a scan shows, in the robot's frame.
#[derive(Clone)]
struct Seen {
    /// All surfaces: far ones hold the heading.
    all: Vec<SurfacePoint>,
    /// Those near enough for the coarse search.
    near: Vec<SurfacePoint>,
}

/// How far the coarse search has to look, in metres, so that surfaces are enough to go by: as far as usual, or farther where little is near.
fn coarse_reach(surfaces: &[SurfacePoint], options: &MatchOptions) -> f64 {
    let mut reach = USUAL_REACH.min(options.reach);
    let within = |reach: f64| surfaces.iter().filter(|surface| surface.position.norm() < reach).count();
    while reach < options.farthest_reach && within(reach) < MUCH.min(surfaces.len()) {
        reach = (1.5 * reach).min(options.farthest_reach);
    }
    reach
}

impl Seen {
    fn new(scan: &Scan, coarse_reach: f64, options: &MatchOptions) -> Self {
        let mut all = surfaces(scan, options.reach, options.spacing);
        if all.len() < MUCH {
            all = surfaces(scan, options.farthest_reach, options.spacing);
        }
        let near = all.iter().filter(|surface| surface.position.norm() < coarse_reach).copied().collect();
        Seen { all, near }
    }

    /// Those near enough for the coarse search that scans before may have shown, if this one was taken about where it is believed to be. What
    /// none of them could see lies on nothing, wherever it is put, and would speak for standing still: most for who drives backward, who sees
    /// new walls beside him with every step.
    fn comparable<'a>(
        &self,
        keyframes: impl Iterator<Item = &'a Keyframe> + Clone,
        believed: Pose,
    ) -> Vec<SurfacePoint> {
        let rotation = believed.rotation();
        let was_in_sight = |surface: &&SurfacePoint| {
            let at = believed.translation() + rotation * surface.position;
            keyframes.clone().any(|keyframe| keyframe.outlook.saw(at))
        };
        self.near.iter().filter(was_in_sight).copied().collect()
    }
}

/// Tracks a robot scan by scan, from scans and raw odometry.
pub struct Tracker {
    options: MatchOptions,
    last: Option<TrackedScan>,
    /// How well the last scan fits: the hits' mean log-likelihood.
    fit: f64,
    keyframes: VecDeque<Keyframe>,
    reference: Reference,
    /// What odometry gets wrong with every metre.
    bend: Bend,
    /// Whether the last scan shows few surfaces.
    sees_little: bool,
}

impl Tracker {
    /// A tracker that has seen nothing yet.
    #[must_use]
    pub fn new(options: MatchOptions) -> Self {
        let reference = Reference::new(std::iter::empty(), Pose::IDENTITY, USUAL_REACH, &options);
        Tracker {
            options,
            last: None,
            fit: 0.0,
            keyframes: VecDeque::new(),
            reference,
            bend: Bend::default(),
            sees_little: false,
        }
    }

    /// Where the next scan was taken. `odometry` has the raw poses since the scan before, that of the scan
    /// before first and that of this one last; of the first scan only one.
    ///
    /// # Panics
    /// If there is no raw pose.
    pub fn add(&mut self, scan: &Scan, odometry: &[Pose]) -> TrackedScan {
        let told = self.options.odometry.motion(odometry);
        let worst = self.options.worst_odometry.map(|noise| noise.motion(odometry));
        // What scans show they show without it.
        let straight = |motion| if self.sees_little { self.bend.straightened(&motion) } else { motion };
        let (believed, worst) = (straight(told), worst.map(straight));
        let tracked = self.add_moved(scan, &believed, worst.as_ref());
        if let Some(known) = &tracked.step {
            self.bend.learn(&told, &believed, known);
        }
        tracked
    }

    /// Where the next scan was taken, of which it is known how the robot moved since the scan before; and how uncertain that is at worst.
    pub(super) fn add_moved(
        &mut self,
        scan: &Scan,
        motion: &UncertainPose,
        worst: Option<&UncertainPose>,
    ) -> TrackedScan {
        let seen = Seen::new(scan, self.reference.coarse_reach, &self.options);
        let tracked = match &self.last {
            None => TrackedScan { pose: Pose::IDENTITY, step: None, travelled: 0.0 },
            Some(last) => {
                let believed = last.pose.compose(motion.mean);
                let near = seen.comparable(self.keyframes.iter().rev(), believed);
                let is_new =
                    seen.near.len() >= MUCH && (near.len() as f64) < LEAST_KNOWN * seen.near.len() as f64;
                let seen = Seen { near, ..seen.clone() };
                let matched = matched(&self.reference, &seen, last.pose, (motion, worst), &self.options);
                let told = worst.unwrap_or(motion);
                let step =
                    if is_new { UncertainPose { covariance: told.covariance, ..matched } } else { matched };
                let pose = last.pose.compose(step.mean);
                self.fit = if is_new { OFF_ALL } else { self.reference.field.fit(&seen.near, pose) };
                TrackedScan {
                    pose,
                    step: Some(step),
                    travelled: last.travelled + step.mean.translation().norm(),
                }
            }
        };
        if self.keyframes.back().is_none_or(|last| is_new_view(last, &tracked, &self.options)) {
            let TrackedScan { pose, travelled, .. } = tracked;
            let outlook = Outlook::new(pose, scan.clone());
            self.keyframes.push_back(Keyframe { travelled, surfaces: filled(&seen.all), outlook });
            self.keyframes.retain(|keyframe| travelled - keyframe.travelled <= self.options.memory);
            let reach = coarse_reach(&seen.all, &self.options);
            self.reference = Reference::new(self.keyframes.iter().rev(), pose, reach, &self.options);
        }
        self.sees_little = seen.all.len() < MUCH;
        self.last = Some(tracked);
        tracked
    }
}

impl Tracker {
    /// Whether the last scan lies on nothing that was seen before.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.fit < LOST
    }
}

/// Tracks the robot through a log. `progress` is told after each scan how many are done, and may stop there.
pub fn track<R: Into<Reply>>(
    log: &LaserLog,
    options: &MatchOptions,
    mut progress: impl FnMut(usize) -> R,
) -> Track {
    let mut tracker = Tracker::new(*options);
    let mut track = Track::default();
    for index in 0..log.scans.len() {
        track.extend(&mut tracker, log);
        if progress(index + 1).into() == Reply::Stop {
            break;
        }
    }
    track
}

/// The motion since the pose `from`: coarse, then fine. Where that fits badly the odometry may be worse than believed, and where that
/// fits badly, too, the wheels may have slipped.
fn matched(
    reference: &Reference,
    seen: &Seen,
    from: Pose,
    (odometry, worst): (&UncertainPose, Option<&UncertainPose>),
    options: &MatchOptions,
) -> UncertainPose {
    let fit = |step: &UncertainPose| reference.field.fit(&seen.near, from.compose(step.mean));
    let observations = seen.near.len() as f64 / options.hits_per_observation;
    // What is less probable has to fit better by so much.
    let better = |believed: UncertainPose, wider: &UncertainPose, price: f64| {
        let other = fitted(reference, seen, from, wider, options);
        if observations * (fit(&other) - fit(&believed)) > price { other } else { believed }
    };
    let mut believed = fitted(reference, seen, from, odometry, options);
    if seen.all.len() < MUCH {
        return believed;
    }
    if let Some(worst) = worst.filter(|_| fit(&believed) < SUSPICION) {
        believed = better(believed, worst, PRICE);
    }
    if let Some(slip) = options.slip.filter(|slip| fit(&believed) < slip.suspicion) {
        believed = better(believed, &slip.widened(worst.unwrap_or(odometry)), slip.price);
    }
    believed
}

/// The motion since the pose `from` that fits surfaces and odometry best.
fn fitted(
    reference: &Reference,
    seen: &Seen,
    from: Pose,
    odometry: &UncertainPose,
    options: &MatchOptions,
) -> UncertainPose {
    let predicted = UncertainPose {
        mean: from.compose(odometry.mean),
        covariance: odometry.covariance.rotated(from.theta),
    };
    let weight = 1.0 / options.hits_per_observation;
    // The wider the search, the fewer surfaces it takes to tell poses apart.
    let spread = predicted.covariance.matrix().diagonal().xy().map(f64::sqrt).max() * options.search_sigmas;
    let step = if spread > WIDE { 3 } else { 1 };
    let few: Vec<SurfacePoint> = seen.near.iter().step_by(step).copied().collect();
    let start = search(&reference.field, &few, &predicted, options.search_sigmas, weight * step as f64);
    let new = new_part(&odometry.mean, options);
    let fine = align(&reference.cloud, &seen.all, start, &predicted, new, options);
    UncertainPose { mean: from.between(fine.mean), covariance: fine.covariance.rotated(-from.theta) }
}

/// Which part of the way to the next keyframe a step is: a robot that has hardly moved sees again what it saw, and errs as it did.
fn new_part(step: &Pose, options: &MatchOptions) -> f64 {
    /// Even who stands still sees something new.
    const LEAST: f64 = 0.01;
    let part =
        step.translation().norm() / options.keyframe_distance + step.theta.abs() / options.keyframe_turn;
    part.clamp(LEAST, 1.0)
}

fn is_new_view(last: &Keyframe, tracked: &TrackedScan, options: &MatchOptions) -> bool {
    tracked.travelled - last.travelled > options.keyframe_distance
        || last.outlook.pose().between(tracked.pose).theta.abs() > options.keyframe_turn
}
