//! From a bag to a laser log: what is chosen of it, in order of time, and what could not be used.

use std::collections::BTreeMap;
use std::path::Path;

use hssh_local::{LaserLog, LogWarning, RecordedScan, Recording, TimedPose};

use crate::ros::choice::{Choice, Odometry, RecordingOptions, choose, is_of_one_robot};
use crate::ros::clock::{self, Clock, ClockProblem, REACH, seconds};
use crate::ros::error::RecordingError;
use crate::ros::gather::{Gathered, Laser, Moment, gather};
use crate::ros::merge::{Other, merged};
use crate::ros::sweep::{Mount, SweepProblem, scan, seconds_to_middle};

/// A log with what of the bag was used for it.
#[derive(Clone, PartialEq, Debug)]
pub struct ReadRecording {
    /// The log.
    pub log: LaserLog,
    /// What was used, a sentence each: the laser, the odometry, where the one sits on the other.
    pub used: Vec<String>,
}

/// Reads a bag: a ROS 1 `.bag`, an MCAP file, a `.db3`, each also packed by zstd as a whole, or the folder of a ROS 2 bag.
///
/// # Errors
/// If it cannot be read, if it has no laser of which scans can be used, or if options ask for what it does not have.
pub fn read_bag(path: &Path, options: &RecordingOptions) -> Result<ReadRecording, RecordingError> {
    read(&gather(path)?, options)
}

/// The log of what was gathered of a bag.
pub(crate) fn read(gathered: &Gathered, options: &RecordingOptions) -> Result<ReadRecording, RecordingError> {
    let choice = choose(gathered, options)?;
    let used = used(gathered, &choice);
    let recording = recording(gathered, &choice)?;
    Ok(ReadRecording { log: LaserLog::from_recording(recording)?, used })
}

/// What is used, in words.
pub(crate) fn used(gathered: &Gathered, choice: &Choice<'_>) -> Vec<String> {
    let Choice { laser, odometry, mount, others: merged, .. } = choice;
    let is_used = |other: &Laser| {
        other.topic == laser.topic || merged.iter().any(|(merged, _)| merged.topic == other.topic)
    };
    let others: Vec<&str> = gathered
        .lasers
        .iter()
        .filter(|other| !is_used(other) && !other.sweeps.is_empty())
        .map(|other| other.topic.as_str())
        .collect();
    let mut used = vec![format!(
        "scans from {} (frame `{}`, {} beams over {:.0}°){}",
        laser.topic,
        laser.frame(),
        laser.beams(),
        laser.view(),
        if others.is_empty() {
            String::new()
        } else {
            let is_other_robot = |topic: &&&str| {
                !is_of_one_robot(topic, &laser.topic)
                    && gathered.wheels.iter().any(|wheels| is_of_one_robot(&wheels.topic, topic))
            };
            let merged: Vec<&str> = others.iter().filter(|topic| !is_other_robot(topic)).copied().collect();
            let all: Vec<&str> =
                std::iter::once(laser.topic.as_str()).chain(merged.iter().copied()).collect();
            let merges = match all[..] {
                [_] => String::new(),
                _ => format!("; --scan {} merges them", all.join(",")),
            };
            format!("; not {}, which --scan chooses{merges}", others.join(", "))
        }
    )];
    for (other, mount) in merged {
        let ([x, y], turn) = (mount.at, mount.turn.to_degrees());
        used.push(format!(
            "merged with scans from {} (frame `{}`, {} beams over {:.0}°), of a laser {x:.2} m ahead of the robot's axis, {y:.2} m to its left \
             and turned by {turn:.1}°",
            other.topic,
            other.frame(),
            other.beams(),
            other.view(),
        ));
    }
    used.push(match odometry {
        Odometry::Topic(wheels) => {
            format!("odometry from {} (`{}` in `{}`)", wheels.topic, wheels.child, wheels.frame)
        }
        Odometry::Frames { parent, child, .. } => format!("odometry from /tf (`{child}` in `{parent}`)"),
        Odometry::None => "odometry from the scans alone".to_owned(),
    });
    let [x, y] = mount.at;
    let turn = mount.turn.to_degrees();
    if [x, y, turn] != [0.0; 3] || mount.is_upside_down {
        let hangs = if mount.is_upside_down { " and hangs upside down" } else { "" };
        used.push(format!(
            "the laser sits {x:.2} m ahead of the robot's axis, {y:.2} m to its left, is turned by {turn:.1}°{hangs}"
        ));
    }
    used
}

/// The recording that a choice makes of a bag.
pub(crate) fn recording(gathered: &Gathered, choice: &Choice<'_>) -> Result<Recording, RecordingError> {
    let mut warnings: Vec<LogWarning> = Vec::new();
    let mut warn = |text: String, is_loss: bool| warnings.push(LogWarning::Remark { text, is_loss });
    for broken in &gathered.contents.breaks {
        warn(format!("the bag breaks off, and was used up to there: {broken}"), true);
    }
    for unreadable in &gathered.unreadable {
        let (number, reason) = &unreadable.first;
        let (topic, others) = (&unreadable.topic, unreadable.messages - 1);
        let more = if others > 0 { format!("; {others} more like it") } else { String::new() };
        warn(format!("{topic}: message {number} left out: {reason}{more}"), true);
    }
    choice.doubts.iter().for_each(|doubt| warn(doubt.clone(), false));

    let moments: Vec<Moment> = choice.laser.sweeps.iter().map(|(moment, _)| *moment).collect();
    let told: Vec<Moment> = choice.odometry.poses().iter().map(|(moment, _)| *moment).collect();
    let (clock, problem) = clock::choose(&moments, &told);
    let first_scans = clock::before_back(clock, &moments);
    let first_poses = clock::before_back(clock, &told);
    if let Some(problem) = problem {
        let lost = moments.len() - first_scans;
        warn(clock_words(clock, problem, lost), lost > 0);
    }

    let mut odometry: Vec<TimedPose> = choice.odometry.poses()[..first_poses]
        .iter()
        .map(|&(moment, pose)| TimedPose { time: seconds(clock.time(moment)), pose })
        .collect();
    odometry.sort_by(|one, other| one.time.total_cmp(&other.time));
    let (mut scans, problems) = scans(&choice.mount, &choice.laser.sweeps[..first_scans], clock);
    for (problem, (count, first)) in &problems {
        warn(format!("{}: scan {first} {problem}: left out, {count} in all", choice.laser.topic), true);
    }
    if !choice.others.is_empty() {
        let other = |(laser, mount): &(&Laser, Mount)| Other {
            at: mount.at,
            scans: self::scans(mount, &laser.sweeps, clock).0,
        };
        let others: Vec<Other> = choice.others.iter().map(other).collect();
        scans = merged(&scans, choice.mount.at, &others, &odometry);
    }
    if scans.is_empty() {
        let reason = problems.keys().next().map_or_else(String::new, SweepProblem::to_string);
        return Err(RecordingError::NoSweep { topic: choice.laser.topic.clone(), reason });
    }
    let all = scans.len();
    if let Some([first, last]) = span(&odometry) {
        let reach = seconds(REACH);
        let is_known = |scan: &RecordedScan| (first - reach..=last + reach).contains(&scan.time);
        if scans.iter().any(is_known) {
            scans.retain(is_known);
            let lost = all - scans.len();
            if lost > 0 {
                warn(
                    format!(
                        "{lost} of {all} scans were taken before odometry begins or after it ends: left out"
                    ),
                    true,
                );
            }
        } else {
            warn("no scan was taken while there is odometry: it is not used".to_owned(), true);
            odometry.clear();
        }
    }
    let Choice { mount, is_laser_given, .. } = *choice;
    Ok(Recording { scans, odometry, laser: mount.at, is_laser_given, warnings })
}

fn span(odometry: &[TimedPose]) -> Option<[f64; 2]> {
    Some([odometry.first()?.time, odometry.last()?.time])
}

/// Problems, with how many scans have each, and the first of them, counted from 1.
type SweepProblems = BTreeMap<SweepProblem, (usize, usize)>;

/// The scans in order of time.
fn scans(
    mount: &Mount,
    sweeps: &[(Moment, crate::ros::message::LaserScan)],
    clock: Clock,
) -> (Vec<RecordedScan>, SweepProblems) {
    let mut problems = SweepProblems::new();
    let mut scans = Vec::with_capacity(sweeps.len());
    for (index, (moment, sweep)) in sweeps.iter().enumerate() {
        match scan(sweep, mount) {
            Ok(scan) => {
                scans.push(RecordedScan {
                    scan,
                    time: seconds(clock.time(*moment)) + seconds_to_middle(sweep),
                });
            }
            Err(problem) => problems.entry(problem).or_insert((0, index + 1)).0 += 1,
        }
    }
    scans.sort_by(|one: &RecordedScan, other| one.time.total_cmp(&other.time));
    (scans, problems)
}

fn clock_words(clock: Clock, problem: ClockProblem, lost: usize) -> String {
    let instead = match (clock, lost) {
        (Clock::Recorder, 0) => "the times of recording are used instead".to_owned(),
        (_, 0) => "the times of recording are no better".to_owned(),
        (_, lost) => {
            format!("the {lost} scans from there on are left out; was the bag recorded across a restart?")
        }
    };
    match problem {
        ClockProblem::NoStamps => format!("messages have no time stamps: {instead}"),
        ClockProblem::Back { seconds, scan } => {
            format!("time runs backwards by {seconds:.1} s at scan {scan}: {instead}")
        }
        ClockProblem::Differ { seconds } => {
            format!("scans and odometry are stamped by two clocks, {:.1} s apart: {instead}", seconds.abs())
        }
    }
}
