//! Follows a stream: every scan is matched as it comes, and the map is made anew as the robot gets on.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use hssh::pipeline::{Input, Mapped, MappingOptions, Monitor, SurveyedLog, map};
use hssh_local::{GrowingTrack, LaserLog, Reply, Scan, Track};
use hssh_metrics::Pose;
use serde::Serialize;

use super::hub::Hub;
use super::stream::{Snapshot, Stream};

/// Between two looks at a stream so many times what a look takes is left to others.
const REST: u32 = 1;
/// A pause is never longer.
const LONGEST_REST: Duration = Duration::from_millis(200);
/// Between two looks at how far the robot has come.
const LOOK: Duration = Duration::from_millis(50);
/// A search for a map on the way takes no longer, if nobody says how long it may take.
const PATIENCE: Duration = Duration::from_secs(2);
/// No more hits of a scan are shown.
const MOST_HITS: usize = 120;

/// The log and the robot's way through it as far as they have come.
pub(crate) type Latest = Mutex<GrowingTrack>;

pub(crate) fn lock(latest: &Latest) -> MutexGuard<'_, GrowingTrack> {
    latest.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Where the robot is.
#[derive(Serialize)]
struct Robot {
    /// How many scans were matched.
    scans: usize,
    /// Metres travelled.
    metres: f64,
    /// x, y and θ in the frame of the map: metres and radians.
    pose: [f64; 3],
    /// What the last scan hit, in that frame.
    hits: Vec<[f64; 2]>,
    /// Whether the last scan lies on nothing that was seen before.
    is_lost: bool,
}

/// Matches scans as they come until the stream ends; how long each took from its coming until it was shown.
pub(crate) fn follow(stream: &Stream, latest: &Latest, hub: &Hub) -> Vec<Duration> {
    let mut delays = Vec::new();
    let mut seen = 0;
    loop {
        stream.wait(seen);
        let Some(Snapshot { incoming, arrivals, is_last }) = stream.snapshot(seen) else { continue };
        let started = Instant::now();
        seen = arrivals.len();
        if let Some(log) = incoming.settled() {
            let mut growing = lock(latest);
            growing.follow(log);
            hub.show_robot(robot(&growing, hub));
            let shown = growing.track().scans.len().min(arrivals.len());
            let new = arrivals.get(delays.len()..shown).unwrap_or_default();
            delays.extend(new.iter().map(Instant::elapsed));
        }
        if is_last {
            return delays;
        }
        thread::sleep((REST * started.elapsed()).min(LONGEST_REST));
    }
}

fn robot(growing: &GrowingTrack, hub: &Hub) -> String {
    let track = growing.track();
    let (Some(logged), Some(last)) = (growing.log().and_then(|log| log.scans.last()), track.scans.last())
    else {
        return "null".to_owned();
    };
    let pose = hub.place(track).unwrap_or(last.pose);
    let hits: Vec<[f64; 2]> = hits_of(&logged.scan, pose);
    let step = hits.len().div_ceil(MOST_HITS).max(1);
    let robot = Robot {
        scans: track.scans.len(),
        metres: last.travelled,
        pose: [pose.x, pose.y, pose.theta],
        hits: hits.into_iter().step_by(step).collect(),
        is_lost: track.lost.last() == Some(&(track.scans.len() - 1)),
    };
    serde_json::to_string(&robot).unwrap_or_default()
}

/// What a scan hit, in the frame of the robot's pose.
fn hits_of(scan: &Scan, pose: Pose) -> Vec<[f64; 2]> {
    let rotation = pose.rotation();
    scan.hits(f64::INFINITY).map(|(_, hit)| (pose.translation() + rotation * hit).into()).collect()
}

/// What a map on the way took.
pub(crate) struct Remade {
    pub(crate) seconds: f64,
}

/// Makes maps until it is told to stop: one as soon as the robot has gone so many metres since the last one.
pub(crate) fn keep_mapping(
    latest: &Latest,
    every: f64,
    options: &MappingOptions,
    stop: &AtomicBool,
    monitor: &Arc<Monitor>,
    show: impl Fn(Result<(Input, Mapped), String>),
) -> Vec<Remade> {
    let mut options = options.clone();
    options.limits.seconds.get_or_insert(PATIENCE.as_secs_f64());
    let mut made = Vec::new();
    let mut mapped_to = f64::NEG_INFINITY;
    while !stop.load(Ordering::Relaxed) {
        renew(latest);
        let Some((log, track)) = further(latest, mapped_to + every) else {
            thread::sleep(LOOK);
            continue;
        };
        mapped_to = track.scans.last().map_or(0.0, |last| last.travelled);
        let started = Instant::now();
        let found = mapped(log, track, &options, monitor, || stop.load(Ordering::Relaxed));
        if !stop.load(Ordering::Relaxed) {
            made.push(Remade { seconds: started.elapsed().as_secs_f64() });
            show(found);
        }
    }
    made
}

/// Tracks all of the log anew if its beginning is told otherwise now, beside scans that come.
pub(crate) fn renew(latest: &Latest) {
    let growing = lock(latest);
    let Some(log) = growing.log().filter(|_| growing.is_outdated()).cloned() else { return };
    let options = growing.options();
    drop(growing);
    let anew = GrowingTrack::anew(options, log);
    lock(latest).replace(anew);
}

/// The log and the way through it, if that is so many metres long at least.
fn further(latest: &Latest, metres: f64) -> Option<(LaserLog, Track)> {
    let growing = lock(latest);
    let is_far = growing.track().scans.last().is_some_and(|last| last.travelled >= metres);
    is_far.then(|| growing.log().cloned().map(|log| (log, growing.track().clone()))).flatten()
}

fn mapped(
    log: LaserLog,
    track: Track,
    options: &MappingOptions,
    monitor: &Arc<Monitor>,
    is_stopped: impl Fn() -> bool,
) -> Result<(Input, Mapped), String> {
    let surveyed =
        SurveyedLog::from_track(
            log,
            track,
            options,
            |_, _| {
                if is_stopped() { Reply::Stop } else { Reply::GoOn }
            },
        );
    let input = surveyed.and_then(|surveyed| Input::surveyed("the robot", surveyed));
    let input = input.map_err(|error| error.to_string())?;
    let mapped = map(&input, options, monitor).map_err(|error| error.to_string())?;
    Ok((input, mapped))
}
