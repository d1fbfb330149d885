//! Scan matching in the small: the robot's motion from scan to scan, where odometry says where to look
//! and decides along corridors, which look the same everywhere (the control level of section 2.1.1).

mod align;
mod bend;
mod calibrated;
mod cloud;
mod correlate;
mod good_odometry;
mod growing;
mod motion;
mod options;
mod outlook;
mod scans_alone;
mod track;
mod turned;

pub(crate) use align::align;
pub use calibrated::track_calibrated;
pub(crate) use cloud::{Cloud, SurfacePoint, surfaces};
pub use growing::GrowingTrack;
pub use motion::{MotionNoise, Slip};
pub use options::MatchOptions;
pub use scans_alone::{TimedScan, odometry_from_scans};
pub use track::{Track, TrackedScan, Tracker, track};
