//! What is in a bag, and what would be used of it: topics, types, rates, frames, gaps.

use std::fmt;
use std::path::Path;

use serde::Serialize;

use crate::ros::choice::{RecordingOptions, choose};
use crate::ros::clock::seconds;
use crate::ros::error::RecordingError;
use crate::ros::gather::{Gathered, Moment, gather};
use crate::ros::recording::{recording, used};

/// A pause between messages is a gap if it is so many times the usual one…
const TIMES_USUAL: f64 = 5.0;
/// …and no shorter than so many seconds.
const LEAST: f64 = 0.5;

/// What is in a bag.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct BagAccount {
    /// Seconds from the first message to the last, as they were recorded.
    pub seconds: f64,
    /// The topics in order of their names.
    pub topics: Vec<TopicAccount>,
    /// The frames that `/tf` and `/tf_static` tell of.
    pub frames: Vec<FrameAccount>,
    /// What would be used, a sentence each; nothing if nothing can be.
    pub used: Vec<String>,
    /// What would be left out, or is not certain, a sentence each.
    pub warnings: Vec<String>,
    /// Why nothing can be used; empty if something can.
    pub problem: String,
}

/// A topic.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TopicAccount {
    /// Its name.
    pub name: String,
    /// The type of its messages, as the bag writes it.
    #[serde(rename = "type")]
    pub type_name: String,
    /// How many messages it has.
    pub messages: u64,
    /// Messages a second, over the time of the whole bag.
    pub rate: f64,
    /// The frame of its messages, if they are read and have one.
    pub frame: String,
    /// How often there is a pause much longer than usual, of those that are read.
    pub gaps: u64,
    /// The longest pause between two messages, in seconds, of those that are read; else 0.
    pub longest_pause: f64,
}

/// A frame in another.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct FrameAccount {
    /// The frame.
    pub name: String,
    /// The one in which it sits.
    pub parent: String,
    /// Whether it moves there.
    pub moves: bool,
    /// Where it is first: metres along the parent's axes.
    pub at: [f64; 3],
    /// How it is turned first: roll, pitch and yaw in degrees.
    pub turned: [f64; 3],
}

/// What is in a bag, and what would be used of it by such options.
///
/// # Errors
/// If it cannot be read, or if options ask for what it does not have.
pub fn bag_account(path: &Path, options: &RecordingOptions) -> Result<BagAccount, RecordingError> {
    let gathered = gather(path)?;
    let span = gathered.contents.span.map_or(0.0, |[first, last]| seconds(last - first));
    let mut topics: Vec<TopicAccount> =
        gathered.contents.topics.iter().map(|topic| topic_account(&gathered, topic, span)).collect();
    topics.sort_by(|one, other| one.name.cmp(&other.name));
    let rounded = |number: f64| (number * 1e3).round() / 1e3 + 0.0;
    let frames = gathered.frames.links().map(|(name, link)| {
        let first = link.poses.first().map(|(_, _, pose)| *pose).unwrap_or_default();
        let (roll, pitch, yaw) = first.rotation.euler_angles();
        FrameAccount {
            name: name.to_owned(),
            parent: link.parent.clone(),
            moves: link.moves(),
            at: [first.translation.x, first.translation.y, first.translation.z].map(rounded),
            turned: [roll, pitch, yaw].map(f64::to_degrees).map(rounded),
        }
    });
    let frames = frames.collect();
    let mut account = BagAccount {
        seconds: span,
        topics,
        frames,
        used: Vec::new(),
        warnings: Vec::new(),
        problem: String::new(),
    };
    match choose(&gathered, options) {
        Ok(choice) => {
            account.used = used(&gathered, &choice);
            match recording(&gathered, &choice) {
                Ok(recording) => {
                    account.warnings = recording.warnings.iter().map(ToString::to_string).collect()
                }
                Err(error) => account.problem = error.to_string(),
            }
        }
        Err(error @ (RecordingError::NoSuchScan { .. } | RecordingError::NoSuchOdometry { .. })) => {
            return Err(error);
        }
        Err(error) => account.problem = error.to_string(),
    }
    Ok(account)
}

fn topic_account(gathered: &Gathered, topic: &crate::ros::bag::BagTopic, span: f64) -> TopicAccount {
    let laser = gathered.lasers.iter().find(|laser| laser.topic == topic.name);
    let wheels = gathered.wheels.iter().find(|wheels| wheels.topic == topic.name);
    let moments: Vec<Moment> = match (laser, wheels) {
        (Some(laser), _) => laser.sweeps.iter().map(|(moment, _)| *moment).collect(),
        (None, Some(wheels)) => wheels.poses.iter().map(|(moment, _)| *moment).collect(),
        (None, None) => Vec::new(),
    };
    let pauses: Vec<f64> =
        moments.windows(2).map(|pair| seconds(pair[1].recorded - pair[0].recorded)).collect();
    let mut sorted = pauses.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    let is_gap = |pause: &&f64| **pause > LEAST.max(TIMES_USUAL * usual);
    TopicAccount {
        name: topic.name.clone(),
        type_name: topic.type_name.clone(),
        messages: topic.messages,
        rate: if span > 0.0 { (topic.messages as f64 / span * 100.0).round() / 100.0 } else { 0.0 },
        frame: laser
            .map(|laser| laser.frame().to_owned())
            .or(wheels.map(|wheels| wheels.frame.clone()))
            .unwrap_or_default(),
        gaps: pauses.iter().filter(is_gap).count() as u64,
        longest_pause: sorted.last().copied().unwrap_or(0.0),
    }
}

impl fmt::Display for BagAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.problem.is_empty() {
            writeln!(f, "{:.1} s, {} topics:", self.seconds, self.topics.len())?;
        } else {
            writeln!(f, "nothing can be used: {}", self.problem)?;
            writeln!(f, "{:.1} s, {} topics:", self.seconds, self.topics.len())?;
        }
        let wide = |length: fn(&TopicAccount) -> usize| self.topics.iter().map(length).max().unwrap_or(0);
        let (names, types) = (wide(|topic| topic.name.len()), wide(|topic| topic.type_name.len()));
        for topic in &self.topics {
            write!(f, "  {:names$}  {:types$}  {:>7} messages", topic.name, topic.type_name, topic.messages)?;
            write!(f, ", {:.1}/s", topic.rate)?;
            if !topic.frame.is_empty() {
                write!(f, ", in `{}`", topic.frame)?;
            }
            match topic.gaps {
                0 => {}
                gaps => write!(f, ", {gaps} gaps of up to {:.1} s", topic.longest_pause)?,
            }
            writeln!(f)?;
        }
        if !self.frames.is_empty() {
            writeln!(f, "frames:")?;
        }
        for FrameAccount { name, parent, moves, at: [x, y, z], turned: [roll, pitch, yaw] } in &self.frames {
            write!(f, "  {name} in {parent}")?;
            if *moves {
                writeln!(f, ": moves")?;
            } else {
                writeln!(f, ": {x:.2}, {y:.2}, {z:.2} m; roll {roll:.1}°, pitch {pitch:.1}°, yaw {yaw:.1}°")?;
            }
        }
        if !self.used.is_empty() {
            writeln!(f, "used:")?;
        }
        self.used.iter().try_for_each(|used| writeln!(f, "  {used}"))?;
        self.warnings.iter().try_for_each(|warning| writeln!(f, "warning: {warning}"))
    }
}
