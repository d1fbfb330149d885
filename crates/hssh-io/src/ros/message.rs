//! The messages that a mapper can use, as `sensor_msgs`, `nav_msgs` and `tf2_msgs` define them.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use crate::ros::wire::{Fields, Wire, WireError};

/// What a topic carries.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum MessageType {
    LaserScan,
    MultiEchoLaserScan,
    Odometry,
    Transforms,
    /// Points in space.
    Cloud,
    Other,
}

impl MessageType {
    /// By the name of the type, as ROS 1 (`sensor_msgs/LaserScan`) or ROS 2 (`sensor_msgs/msg/LaserScan`) writes it.
    pub(crate) fn of(name: &str) -> Self {
        match name.replace("/msg/", "/").as_str() {
            "sensor_msgs/LaserScan" => MessageType::LaserScan,
            "sensor_msgs/MultiEchoLaserScan" => MessageType::MultiEchoLaserScan,
            "nav_msgs/Odometry" => MessageType::Odometry,
            "tf2_msgs/TFMessage" | "tf/tfMessage" => MessageType::Transforms,
            "sensor_msgs/PointCloud2" | "sensor_msgs/PointCloud" => MessageType::Cloud,
            _ => MessageType::Other,
        }
    }

    pub(crate) fn is_scan(self) -> bool {
        matches!(self, MessageType::LaserScan | MessageType::MultiEchoLaserScan)
    }

    /// Whether messages of it are read.
    pub(crate) fn is_read(self) -> bool {
        self.is_scan() || matches!(self, MessageType::Odometry | MessageType::Transforms)
    }
}

/// When and in which frame: `std_msgs/Header`.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Header {
    /// Nanoseconds.
    pub(crate) stamp: i64,
    pub(crate) frame: String,
}

/// A sweep as the message tells it.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct LaserScan {
    pub(crate) header: Header,
    pub(crate) angle_min: f32,
    pub(crate) angle_increment: f32,
    pub(crate) time_increment: f32,
    pub(crate) range_min: f32,
    pub(crate) range_max: f32,
    pub(crate) ranges: Vec<f32>,
}

/// A pose of odometry as the message tells it.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Odometry {
    pub(crate) header: Header,
    pub(crate) child: String,
    /// `None` if its numbers are no pose.
    pub(crate) pose: Option<Isometry3<f64>>,
}

/// A frame seen from another.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Transform {
    pub(crate) header: Header,
    pub(crate) child: String,
    /// `None` if its numbers are no pose.
    pub(crate) pose: Option<Isometry3<f64>>,
}

/// Frames of ROS 1 may begin with a slash that means nothing.
fn frame(name: &str) -> String {
    name.trim_start_matches('/').to_owned()
}

impl Header {
    fn read(fields: &mut Fields<'_>) -> Result<Self, WireError> {
        if fields.wire() == Wire::Ros1 {
            fields.u32()?; // seq
        }
        let (seconds, nanoseconds) = (fields.i32()?, fields.u32()?);
        let stamp = i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds);
        Ok(Header { stamp, frame: frame(&fields.text()?) })
    }
}

impl LaserScan {
    /// Reads one; of several echoes the first is taken, which is the nearest surface.
    pub(crate) fn read(bytes: &[u8], wire: Wire, kind: MessageType) -> Result<Self, WireError> {
        let mut fields = Fields::new(bytes, wire)?;
        let header = Header::read(&mut fields)?;
        let angle_min = fields.f32()?;
        fields.f32()?; // angle_max, which follows from the others
        let (angle_increment, time_increment) = (fields.f32()?, fields.f32()?);
        fields.f32()?; // scan_time
        let (range_min, range_max) = (fields.f32()?, fields.f32()?);
        let ranges = if kind == MessageType::MultiEchoLaserScan {
            let beams = fields.length()?;
            let first = |_| Ok(fields.floats()?.first().copied().unwrap_or(f32::INFINITY));
            (0..beams).map(first).collect::<Result<_, WireError>>()?
        } else {
            fields.floats()?
        };
        Ok(LaserScan { header, angle_min, angle_increment, time_increment, range_min, range_max, ranges })
    }
}

fn pose(fields: &mut Fields<'_>) -> Result<Option<Isometry3<f64>>, WireError> {
    let mut numbers = [0.0; 7];
    for number in &mut numbers {
        *number = fields.f64()?;
    }
    let [x, y, z, i, j, k, w] = numbers;
    let quaternion = Quaternion::new(w, i, j, k);
    let is_pose = numbers.iter().all(|number| number.is_finite() && number.abs() < 1e8);
    let is_rotation = (0.9..1.1).contains(&quaternion.norm());
    // A unit quaternion is taken to the last bit as it is.
    let rotation = if (quaternion.norm() - 1.0).abs() < 1e-9 {
        UnitQuaternion::new_unchecked(quaternion)
    } else {
        UnitQuaternion::new_normalize(quaternion)
    };
    Ok((is_pose && is_rotation).then(|| Isometry3::from_parts(Translation3::new(x, y, z), rotation)))
}

impl Odometry {
    pub(crate) fn read(bytes: &[u8], wire: Wire) -> Result<Self, WireError> {
        let mut fields = Fields::new(bytes, wire)?;
        let header = Header::read(&mut fields)?;
        let child = frame(&fields.text()?);
        Ok(Odometry { header, child, pose: pose(&mut fields)? })
    }
}

impl Transform {
    /// Reads a message of several.
    pub(crate) fn read_all(bytes: &[u8], wire: Wire) -> Result<Vec<Self>, WireError> {
        let mut fields = Fields::new(bytes, wire)?;
        let length = fields.length()?;
        let mut one = || {
            let header = Header::read(&mut fields)?;
            let child = frame(&fields.text()?);
            Ok(Transform { header, child, pose: pose(&mut fields)? })
        };
        (0..length).map(|_| one()).collect()
    }
}
