//! Why a recording cannot be used, and what to do.

use crate::ros::bag::BagError;
use crate::ros::gather::Gathered;
use crate::ros::message::MessageType;

/// Why a recording cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The bag cannot be read.
    #[error(transparent)]
    Bag(#[from] BagError),
    /// Nothing was recorded.
    #[error(
        "the bag is empty: it has {topics} topics and no message; was the robot running when it was recorded?"
    )]
    Empty {
        /// How many topics there are.
        topics: usize,
    },
    /// There is no planar laser.
    #[error(
        "the bag has no sensor_msgs/LaserScan{}; it has {has}",
        if clouds.is_empty() {
            String::new()
        } else {
            format!(
                ", only clouds of points ({}): make scans of them (pointcloud_to_laserscan) and record those",
                clouds.join(", ")
            )
        }
    )]
    NoLaser {
        /// The topics with points in space.
        clouds: Vec<String>,
        /// The topics that there are, with their types.
        has: String,
    },
    /// There are scans and none can be read.
    #[error("none of the {messages} messages of {topic} can be read: message {number} {reason}")]
    Unreadable {
        /// The topic.
        topic: String,
        /// How many messages.
        messages: u64,
        /// The first of them, counted from 1.
        number: u64,
        /// Why not.
        reason: String,
    },
    /// The laser that was asked for is not there.
    #[error("--scan {asked}: the bag has no scans of that topic; it has {}", listed(known))]
    NoSuchScan {
        /// What was asked for.
        asked: String,
        /// The lasers that there are.
        known: Vec<String>,
    },
    /// The odometry that was asked for is not there.
    #[error("--odom {asked}: the bag has no odometry of that topic or frame; it has {}", listed(known))]
    NoSuchOdometry {
        /// What was asked for.
        asked: String,
        /// The odometry that there is.
        known: Vec<String>,
    },
    /// The laser does not look along the floor.
    #[error(
        "the laser of {topic} leans by {degrees:.0}° from the horizontal: its scans are no section along the floor; choose another one by \
         --scan"
    )]
    Leaning {
        /// The topic.
        topic: String,
        /// By how much.
        degrees: f64,
    },
    /// No sweep of the laser can be used.
    #[error("no scan of {topic} can be used: each {reason}")]
    NoSweep {
        /// The topic.
        topic: String,
        /// Why not.
        reason: String,
    },
    /// What the log of the recording says.
    #[error(transparent)]
    Log(#[from] hssh_local::LogError),
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

impl RecordingError {
    /// Why there is no laser to use.
    pub(crate) fn no_laser(gathered: &Gathered) -> Self {
        let topics = &gathered.contents.topics;
        let scans = |topic: &str| topics.iter().any(|known| known.name == topic && known.kind().is_scan());
        if let Some(unreadable) = gathered.unreadable.iter().find(|unreadable| scans(&unreadable.topic)) {
            let (number, reason) = unreadable.first.clone();
            return RecordingError::Unreadable {
                topic: unreadable.topic.clone(),
                messages: unreadable.messages,
                number,
                reason,
            };
        }
        if topics.iter().all(|topic| topic.messages == 0) {
            return RecordingError::Empty { topics: topics.len() };
        }
        let silent = topics.iter().find(|topic| topic.kind().is_scan() && topic.wire.is_none());
        if let Some(topic) = silent {
            return RecordingError::Unreadable {
                topic: topic.name.clone(),
                messages: topic.messages,
                number: 1,
                reason: "is written neither as ROS 2 (CDR) nor as ROS 1 does".to_owned(),
            };
        }
        let clouds = topics.iter().filter(|topic| topic.kind() == MessageType::Cloud);
        let clouds = clouds.map(|topic| topic.name.clone()).collect();
        let has = topics.iter().take(12).map(|topic| format!("{} ({})", topic.name, topic.type_name));
        let more = if topics.len() > 12 { ", …" } else { "" };
        RecordingError::NoLaser { clouds, has: has.collect::<Vec<_>>().join(", ") + more }
    }
}
