//! What a bag holds for a mapper: its lasers, its odometry, its frames, as they come.

use std::collections::BTreeMap;
use std::path::Path;

use hssh_metrics::Pose;
use nalgebra::Isometry3;

use crate::ros::bag::{self, BagContents, BagError, BagMessage};
use crate::ros::frames::Frames;
use crate::ros::message::{LaserScan, MessageType, Odometry, Transform};
use crate::ros::sweep::exact;

/// When something was, by two clocks: nanoseconds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Moment {
    /// As its own header says.
    pub(crate) stamp: i64,
    /// When it was recorded.
    pub(crate) recorded: i64,
}

/// A topic with scans.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Laser {
    pub(crate) topic: String,
    pub(crate) sweeps: Vec<(Moment, LaserScan)>,
}

impl Laser {
    /// The frame of its first sweep.
    pub(crate) fn frame(&self) -> &str {
        self.sweeps.first().map_or("", |(_, sweep)| sweep.header.frame.as_str())
    }

    /// How wide it looks: degrees.
    pub(crate) fn view(&self) -> f64 {
        let wide = |(_, sweep): &(Moment, LaserScan)| {
            f64::from(sweep.angle_increment.abs()).to_degrees()
                * (sweep.ranges.len().saturating_sub(1)) as f64
        };
        self.sweeps.first().map_or(0.0, wide).min(360.0)
    }

    pub(crate) fn beams(&self) -> usize {
        self.sweeps.first().map_or(0, |(_, sweep)| sweep.ranges.len())
    }
}

/// A topic with poses of odometry.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Wheels {
    pub(crate) topic: String,
    /// The frame in which they are.
    pub(crate) frame: String,
    /// The frame that they move.
    pub(crate) child: String,
    pub(crate) poses: Vec<(Moment, Pose)>,
}

/// Messages that could not be read, of one topic.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Unreadable {
    pub(crate) topic: String,
    pub(crate) messages: u64,
    /// The first one's number in its topic, counted from 1, and why.
    pub(crate) first: (u64, String),
}

/// All of it.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Gathered {
    pub(crate) contents: BagContents,
    pub(crate) lasers: Vec<Laser>,
    pub(crate) wheels: Vec<Wheels>,
    /// Those of all robots together.
    pub(crate) frames: Frames,
    /// Where transforms come by topics such as `/robot1/tf`: those of each such namespace with those of none, and under no name those of none. Robots
    /// that are told apart in this way call their frames alike.
    robots: BTreeMap<String, Frames>,
    pub(crate) unreadable: Vec<Unreadable>,
    met: BTreeMap<String, u64>,
}

/// What stands before the last part of a topic's name: of `/robot1/scan`, `robot1`.
pub(crate) fn namespace(topic: &str) -> &str {
    topic.trim_start_matches('/').rsplit_once('/').map_or("", |(namespace, _)| namespace)
}

/// A frame on the floor.
pub(crate) fn planar(pose: &Isometry3<f64>) -> Pose {
    let q = pose.rotation;
    let yaw = (2.0 * (q.w * q.k + q.i * q.j)).atan2(1.0 - 2.0 * (q.j * q.j + q.k * q.k));
    Pose::new(pose.translation.x, pose.translation.y, exact(yaw))
}

/// Reads a bag.
pub(crate) fn gather(path: &Path) -> Result<Gathered, BagError> {
    let mut gathered = Gathered::default();
    let contents = bag::read(path, &mut |message| gathered.add(&message))?;
    gathered.contents = contents;
    Ok(gathered)
}

impl Gathered {
    pub(crate) fn add(&mut self, message: &BagMessage<'_>) {
        let topic = &message.topic.name;
        let Some(wire) = message.topic.wire else { return };
        let number = self.met.entry(topic.clone()).or_default();
        *number += 1;
        let number = *number;
        let kind = message.topic.kind();
        let moment = |stamp| Moment { stamp, recorded: message.time };
        let problem = match kind {
            MessageType::LaserScan | MessageType::MultiEchoLaserScan => {
                LaserScan::read(message.bytes, wire, kind).map(|sweep| {
                    self.laser(topic).sweeps.push((moment(sweep.header.stamp), sweep));
                    None
                })
            }
            MessageType::Odometry => Odometry::read(message.bytes, wire).map(|told| {
                let Some(pose) = &told.pose else {
                    return Some("its pose has numbers that are none".to_owned());
                };
                let (stamp, pose) = (told.header.stamp, planar(pose));
                self.wheels(topic, told).poses.push((moment(stamp), pose));
                None
            }),
            MessageType::Transforms => Transform::read_all(message.bytes, wire).map(|transforms| {
                for transform in transforms {
                    self.add_transform(namespace(topic), transform, message.time);
                }
                None
            }),
            MessageType::Cloud | MessageType::Other => Ok(None),
        };
        let reason = match problem {
            Ok(None) => return,
            Ok(Some(reason)) => reason,
            Err(error) => error.to_string(),
        };
        match self.unreadable.iter_mut().find(|unreadable| unreadable.topic == *topic) {
            Some(unreadable) => unreadable.messages += 1,
            None => self.unreadable.push(Unreadable {
                topic: topic.clone(),
                messages: 1,
                first: (number, reason),
            }),
        }
    }

    fn add_transform(&mut self, of: &str, transform: Transform, recorded: i64) {
        if self.robots.is_empty() && !of.is_empty() {
            self.robots.insert(String::new(), self.frames.clone());
        }
        if !of.is_empty() && !self.robots.contains_key(of) {
            let common = self.robots[""].clone();
            self.robots.insert(of.to_owned(), common);
        }
        for (name, frames) in &mut self.robots {
            if of.is_empty() || name == of {
                frames.add(transform.clone(), recorded);
            }
        }
        self.frames.add(transform, recorded);
    }

    /// The frames of the robot that a laser is of, if it shares its namespace with topics of transforms; else all.
    pub(crate) fn frames_of(&self, laser: &Laser) -> &Frames {
        let of = namespace(&laser.topic);
        let is_within = |name: &str| !name.is_empty() && (of == name || of.starts_with(&format!("{name}/")));
        let own = self.robots.iter().filter(|(name, _)| is_within(name));
        own.max_by_key(|(name, _)| name.len()).map_or(&self.frames, |(_, frames)| frames)
    }

    fn laser(&mut self, topic: &str) -> &mut Laser {
        let known = self.lasers.iter().position(|laser| laser.topic == topic);
        let index = known.unwrap_or_else(|| {
            self.lasers.push(Laser { topic: topic.to_owned(), sweeps: Vec::new() });
            self.lasers.len() - 1
        });
        &mut self.lasers[index]
    }

    fn wheels(&mut self, topic: &str, told: Odometry) -> &mut Wheels {
        let known = self.wheels.iter().position(|wheels| wheels.topic == topic);
        let index = known.unwrap_or_else(|| {
            let (frame, child) = (told.header.frame, told.child);
            self.wheels.push(Wheels { topic: topic.to_owned(), frame, child, poses: Vec::new() });
            self.wheels.len() - 1
        });
        &mut self.wheels[index]
    }
}
