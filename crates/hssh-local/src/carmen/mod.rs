//! CARMEN logs: laser scans and odometry as robots of the 2000s recorded them, plain or compressed by gzip.
//!
//! | message | read as |
//! |---|---|
//! | `FLASER n r… x y θ x y θ t host t` | a scan, the corrected pose (for scoring only) and the raw odometry |
//! | `ROBOTLASER1`, `RAWLASER1` | the same, and how the laser looks; `RAWLASER1` has no poses: odometry before it counts |
//! | `RLASER …`, `ROBOTLASER2 …` | as `FLASER` and `ROBOTLASER1`, of a laser that looks back: beside others used on request only, which is said |
//! | `ODOM x y θ …` | raw odometry between scans |
//! | `PARAM name value …` | `robot_front_laser_max`: from that range on nothing came back; `robot_frontlaser_offset` and its kin: where the laser sits; `laser_front_laser_fov`: how wide it looks |
//! | anything else | counted |
//!
//! Names of messages may be in capitals or not. The last of several values of a parameter counts, for the whole log. Of several laser
//! messages one kind is read: `FLASER` before `ROBOTLASER1` before `RAWLASER1` before `RLASER` before `ROBOTLASER2`;
//! or those of several lasers are merged.

mod error;
mod facing;
mod growing;
mod handed;
mod jump;
mod limit;
mod log;
mod message;
mod mount;
mod noise;
mod order;
mod others;
mod pace;
mod position;
mod raw;
mod reader;
mod standing;
mod stray;
mod turn;
mod turns;
mod view;

pub use error::{LogError, LogWarning, MessageProblem};
pub use growing::GrowingLog;
pub use log::{LaserLog, LoggedScan};
pub use message::{LaserKind, LaserMessage, LaserView, Message};
pub use mount::LaserMount;
pub use position::LogPosition;
pub(crate) use raw::{Moment, RawLog, RawScan};
pub use reader::LogReader;
pub use turn::LaserTurn;
